// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ExactMesh_h
#define ExactMesh_h

#include "ExactCrossings.h"

#include <cstdint>
#include <vector>

// The oracle for meshes: where a line crosses an isosurface of the interpolant of a cell. Every
// cell is looked at by itself, in 113 bits. It shares no code with the ray tracer.

namespace Oracle
{

/// Four to eight corners, in the order of VTK's tetrahedron, pyramid, wedge or hexahedron: the
/// number tells which it is.
struct Cell
{
  std::vector<Triple> Points;
  std::vector<double> Values;
};

/// A crossing of the surface by the line.
struct CellRoot
{
  std::int64_t Cell;
  Quad T;
  /// The change of the value along the line, per length of the line, in units of the largest
  /// difference between a corner and the isovalue, and of the size of the cell.
  double Slope;
  /// The largest change of the value, and of a parametric coordinate, along any axis of space, in
  /// the same units: how much they suffer from the rounding of positions.
  double Steepness;
  double Stretch;
  /// The smallest distance of the root's parametric coordinates from a face.
  double FromFace;
};

/// The largest extent of a cell along an axis.
double GetSize(const Cell& cell);

/// The largest coordinate of a cell: positions are rounded in proportion to it.
double GetLargestCoordinate(const Cell& cell);

/// The roots in one cell, in no order. Those of a tetrahedron are exact. In the others Newton's
/// method starts from a lattice of points, so many along each axis: dense enough, it finds all.
std::vector<CellRoot> FindRoots(
  const Cell& cell, std::int64_t number, double isovalue, const Line& line, int starts);

/// Value minus isovalue, in units of the largest such difference at the corners, at the point of
/// the cell nearest to that of the line at t; and how far that is beside it, in sizes of the cell.
struct Residual
{
  double Value;
  double Beside;
};
Residual GetResidual(
  const Cell& cell, double isovalue, const Line& line, double t, const Triple& parametric);

}

#endif
