// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A block of composite data, as a part of the grid that its blocks make together.

#ifndef vtkIsosurfaceRayTraceBlock_h
#define vtkIsosurfaceRayTraceBlock_h

#include "vtkDataSet.h"                    // for ivars
#include "vtkDataSetAttributes.h"          // for ghost types
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Math/Vector.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;

struct vtkIsosurfaceRayTraceBlock
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

  /// Whether a place is one of a grid of some size.
  static bool Contains(const Index3& size, const Index3& place)
  {
    return place[0] >= 0 && place[1] >= 0 && place[2] >= 0 && place[0] < size[0] &&
      place[1] < size[1] && place[2] < size[2];
  }

  /// Bits of ghost arrays. Those of points and cells that are duplicates are the same.
  static constexpr int Blanked =
    vtkDataSetAttributes::HIDDENCELL | vtkDataSetAttributes::REFINEDCELL;
  static constexpr int Duplicate = vtkDataSetAttributes::DUPLICATECELL;

  vtkSmartPointer<vtkDataSet> Data;
  unsigned int FlatIndex;
  /// How many points and cells the blocks before it have.
  vtkIdType FirstPoint;
  vtkIdType FirstCell;
  /// Its scalars; and what to colour by, which may be null.
  vtkDataArray* Scalars;
  vtkDataArray* Colors;
  /// The place of its first point among those of the grid.
  Index3 First;

  /// The number of points and cells along each axis.
  Index3 GetPoints() const;
  Index3 GetCells() const;

  /// Whether a cell, by its place in the block, is there and shown: it has none of some bits in the
  /// ghost array, and no hidden corner.
  bool Shows(const Index3& cell, int hiding) const;

  /// The number of a cell or a point of the grid in the block.
  vtkIdType GetCellId(const Index3& cell) const;
  vtkIdType GetPointId(const Index3& point) const;
};

VTK_ABI_NAMESPACE_END

#endif
