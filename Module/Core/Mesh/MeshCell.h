// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCell_h
#define MeshCell_h

#include "Kernels/MeshCellArrays.h"
#include "Math/TrilinearCell.h"
#include "Mesh/MeshView.h"

#include <array>
#include <cstddef>
#include <cstdint>

// Every cell is a trilinear one: points and values are the trilinear interpolant of eight corners,
// those of VTK's isoparametric cells exactly. Wedges, pyramids and tetrahedra are hexahedra with
// corners that coincide.

namespace vtkIsosurfaceRayTracing
{

/// The largest numbers of corners and of faces of a cell, and of corners of a face.
constexpr int MaximumCorners = PassedCellRecords::Corners;
constexpr int MaximumFaces = 6;
constexpr int MaximumFaceCorners = 4;

/// A cell as it was read: its corners in VTK's order.
struct MeshCell
{
  CellShape Shape;
  int Count;
  std::int64_t Ids[MaximumCorners];
  Vector3 Points[MaximumCorners];
  double Values[MaximumCorners];
};

/// A face of a cell: its corners in order around it, as numbers within the cell, counterclockwise
/// seen from outside if the parametric coordinates are right-handed. Count is 3 or 4.
struct CellFace
{
  int Count;
  int Corners[MaximumFaceCorners];
};

/// What is known of a shape.
struct ShapeTraits
{
  /// The number of corners; 0 for shapes that are not traced.
  int Corners = 0;
  int Faces = 0;
  CellFace Face[MaximumFaces] = {};
  /// For each of the eight corners of the trilinear cell, in the order x + 2 y + 4 z, the corner of
  /// this shape that it is.
  int Trilinear[8] = {};
  /// Of each corner, those that its three edges lead to. The apex of a pyramid has four.
  int Neighbors[MaximumCorners][3] = {};
};

inline const ShapeTraits& GetTraits(CellShape shape)
{
  static constexpr ShapeTraits tetrahedron = { 4, 4,
    { { 3, { 0, 2, 1 } }, { 3, { 0, 1, 3 } }, { 3, { 0, 3, 2 } }, { 3, { 1, 2, 3 } } },
    { 0, 1, 2, 2, 3, 3, 3, 3 }, { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } } };
  static constexpr ShapeTraits voxel = { 8, 6,
    { { 4, { 0, 4, 6, 2 } }, { 4, { 1, 3, 7, 5 } }, { 4, { 0, 1, 5, 4 } }, { 4, { 2, 6, 7, 3 } },
      { 4, { 0, 2, 3, 1 } }, { 4, { 4, 5, 7, 6 } } },
    { 0, 1, 2, 3, 4, 5, 6, 7 },
    { { 1, 2, 4 }, { 0, 3, 5 }, { 3, 0, 6 }, { 2, 1, 7 }, { 5, 6, 0 }, { 4, 7, 1 }, { 7, 4, 2 },
      { 6, 5, 3 } } };
  static constexpr ShapeTraits hexahedron = { 8, 6,
    { { 4, { 0, 4, 7, 3 } }, { 4, { 1, 2, 6, 5 } }, { 4, { 0, 1, 5, 4 } }, { 4, { 3, 7, 6, 2 } },
      { 4, { 0, 3, 2, 1 } }, { 4, { 4, 5, 6, 7 } } },
    { 0, 1, 3, 2, 4, 5, 7, 6 },
    { { 1, 3, 4 }, { 0, 2, 5 }, { 3, 1, 6 }, { 2, 0, 7 }, { 5, 7, 0 }, { 4, 6, 1 }, { 7, 5, 2 },
      { 6, 4, 3 } } };
  static constexpr ShapeTraits wedge = { 6, 5,
    { { 3, { 0, 2, 1 } }, { 3, { 3, 4, 5 } }, { 4, { 0, 1, 4, 3 } }, { 4, { 1, 2, 5, 4 } },
      { 4, { 2, 0, 3, 5 } } },
    { 0, 1, 2, 2, 3, 4, 5, 5 },
    { { 1, 2, 3 }, { 0, 2, 4 }, { 0, 1, 5 }, { 4, 5, 0 }, { 3, 5, 1 }, { 3, 4, 2 } } };
  static constexpr ShapeTraits pyramid = { 5, 5,
    { { 4, { 0, 3, 2, 1 } }, { 3, { 0, 1, 4 } }, { 3, { 1, 2, 4 } }, { 3, { 2, 3, 4 } },
      { 3, { 3, 0, 4 } } },
    { 0, 1, 3, 2, 4, 4, 4, 4 }, { { 1, 3, 4 }, { 0, 2, 4 }, { 3, 1, 4 }, { 2, 0, 4 } } };
  static constexpr ShapeTraits none = {};
  switch (shape)
  {
    case CellShape::Tetrahedron:
      return tetrahedron;
    case CellShape::Voxel:
      return voxel;
    case CellShape::Hexahedron:
      return hexahedron;
    case CellShape::Wedge:
      return wedge;
    case CellShape::Pyramid:
      return pyramid;
  }
  return none;
}

/// Turns the values of corners, behind their coordinates, into differences from an isovalue. For
/// the scale, see GetValueScale.
template <int Corners>
void SubtractIsovalue(double isovalue, double scale, double (&corners)[Corners][4])
{
  for (auto& corner : corners)
  {
    corner[3] = Difference(corner[3], isovalue, scale);
  }
}

/// The same for some cells.
template <int Corners>
void SubtractIsovalue(double isovalue, double scale, double (*cells)[Corners][4], int count)
{
  for (int i = 0; i < count; ++i)
  {
    SubtractIsovalue(isovalue, scale, cells[i]);
  }
}

/// The corners of the trilinear cell of any function of the corners of a cell.
template <typename Function>
CellCorners MakeTrilinear(const MeshCell& cell, const Function& function)
{
  const ShapeTraits& traits = GetTraits(cell.Shape);
  CellCorners corners;
  for (std::size_t i = 0; i < 8; ++i)
  {
    corners[i] = function(traits.Trilinear[i]);
  }
  return corners;
}

/// The derivatives of the points of the trilinear cell in its middle, by its coordinates, given the
/// points of the corners of a cell.
template <typename Function>
std::array<Vector3, 3> GetMiddleEdges(const MeshCell& cell, const Function& getPoint)
{
  const ShapeTraits& traits = GetTraits(cell.Shape);
  std::array<Vector3, 3> edges = {};
  for (int i = 0; i < 8; ++i)
  {
    const Vector3 point = getPoint(traits.Trilinear[i]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      edges[axis] = edges[axis] + point * ((i >> axis & 1) != 0 ? 0.25 : -0.25);
    }
  }
  return edges;
}

}

#endif
