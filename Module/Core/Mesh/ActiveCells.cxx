// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/ActiveCells.h"

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
  std::uint32_t numbers[CellTree::Width];
  const int count = this->Tree->GetNumberOfCells(block);
  for (int i = 0; i < count; ++i)
  {
    numbers[i] = this->Tree->GetCell(block, i);
  }
  unsigned int active = 0;
  for (unsigned int left = this->Cells->FindStraddling(numbers, count, this->Isovalue); left != 0;
       left &= left - 1)
  {
    MeshCell cell;
    const int i = __builtin_ctz(left);
    active |= this->Cells->Load(numbers[i], cell) ? 1U << i : 0U;
  }
  this->Masks[block].store(active | Known, std::memory_order_relaxed);
  return active;
}

}
