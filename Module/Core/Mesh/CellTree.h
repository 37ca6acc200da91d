// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTree_h
#define CellTree_h

#include "Field/TracedField.h"
#include "Kernels/CellTreeNode.h"
#include "Mesh/MeshCells.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A tree over the cells of a mesh: in each node the boxes and the ranges of values of 16 children.
///
/// Cells are put in Morton order and taken in blocks of 16; the blocks are the leaves, and no node
/// needs a pointer (16 children each, level by level). The same tree serves every isovalue.
/// (J. Wilhelms, A. Van Gelder: Octrees for Faster Isosurface Generation, ACM TOG 11(3), 1992, have
/// ranges of values in a tree; S. G. Parker et al. 1998 trace rays through one.)
class CellTree
{
public:
  /// The number of children of a node, and of cells in a block.
  static constexpr int Width = CellTreeNode::Width;

  /// Builds the tree of all cells that are traced and finite. There may be up to 2^32 - 1 cells.
  CellTree(const MeshCells& cells, int threads);

  /// The box of all cells; Lower > Upper if there are none.
  const Bounds& GetBounds() const { return this->Box; }
  /// The smallest and the largest value.
  double GetLow() const { return this->Low; }
  double GetHigh() const { return this->High; }

  /// The levels of nodes, the root last. The children of the nodes of level 0 are blocks of cells.
  int GetNumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  const CellTreeNode& GetNode(int level, std::size_t node) const
  {
    return this->Levels[static_cast<std::size_t>(level)][node];
  }

  /// The numbers of the cells in tree order; block i has those from 16 i on.
  const std::vector<std::uint32_t>& GetOrder() const { return this->Order; }

  std::size_t GetMemory() const;

private:
  struct Leaves;

  void SortCells(const MeshCells& cells, int threads);
  void BuildLeaves(const MeshCells& cells, int threads);
  void BuildLevelAbove(int threads);

  Bounds Box;
  double Low;
  double High;
  std::vector<std::uint32_t> Order;
  std::vector<std::vector<CellTreeNode>> Levels;
};

}

#endif
