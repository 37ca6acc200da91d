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

/// An array, and what it was when it was read first.
class vtkIsosurfaceRayTraceReadArray
{
public:
  explicit vtkIsosurfaceRayTraceReadArray(vtkDataArray* array)
    : Array(array)
    , Memory(array->GetVoidPointer(0))
    , Values(array->GetNumberOfValues())
  {
  }

  vtkDataArray* GetArray() const { return this->Array; }
  const void* GetMemory() const { return this->Memory; }

  /// Whether it is where it was, and as long.
  bool IsIntact() const
  {
    return this->Array->GetVoidPointer(0) == this->Memory &&
      this->Array->GetNumberOfValues() >= this->Values;
  }

private:
  vtkDataArray* Array;
  const void* Memory;
  vtkIdType Values;
};

class vtkIsosurfaceRayTraceReadArrays
{
public:
  /// Returns the memory of an array.
  const void* Read(vtkDataArray* array)
  {
    this->Arrays.emplace_back(array);
    return this->Arrays.back().GetMemory();
  }

  /// Whether all are where they were, and as long.
  bool AreIntact() const
  {
    return std::all_of(this->Arrays.begin(), this->Arrays.end(),
      [](const vtkIsosurfaceRayTraceReadArray& read) { return read.IsIntact(); });
  }

  void AddObjects(std::vector<vtkObject*>& objects) const
  {
    for (const vtkIsosurfaceRayTraceReadArray& read : this->Arrays)
    {
      objects.push_back(read.GetArray());
    }
  }

private:
  std::vector<vtkIsosurfaceRayTraceReadArray> Arrays;
};

VTK_ABI_NAMESPACE_END

#endif
