// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceUse.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceUse::vtkIsosurfaceRayTraceUse(
  vtkObject* mapper, vtkIsosurfaceRayTraceUseState& state)
  : Mapper(mapper)
  , State(state)
  , Lock(state.Mutex, std::try_to_lock)
{
  if (!this->Lock.owns_lock())
  {
    // Not by the mapper: the other thread may be sending events to its observers.
    vtkErrorWithObjectMacro(nullptr,
      "Another thread is using the "
        << mapper->GetClassName() << " at " << mapper
        << ". Use it in one thread after the other, or give each thread its own.");
    return;
  }
  this->Nested = state.Depth > 0;
  ++state.Depth;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceUse::~vtkIsosurfaceRayTraceUse()
{
  if (this->Lock.owns_lock() && --this->State.Depth == 0)
  {
    this->State.NestedInputs.reset();
  }
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInputs& vtkIsosurfaceRayTraceUse::GetInputs() const
{
  if (!this->Nested)
  {
    return *this->State.Inputs;
  }
  if (!this->State.NestedInputs)
  {
    this->State.NestedInputs = std::make_unique<vtkIsosurfaceRayTraceInputs>(this->State.NewInput);
  }
  return *this->State.NestedInputs;
}

VTK_ABI_NAMESPACE_END
