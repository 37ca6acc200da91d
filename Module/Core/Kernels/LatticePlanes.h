// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LatticePlanes_h
#define LatticePlanes_h

namespace vtkIsosurfaceRayTracing
{

/// Where a cell stands along one axis, for single precision.
struct CellSpan
{
  /// Its lower plane, counted from the first of its block.
  float Lower;
  float Width;
  /// One over the width; infinite if the cell is flat.
  float InverseWidth;
  /// That of the block.
  float Extent;
};

/// The planes of a block of 8 cells along one axis.
struct BlockPlanes
{
  static constexpr int Edge = 8;

  /// The coordinate of the first plane, and from there to the last.
  double First;
  double Extent;
  /// All of them, counted from the first.
  float Planes[Edge + 1];
  CellSpan Cells[Edge];
};

/// The lattice planes of a volume along its axes, where they are not evenly spaced: the coordinates
/// of each, and blocks of them.
struct LatticePlanes
{
  const double* Coordinates[3];
  const BlockPlanes* Blocks[3];
};

}

#endif
