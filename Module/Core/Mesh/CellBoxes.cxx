// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellBoxes.h"

#include "Math/ThreadsOfLoop.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Steps = BlockOfBoxes::Steps;

Bounds FindBox(const MeshCell& cell)
{
  Bounds box = NoBounds();
  for (int i = 0; i < cell.Count; ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box.Lower[axis] = std::min(box.Lower[axis], cell.Points[i][axis]);
      box.Upper[axis] = std::max(box.Upper[axis], cell.Points[i][axis]);
    }
  }
  return box;
}

}

//------------------------------------------------------------------------------
CellBoxes::CellBoxes(const MeshCells& cells, const CellTree& tree, int threads)
  : Blocks(tree.GetNumberOfBlocks())
{
#pragma omp parallel for schedule(static)                                                          \
  num_threads(GetThreadsOfLoop(this->Blocks.size(), 300.0, threads))
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(this->Blocks.size()); ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    BlockOfBoxes& block = this->Blocks[number];
    // Whatever cannot be read is as large as its block.
    std::memset(block.Ends, 0, 3 * CellTree::Width);
    std::memset(block.Ends + 3, 0xff, 3 * CellTree::Width);
    const CellTreeNode& node = tree.GetNode(0, number / CellTree::Width);
    const auto child = static_cast<int>(number % CellTree::Width);
    for (int k = 0; k < tree.GetNumberOfCells(number); ++k)
    {
      MeshCell cell;
      if (cells.Load(tree.GetCell(number, k), cell))
      {
        SetBox(node, child, FindBox(cell), k, block);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Rounds a box outward.
void CellBoxes::SetBox(
  const CellTreeNode& node, int child, const Bounds& box, int cell, BlockOfBoxes& block)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = static_cast<double>(node.Lower[axis][child]);
    const double scale = Steps / (static_cast<double>(node.Upper[axis][child]) - low);
    const double margin = 0x1p-10;
    const double first = std::floor((box.Lower[axis] - low) * scale - margin);
    const double last = std::ceil((box.Upper[axis] - low) * scale + margin);
    // Not where a number is not finite.
    if (first <= last)
    {
      block.Ends[axis][cell] = static_cast<std::uint8_t>(std::clamp(first, 0.0, Steps));
      block.Ends[3 + axis][cell] = static_cast<std::uint8_t>(std::clamp(last, 0.0, Steps));
    }
  }
}

}
