// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceRayTraceUse
 * @brief   one use of a mapper that ray traces isosurfaces: drawing, casting, picking
 *
 * As long as a use lasts, the mapper exists and no other thread may use it. Observers of events
 * that it sends may use the mapper as well: such a use is nested, and has inputs of its own, so
 * that whatever it traces, the frame that is being traced stays as it is.
 */

#ifndef vtkIsosurfaceRayTraceUse_h
#define vtkIsosurfaceRayTraceUse_h

#include "vtkIsosurfaceRayTraceInputs.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkObject.h"                     // for ivars
#include "vtkSmartPointer.h"               // for ivars

#include <memory> // for std::unique_ptr
#include <mutex>  // for std::recursive_mutex

VTK_ABI_NAMESPACE_BEGIN

/// What the uses of a mapper share.
struct vtkIsosurfaceRayTraceUseState
{
  explicit vtkIsosurfaceRayTraceUseState(const vtkIsosurfaceRayTraceInputs::Maker& newInput)
    : NewInput(newInput)
    , Inputs(std::make_unique<vtkIsosurfaceRayTraceInputs>(newInput))
  {
  }

  /// That of the last use.
  const vtkIsosurfaceRayTraceInputs& GetLastInputs() const
  {
    return this->NestedInputs ? *this->NestedInputs : *this->Inputs;
  }

  std::recursive_mutex Mutex;
  int Depth = 0;
  vtkIsosurfaceRayTraceInputs::Maker NewInput;
  std::unique_ptr<vtkIsosurfaceRayTraceInputs> Inputs;
  /// Of the nested uses, as long as the outer one lasts.
  std::unique_ptr<vtkIsosurfaceRayTraceInputs> NestedInputs;
};

class vtkIsosurfaceRayTraceUse
{
public:
  /// If another thread is using the mapper, an error reports it, and this is no use. (To wait could
  /// take forever: the other thread may be in an observer that waits for this one, as Python's
  /// interpreter does.)
  vtkIsosurfaceRayTraceUse(vtkObject* mapper, vtkIsosurfaceRayTraceUseState& state);
  ~vtkIsosurfaceRayTraceUse();
  vtkIsosurfaceRayTraceUse(const vtkIsosurfaceRayTraceUse&) = delete;
  void operator=(const vtkIsosurfaceRayTraceUse&) = delete;

  bool IsAllowed() const { return this->Lock.owns_lock(); }

  /// Whether an observer of another use began it.
  bool IsNested() const { return this->Nested; }

  /// The inputs of an allowed use.
  vtkIsosurfaceRayTraceInputs& GetInputs() const;

private:
  /// Owns the state, so it goes last.
  vtkSmartPointer<vtkObject> Mapper;
  vtkIsosurfaceRayTraceUseState& State;
  std::unique_lock<std::recursive_mutex> Lock;
  bool Nested = false;
};

VTK_ABI_NAMESPACE_END

#endif
