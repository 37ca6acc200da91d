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
  , Blocks((tree.GetOrder().size() + CellTree::Width - 1) / CellTree::Width)
  , Masks(new std::atomic<std::uint32_t>[this->Blocks]())
{
}

//------------------------------------------------------------------------------
unsigned int ActiveCells::Find(std::size_t block)
{
  const std::vector<std::uint32_t>& order = this->Tree->GetOrder();
  const std::size_t first = block * CellTree::Width;
  const std::size_t last = std::min(first + CellTree::Width, order.size());
  std::uint32_t mask = 0;
  for (std::size_t i = first; i < last; ++i)
  {
    MeshCell cell;
    this->Cells->LoadIds(order[i], cell);
    this->Cells->LoadValues(cell);
    const auto [low, high] = std::minmax_element(cell.Values, cell.Values + cell.Count);
    const bool isActive = *low < this->Isovalue && this->Isovalue <= *high;
    mask |= static_cast<std::uint32_t>(isActive) << (i - first);
  }
  this->Masks[block].store(mask | Known, std::memory_order_relaxed);
  return mask;
}

}
