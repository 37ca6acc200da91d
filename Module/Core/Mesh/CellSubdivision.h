// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellSubdivision_h
#define CellSubdivision_h

#include "Mesh/MeshCell.h"

#include <array>

namespace vtkIsosurfaceRayTracing
{

/// The largest number of tetrahedra that a cell is subdivided into.
constexpr int MaximumTetrahedra = 6;

/// How many tetrahedra a cell of a shape is subdivided into; 0 for shapes that are not traced.
inline int CountTetrahedra(CellShape shape)
{
  switch (shape)
  {
    case CellShape::Tetrahedron:
      return 1;
    case CellShape::Voxel:
    case CellShape::Hexahedron:
      return 6;
    case CellShape::Wedge:
      return 3;
    case CellShape::Pyramid:
      return 2;
  }
  return 0;
}

/// Subdivides a cell into tetrahedra, given by the numbers of their corners within the cell. All
/// contain the first corner of the cell (by x, then by y, then by z); opposite to it are the faces
/// without it, of which quadrangles are cut in two from their own first corner. So cells that share
/// a quadrangle cut it along the same diagonal, whatever their shapes and the ids of their points
/// are. Returns the number of tetrahedra.
int SubdivideCell(const MeshCell& cell, int (*corners)[4]);

/// The same, given by the coordinates and the values of the corners.
int SubdivideCell(const MeshCell& cell, double (*corners)[4][4]);

/// The same with several numbers, given those at the corners of the cell, which each tetrahedron
/// has at its own: as many rows for each. The corners are in the order of their places, which
/// ProjectedTetrahedra have. What is instead of their values is undefined.
int SubdivideCell(const MeshCell& cell, const double (*numbers)[MaximumCorners], int count,
  double (*corners)[4][4], std::array<double, 4>* ofCorners);

}

#endif
