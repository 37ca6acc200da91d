// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CellTree.h"

#include "Math/RoundOutward.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Behind all keys.
constexpr std::uint64_t NoKey = std::numeric_limits<std::uint64_t>::max();

/// Sorts keys by their upper halves, digit by digit. Those with the same one stay in order.
void SortByCode(std::vector<std::uint64_t>& keys)
{
  constexpr unsigned int bits = 11;
  constexpr std::uint64_t digits = std::uint64_t{ 1 } << bits;
  std::vector<std::uint64_t> sorted(keys.size());
  for (unsigned int shift = 32; shift < 64; shift += bits)
  {
    const auto getDigit = [shift](std::uint64_t key) { return (key >> shift) % digits; };
    std::vector<std::size_t> places(digits + 1, 0);
    for (const std::uint64_t key : keys)
    {
      ++places[getDigit(key) + 1];
    }
    std::partial_sum(places.begin(), places.end(), places.begin());
    for (const std::uint64_t key : keys)
    {
      sorted[places[getDigit(key)]++] = key;
    }
    keys.swap(sorted);
  }
}

/// Sorts keys, and returns their lower halves, without those that are none.
std::vector<std::uint32_t> SortKeys(std::vector<std::uint64_t>& keys)
{
  SortByCode(keys);
  keys.erase(std::lower_bound(keys.begin(), keys.end(), NoKey), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
    [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  return order;
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

}

//------------------------------------------------------------------------------
/// The box and the range of values of some cells.
struct CellTree::Extent
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

  bool IsEmpty() const { return !(this->Low <= this->High); }

  /// Half of the surface of the box.
  double GetArea() const
  {
    const Vector3 size = this->Box.Upper - this->Box.Lower;
    return this->IsEmpty() ? 0.0 : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }

  void SetChild(CellTreeNode& node, int child, double margin) const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      node.Lower[axis][child] = RoundDown(this->Box.Lower[axis] - margin);
      node.Upper[axis][child] = RoundUp(this->Box.Upper[axis] + margin);
    }
    node.Low[child] = RoundDown(this->Low);
    node.High[child] = RoundUp(this->High);
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

//------------------------------------------------------------------------------
CellTree::CellTree(const MeshCells& cells, int threads)
  : Cells(static_cast<std::size_t>(cells.GetNumberOfCells()))
{
  std::vector<Extent> extents = this->FindBlocks(cells, threads);
  if (this->IsSorted)
  {
    extents = this->SortCells(cells, threads);
  }
  else
  {
    this->SortBlocks(extents, threads);
  }
  this->Blocks = extents.size();
  if (this->Blocks == 0)
  {
    return;
  }
  this->BuildLeaves(extents, threads);
  while (this->Levels.back().size() > 1)
  {
    this->BuildLevelAbove(threads);
  }
}

//------------------------------------------------------------------------------
/// Finds the extents of all cells and of blocks of consecutive ones, and decides by the surfaces of
/// these whether the cells must be sorted.
std::vector<CellTree::Extent> CellTree::FindBlocks(const MeshCells& cells, int threads)
{
  /// Sixteen cubes in a row have 0.7 of the surface of all of them; in a cluster, 0.4.
  constexpr double largestShare = 0.75;
  std::vector<Extent> extents((this->Cells + Width - 1) / Width);
  Extent whole;
  double areaOfCells = 0.0;
  double areaOfBlocks = 0.0;
#pragma omp declare reduction(unite:Extent : omp_out.Include(omp_in))
#pragma omp parallel for schedule(static) num_threads(threads) reduction(unite : whole)           \
  reduction(+ : areaOfCells, areaOfBlocks)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(extents.size()); ++i)
  {
    Extent& block = extents[static_cast<std::size_t>(i)];
    const std::int64_t first = i * Width;
    const std::int64_t last = std::min(first + Width, static_cast<std::int64_t>(this->Cells));
    for (std::int64_t number = first; number < last; ++number)
    {
      MeshCell cell;
      if (cells.Load(number, cell))
      {
        Extent extent;
        extent.Include(cell);
        areaOfCells += extent.GetArea();
        block.Include(extent);
      }
    }
    areaOfBlocks += block.GetArea();
    whole.Include(block);
  }
  this->Box = whole.Box;
  this->Low = whole.Low;
  this->High = whole.High;
  this->IsSorted = !(areaOfBlocks <= largestShare * areaOfCells);
  return extents;
}

