// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTreeNode_h
#define CellTreeNode_h

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

}

#endif
