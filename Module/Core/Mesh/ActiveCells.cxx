// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/ActiveCells.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
ActiveCells::ActiveCells(const MeshCells& cells, const CellTree& tree, double isovalue)
  : Cells(&cells)
  , Tree(&tree)
  , Isovalue(isovalue)
  , Blocks(tree.GetNumberOfBlocks())
  , Masks(new std::atomic<std::uint32_t>[this->Blocks]())
{
}

//------------------------------------------------------------------------------
unsigned int ActiveCells::Find(std::size_t block)
{
  std::uint32_t mask = 0;
  for (int i = 0; i < this->Tree->GetNumberOfCells(block); ++i)
  {
    MeshCell cell;
    if (!this->Cells->Load(this->Tree->GetCell(block, i), cell))
    {
      continue;
    }
    const auto [low, high] = std::minmax_element(cell.Values, cell.Values + cell.Count);
    const bool isActive = *low < this->Isovalue && this->Isovalue <= *high;
    mask |= static_cast<std::uint32_t>(isActive) << i;
  }
  this->Masks[block].store(mask | Known, std::memory_order_relaxed);
  return mask;
}

}
