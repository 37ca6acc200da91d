// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellBoxes_h
#define CellBoxes_h

#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The boxes of the cells in the blocks of a tree, each in 256 steps of the box of its block: 6
/// bytes a cell.
class CellBoxes
{
public:
  CellBoxes(const MeshCells& cells, const CellTree& tree, int threads);

  /// Finds the cells of a block whose boxes reach above all of some sides; a bit for each. A side
  /// is a row whose product with (x, y, z, 1) is positive above it; it may be off by what single
  /// precision loses.
  unsigned int FindMet(
    const CellTree& tree, std::size_t block, const double (*sides)[4], int count) const;

  std::size_t GetMemory() const { return this->Blocks.capacity() * sizeof(Block); }

private:
  struct Block
  {
    /// The lower ends along each axis, then the upper ones.
    std::uint8_t Ends[6][CellTree::Width];
  };

  static void SetBox(
    const CellTreeNode& node, int child, const Bounds& box, int cell, Block& block);

  std::vector<Block> Blocks;
};

}

#endif
