// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of composite data, and when each was modified: what is known of them is right as long
// as these are the same.

#ifndef vtkIsosurfaceRayTraceSnapshot_h
#define vtkIsosurfaceRayTraceSnapshot_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkMTimeType

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataDisplayAttributes;
class vtkCompositeDataSet;
class vtkDataObject;

class vtkIsosurfaceRayTraceSnapshot
{
public:
  /// Of no data.
  vtkIsosurfaceRayTraceSnapshot() = default;

  /// The attributes that blocks are displayed with may be null.
  vtkIsosurfaceRayTraceSnapshot(
    vtkCompositeDataSet* data, vtkCompositeDataDisplayAttributes* attributes, int threads);

  bool operator==(const vtkIsosurfaceRayTraceSnapshot& other) const
  {
    return this->DisplayTime == other.DisplayTime && this->Blocks == other.Blocks &&
      this->Times == other.Times && this->FlatIndices == other.FlatIndices;
  }

private:
  vtkMTimeType DisplayTime = 0;
  std::vector<vtkDataObject*> Blocks;
  std::vector<vtkMTimeType> Times;
  std::vector<unsigned int> FlatIndices;
};

VTK_ABI_NAMESPACE_END

#endif
