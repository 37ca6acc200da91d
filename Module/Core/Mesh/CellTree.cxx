// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellTree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr float FloatInfinity = std::numeric_limits<float>::infinity();

/// The box and the range of values of some cells.
struct Extent
{
  Bounds Box = { { Infinity, Infinity, Infinity }, { -Infinity, -Infinity, -Infinity } };
  double Low = Infinity;
  double High = -Infinity;

  void Include(const MeshCell& cell)
  {
    for (int i = 0; i < cell.Count; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        this->Box.Lower[axis] = std::min(this->Box.Lower[axis], cell.Points[i][axis]);
        this->Box.Upper[axis] = std::max(this->Box.Upper[axis], cell.Points[i][axis]);
      }
      this->Low = std::min(this->Low, cell.Values[i]);
      this->High = std::max(this->High, cell.Values[i]);
    }
  }

  void Include(const Extent& other)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Box.Lower[axis] = std::min(this->Box.Lower[axis], other.Box.Lower[axis]);
      this->Box.Upper[axis] = std::max(this->Box.Upper[axis], other.Box.Upper[axis]);
    }
    this->Low = std::min(this->Low, other.Low);
    this->High = std::max(this->High, other.High);
  }
};

float RoundDown(double value)
{
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value ? std::nextafterf(rounded, -FloatInfinity) : rounded;
}

float RoundUp(double value)
{
  return -RoundDown(-value);
}

/// Two zeros before each of the lower ten bits.
std::uint32_t Spread(std::uint32_t bits)
{
  bits = (bits | bits << 16U) & 0x030000ffU;
  bits = (bits | bits << 8U) & 0x0300f00fU;
  bits = (bits | bits << 4U) & 0x030c30c3U;
  bits = (bits | bits << 2U) & 0x09249249U;
  return bits;
}

void SetChild(CellTreeNode& node, int child, const Extent& extent, double margin)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    node.Lower[axis][child] = RoundDown(extent.Box.Lower[axis] - margin);
    node.Upper[axis][child] = RoundUp(extent.Box.Upper[axis] + margin);
  }
  node.Low[child] = RoundDown(extent.Low);
  node.High[child] = RoundUp(extent.High);
}

}

//------------------------------------------------------------------------------
CellTree::CellTree(const MeshCells& cells, int threads)
{
  this->SortCells(cells, threads);
  if (this->Order.empty())
  {
    return;
  }
  this->BuildLeaves(cells, threads);
  while (this->Levels.back().size() > 1)
  {
    this->BuildLevelAbove(threads);
  }
}

//------------------------------------------------------------------------------
/// Finds the extent of all cells, and puts those that are traced in order.
void CellTree::SortCells(const MeshCells& cells, int threads)
{
  const std::int64_t count = cells.GetNumberOfCells();
  Extent whole;
  std::vector<std::uint64_t> keys(static_cast<std::size_t>(count));
#pragma omp declare reduction(unite:Extent : omp_out.Include(omp_in))
#pragma omp parallel for schedule(static) num_threads(threads) reduction(unite : whole)
  for (std::int64_t i = 0; i < count; ++i)
  {
    MeshCell cell;
    if (cells.Load(i, cell))
    {
      whole.Include(cell);
    }
  }
  this->Box = whole.Box;
  this->Low = whole.Low;
  this->High = whole.High;
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    longest = std::max(longest, 0.5 * this->Box.Upper[axis] - 0.5 * this->Box.Lower[axis]);
  }
  constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i)
  {
    MeshCell cell;
    if (!cells.Load(i, cell))
    {
      keys[static_cast<std::size_t>(i)] = none;
      continue;
    }
    std::uint32_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double sum = 0.0;
      for (int corner = 0; corner < cell.Count; ++corner)
      {
        // Half of each: the whole extent may overflow.
        sum += (0.5 * cell.Points[corner][axis] - 0.5 * this->Box.Lower[axis]) / cell.Count;
      }
      const double part = longest > 0.0 ? sum / longest : 0.0;
      code |= Spread(static_cast<std::uint32_t>(std::clamp(part, 0.0, 1.0) * 1023.0)) << axis;
    }
    keys[static_cast<std::size_t>(i)] =
      std::uint64_t{ code } << 32U | static_cast<std::uint32_t>(i);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::lower_bound(keys.begin(), keys.end(), none), keys.end());
  this->Order.resize(keys.size());
  std::transform(keys.begin(), keys.end(), this->Order.begin(),
    [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
}

//------------------------------------------------------------------------------
void CellTree::BuildLeaves(const MeshCells& cells, int threads)
{
  // What the arithmetic of rays may lose, many times over; and boxes without a thickness get one.
  double margin = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    margin = std::max({ margin, std::abs(this->Box.Lower[axis]), std::abs(this->Box.Upper[axis]) });
  }
  margin = margin * 0x1p-40 + static_cast<double>(std::numeric_limits<float>::min());
  const std::size_t blocks = (this->Order.size() + Width - 1) / Width;
  std::vector<CellTreeNode> nodes((blocks + Width - 1) / Width);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(nodes.size()); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    for (int child = 0; child < Width; ++child)
    {
      const std::size_t first = (node * Width + static_cast<std::size_t>(child)) * Width;
      Extent extent;
      for (std::size_t k = first; k < std::min(first + Width, this->Order.size()); ++k)
      {
        MeshCell cell;
        cells.Load(this->Order[k], cell);
        extent.Include(cell);
      }
      SetChild(nodes[node], child, extent, margin);
    }
  }
  this->Levels.push_back(std::move(nodes));
}

//------------------------------------------------------------------------------
void CellTree::BuildLevelAbove(int threads)
{
  const std::vector<CellTreeNode>& below = this->Levels.back();
  std::vector<CellTreeNode> nodes((below.size() + Width - 1) / Width);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(nodes.size()); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    for (int child = 0; child < Width; ++child)
    {
      const std::size_t number = node * Width + static_cast<std::size_t>(child);
      Extent extent;
      for (int k = 0; number < below.size() && k < Width; ++k)
      {
        const CellTreeNode& children = below[number];
        Extent one;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          one.Box.Lower[axis] = static_cast<double>(children.Lower[axis][k]);
          one.Box.Upper[axis] = static_cast<double>(children.Upper[axis][k]);
        }
        one.Low = static_cast<double>(children.Low[k]);
        one.High = static_cast<double>(children.High[k]);
        extent.Include(one);
      }
      SetChild(nodes[node], child, extent, 0.0);
    }
  }
  this->Levels.push_back(std::move(nodes));
}

//------------------------------------------------------------------------------
std::size_t CellTree::GetMemory() const
{
  std::size_t memory = this->Order.capacity() * sizeof(this->Order[0]);
  for (const std::vector<CellTreeNode>& level : this->Levels)
  {
    memory += level.capacity() * sizeof(CellTreeNode);
  }
  return memory;
}

}
