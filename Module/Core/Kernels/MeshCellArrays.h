// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCellArrays_h
#define MeshCellArrays_h

#include "Kernels/CellTreeNode.h"

#include <cstddef>
#include <cstdint>

// What kernels read of the cells of a mesh, and what they find in them, in arrays.

namespace vtkIsosurfaceRayTracing
{

/// Trilinear cells that a surface passes: of each corner the coordinates, and the difference of its
/// value from the isovalue.
struct PassedCellRecords
{
  static constexpr int Capacity = CellTreeNode::Width;
  static constexpr int Corners = 8;

  alignas(64) double Corner[Capacity][Corners][4];
};

/// The points of a mesh and their values, in the memory of its owner; see MeshView.
struct PointArrays
{
  /// Of floats or doubles: x, y and z of each.
  const void* Points;
  bool AreFloats;
  const void* Values;
  std::ptrdiff_t ValueStride;
};

/// The boxes and the ranges of values of some cells: x, y, z and value.
struct CellExtents
{
  static constexpr int Capacity = CellTreeNode::Width;

  double Lower[Capacity][4];
  double Upper[Capacity][4];
  /// The cells without a number that is not finite; a bit for each.
  unsigned int Finite;
  /// Of these: the extent of all, and the sum of half the surfaces of the boxes.
  double LowerOfAll[4];
  double UpperOfAll[4];
  double Area;
};

/// The gradients in some tetrahedra, each multiplied by a weight: six times the volume.
struct WeightedGradients
{
  static constexpr int Capacity = CellTreeNode::Width;

  alignas(64) double Gradient[3][Capacity];
  alignas(64) double Weight[Capacity];
};

/// The gradients at the corners of some hexahedra, each multiplied by the volume, or not finite
/// where edges are in one plane.
struct CornerGradients
{
  static constexpr int Capacity = CellTreeNode::Width;

  alignas(64) double Gradient[PassedCellRecords::Corners][3][Capacity];
  /// By the edges in the middle. Not finite where a number of the cell is not.
  alignas(64) double Volume[Capacity];
};

/// The corners of the cells of some hits, and their weights there.
struct WeightedCorners
{
  static constexpr int Capacity = 2 * CellTreeNode::Width;

  int Count;
  int Corners[Capacity];
  std::int64_t Ids[Capacity][PassedCellRecords::Corners];
  double Weights[Capacity][PassedCellRecords::Corners];
};

}

#endif
