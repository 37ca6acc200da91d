// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Arrays that are read in the memory of their owner, which must stay the same as long as they are
// traced.

#ifndef vtkIsosurfaceRayTraceReadArrays_h
#define vtkIsosurfaceRayTraceReadArrays_h

#include "vtkDataArray.h"                  // for inline methods
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <algorithm> // for std::all_of
#include <vector>    // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceReadArrays
{
public:
  /// Returns the memory of an array.
  const void* Read(vtkDataArray* array)
  {
    this->Arrays.push_back({ array, array->GetVoidPointer(0), array->GetNumberOfValues() });
    return this->Arrays.back().Memory;
  }

  /// Whether all are where they were, and as long.
  bool AreIntact() const
  {
    return std::all_of(this->Arrays.begin(), this->Arrays.end(),
      [](const ReadArray& read)
      {
        return read.Array->GetVoidPointer(0) == read.Memory &&
          read.Array->GetNumberOfValues() >= read.Values;
      });
  }

  void AddObjects(std::vector<vtkObject*>& objects) const
  {
    for (const ReadArray& read : this->Arrays)
    {
      objects.push_back(read.Array);
    }
  }

private:
  struct ReadArray
  {
    vtkDataArray* Array;
    const void* Memory;
    vtkIdType Values;
  };

  std::vector<ReadArray> Arrays;
};

VTK_ABI_NAMESPACE_END

#endif
