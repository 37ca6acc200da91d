// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSnapshot.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSnapshot::vtkIsosurfaceRayTraceSnapshot(
  vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes, int threads)
  : DisplayTime(attributes ? attributes->GetMTime() : 0)
{
  const auto iterator = vtk::TakeSmartPointer(data->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    this->Blocks.push_back(iterator->GetCurrentDataObject());
    this->FlatIndices.push_back(iterator->GetCurrentFlatIndex());
  }
  // There may be thousands of blocks, looked at in every frame: their times are far apart in
  // memory.
  constexpr std::int64_t many = 256;
  const auto count = static_cast<std::int64_t>(this->Blocks.size());
  this->Times.resize(this->Blocks.size());
#pragma omp parallel for num_threads(threads) if (count > many)
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto block = static_cast<std::size_t>(i);
    this->Times[block] = this->Blocks[block]->GetMTime();
  }
}

VTK_ABI_NAMESPACE_END
