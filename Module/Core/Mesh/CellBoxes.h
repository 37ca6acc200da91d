// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellBoxes_h
#define CellBoxes_h

#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The boxes of the cells in the blocks of a tree.
class CellBoxes
{
public:
  CellBoxes(const MeshCells& cells, const CellTree& tree, int threads);

  const BlockOfBoxes& Get(std::size_t block) const { return this->Blocks[block]; }

  std::size_t GetMemory() const { return this->Blocks.capacity() * sizeof(BlockOfBoxes); }

private:
  static void SetBox(
    const CellTreeNode& node, int child, const Bounds& box, int cell, BlockOfBoxes& block);

  std::vector<BlockOfBoxes> Blocks;
};

}

#endif
