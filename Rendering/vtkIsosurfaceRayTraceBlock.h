// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A block of composite data, as a part of the grid that its blocks form together.

#ifndef vtkIsosurfaceRayTraceBlock_h
#define vtkIsosurfaceRayTraceBlock_h

#include "vtkIsosurfaceRayTraceLeaves.h"   // for base class
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Math/Vector.h"

VTK_ABI_NAMESPACE_BEGIN

struct vtkIsosurfaceRayTraceBlock : vtkIsosurfaceRayTraceLeaf
{
  using Index3 = vtkIsosurfaceRayTracing::Index3;

  static Index3 Add(const Index3& a, const Index3& b)
  {
    return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
  }
  static Index3 Subtract(const Index3& a, const Index3& b)
  {
    return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  }

  /// Whether an index is one of a grid of some size.
  static bool Contains(const Index3& size, const Index3& index)
  {
    return index[0] >= 0 && index[1] >= 0 && index[2] >= 0 && index[0] < size[0] &&
      index[1] < size[1] && index[2] < size[2];
  }

  /// The index of its first point in the grid.
  Index3 First;

  /// The numbers of points and cells along each axis.
  Index3 GetPoints() const;
  Index3 GetCells() const;

  /// Whether a cell, given its index in the block, exists and is shown: none of some bits is set in
  /// the ghost array, and no corner is hidden.
  bool Shows(const Index3& cell, int hiding) const;

  /// The number of a cell or a point of the grid in the block.
  vtkIdType GetCellId(const Index3& cell) const;
  vtkIdType GetPointId(const Index3& point) const;
};

VTK_ABI_NAMESPACE_END

#endif