//------------------------------------------------------------------------------
/// Three times ten bits, for the position in the whole box.
std::uint64_t CellTree::GetMortonCode(const Vector3& point) const
{
  double longest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Half of each: the whole extent may overflow.
    longest = std::max(longest, 0.5 * this->Box.Upper[axis] - 0.5 * this->Box.Lower[axis]);
  }
  std::uint32_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double way = 0.5 * point[axis] - 0.5 * this->Box.Lower[axis];
    const double part = longest > 0.0 ? way / longest : 0.0;
    code |= Spread(static_cast<std::uint32_t>(std::clamp(part, 0.0, 1.0) * 1023.0)) << axis;
  }
  return code;
}

//------------------------------------------------------------------------------
/// Puts the blocks in Morton order, without empty ones.
void CellTree::SortBlocks(std::vector<Extent>& extents, int threads)
{
  const auto blocks = static_cast<std::int64_t>(extents.size());
  std::vector<std::uint64_t> keys(extents.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < blocks; ++i)
  {
    const Extent& extent = extents[static_cast<std::size_t>(i)];
    const Vector3 middle = extent.Box.Lower * 0.5 + extent.Box.Upper * 0.5;
    keys[static_cast<std::size_t>(i)] =
      extent.IsEmpty() ? NoKey : this->GetMortonCode(middle) << 32U | static_cast<std::uint32_t>(i);
  }
  this->Order = SortKeys(keys);
  std::vector<Extent> sorted(this->Order.size());
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(sorted.size()); ++i)
  {
    const auto place = static_cast<std::size_t>(i);
    sorted[place] = extents[this->Order[place]];
  }
  extents = std::move(sorted);
}

//------------------------------------------------------------------------------
/// Puts the cells that are traced in Morton order, and finds the extents of their blocks.
std::vector<CellTree::Extent> CellTree::SortCells(const MeshCells& cells, int threads)
{
  std::vector<std::uint64_t> keys(this->Cells);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(keys.size()); ++i)
  {
    MeshCell cell;
    std::uint64_t& key = keys[static_cast<std::size_t>(i)];
    key = NoKey;
    if (cells.Load(i, cell))
    {
      Vector3 middle = {};
      for (int corner = 0; corner < cell.Count; ++corner)
      {
        middle = middle + cell.Points[corner] * (1.0 / cell.Count);
      }
      key = this->GetMortonCode(middle) << 32U | static_cast<std::uint32_t>(i);
    }
  }
  this->Order = SortKeys(keys);
  std::vector<Extent> extents((this->Order.size() + Width - 1) / Width);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(extents.size()); ++i)
  {
    const auto block = static_cast<std::size_t>(i);
    for (int k = 0; k < this->GetNumberOfCells(block); ++k)
    {
      MeshCell cell;
      cells.Load(this->GetCell(block, k), cell);
      extents[block].Include(cell);
    }
  }
  return extents;
}

//------------------------------------------------------------------------------
double CellTree::GetMargin() const
{
  double largest = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    largest =
      std::max({ largest, std::abs(this->Box.Lower[axis]), std::abs(this->Box.Upper[axis]) });
  }
  // Boxes without a thickness get one.
  return largest * 0x1p-40 + static_cast<double>(std::numeric_limits<float>::min());
}

//------------------------------------------------------------------------------
void CellTree::BuildLeaves(const std::vector<Extent>& extents, int threads)
{
  const double margin = this->GetMargin();
  std::vector<CellTreeNode> nodes((extents.size() + Width - 1) / Width);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(nodes.size()); ++i)
  {
    const auto node = static_cast<std::size_t>(i);
    for (int child = 0; child < Width; ++child)
    {
      const std::size_t block = node * Width + static_cast<std::size_t>(child);
      (block < extents.size() ? extents[block] : Extent{}).SetChild(nodes[node], child, margin);
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
      extent.SetChild(nodes[node], child, 0.0);
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
