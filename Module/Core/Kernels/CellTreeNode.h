// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTreeNode_h
#define CellTreeNode_h

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// A node of a tree over the cells of a mesh: the boxes and the ranges of values of its children. A
/// child without cells has a range with Low > High.
struct alignas(64) CellTreeNode
{
  /// The number of children of a node.
  static constexpr int Width = 16;

  float Lower[3][Width];
  float Upper[3][Width];
  float Low[Width];
  float High[Width];
};

/// A place as it is compared with nodes: for each coordinate the largest float that is not above it
/// and the smallest that is not below it; and what the values of a child must reach.
struct PlaceInBoxes
{
  float Below[3];
  float Above[3];
  float LeastHigh;
};

/// The boxes of the cells in a block, which is a child of a node without nodes below it: 6 bytes a
/// cell.
struct BlockOfBoxes
{
  /// The steps in which the box of the block is divided along each axis.
  static constexpr int Steps = 255;

  /// The lower ends along each axis, then the upper ones.
  std::uint8_t Ends[6][CellTreeNode::Width];
};

}

#endif
