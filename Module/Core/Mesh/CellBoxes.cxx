// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellBoxes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Steps = 255.0;

/// More than single precision loses in the sum of a side, in parts of its terms.
constexpr float Rounding = 1e-6F;

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
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(this->Blocks.size()); ++i)
  {
    const auto number = static_cast<std::size_t>(i);
    Block& block = this->Blocks[number];
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
  const CellTreeNode& node, int child, const Bounds& box, int cell, Block& block)
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

//------------------------------------------------------------------------------
unsigned int CellBoxes::FindMet(
  const CellTree& tree, std::size_t number, const double (*sides)[4], int count) const
{
  const Block& block = this->Blocks[number];
  const CellTreeNode& node = tree.GetNode(0, number / CellTree::Width);
  const auto child = static_cast<int>(number % CellTree::Width);
  float least[CellTree::Width];
  std::fill(std::begin(least), std::end(least), HUGE_VALF);
  for (int i = 0; i < count; ++i)
  {
    double base = sides[i][3];
    float steps[3];
    const std::uint8_t* ends[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double low = static_cast<double>(node.Lower[axis][child]);
      const double high = static_cast<double>(node.Upper[axis][child]);
      base += sides[i][axis] * low;
      steps[axis] = static_cast<float>(sides[i][axis] * ((high - low) / Steps));
      ends[axis] = block.Ends[sides[i][axis] > 0.0 ? 3 + axis : axis];
    }
    auto first = static_cast<float>(base);
    const float size = std::abs(first) +
      static_cast<float>(Steps) * (std::abs(steps[0]) + std::abs(steps[1]) + std::abs(steps[2]));
    first += Rounding * size;
    for (int cell = 0; cell < CellTree::Width; ++cell)
    {
      const float sum = first + steps[0] * static_cast<float>(ends[0][cell]) +
        steps[1] * static_cast<float>(ends[1][cell]) + steps[2] * static_cast<float>(ends[2][cell]);
      least[cell] = std::min(least[cell], sum);
    }
  }
  unsigned int met = 0;
  for (int cell = 0; cell < CellTree::Width; ++cell)
  {
    // Undefined sums are met, too.
    met |= static_cast<unsigned int>(!(least[cell] < 0.0F)) << cell;
  }
  return met;
}

}
