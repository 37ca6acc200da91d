// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceLattices.h"

#include "vtkIsosurfaceRayTraceBlock.h"
#include "vtkIsosurfaceRayTraceGeometry.h"

#include "vtkImageData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace vtkIsosurfaceRayTraceLattices
{
namespace
{

using Block = vtkIsosurfaceRayTraceBlock;
using Leaf = vtkIsosurfaceRayTraceLeaf;

/// A thousandth of a cell is less than is visible, and more than the rounding of coordinates that
/// were written as text.
constexpr double Slack = 1e-3;

/// Blocks on the lattice of the first, and the box of them, in its indices.
struct Lattice
{
  std::vector<std::size_t> Blocks;
  vtkirt::Index3 Low;
  vtkirt::Index3 High;
  double Samples = 0.0;

  void Add(std::size_t number, const vtkirt::Index3& first, const vtkirt::Index3& points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = first[axis] + points[axis];
      this->Low[axis] = this->Blocks.empty() ? first[axis] : std::min(this->Low[axis], first[axis]);
      this->High[axis] = this->Blocks.empty() ? last : std::max(this->High[axis], last);
    }
    this->Blocks.push_back(number);
    this->Samples += static_cast<double>(vtkirt::Count(points));
  }

  /// Whether the box has no more samples than a few times those of the blocks, all of which are
  /// held in memory if they are joined.
  bool IsDense() const
  {
    constexpr double most = 8.0;
    double box = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      box *= static_cast<double>(this->High[axis]) - this->Low[axis];
    }
    return box <= 0x1p20 || box <= most * this->Samples;
  }
};

/// Lattices by what those of two blocks on one have in common, or nearly: the spacing, and the
/// place of the samples within a cell.
class Index
{
public:
  /// The lattice of a block, which becomes a new one if there is none.
  Lattice& Find(const std::vector<Leaf>& leaves, std::size_t number, std::vector<Lattice>& lattices)
  {
    auto* image = vtkImageData::SafeDownCast(leaves[number].Data);
    const vtkirt::Index3 points = vtkIsosurfaceRayTraceGeometry::GetDimensions(image);
    std::array<std::array<std::int64_t, 2>, 6> steps;
    Quantize(image, steps);
    // What is near the border of a step may be in the next.
    for (int choice = 0; choice < 64; ++choice)
    {
      Key key;
      bool isOther = true;
      for (std::size_t i = 0; i < 6; ++i)
      {
        const bool isSecond = (choice >> i & 1) != 0;
        isOther = isOther && !(isSecond && steps[i][0] == steps[i][1]);
        key[i] = steps[i][isSecond ? 1 : 0];
      }
      const auto found = isOther ? this->Lattices.find(key) : this->Lattices.end();
      if (found == this->Lattices.end())
      {
        continue;
      }
      for (const std::size_t candidate : found->second)
      {
        Lattice& lattice = lattices[candidate];
        const Leaf& ofFirst = leaves[lattice.Blocks.front()];
        vtkirt::Index3 first;
        if (ofFirst.Display.Opacity == leaves[number].Display.Opacity &&
          FindFirstPoint(vtkImageData::SafeDownCast(ofFirst.Data), image, first))
        {
          lattice.Add(number, first, points);
          return lattice;
        }
      }
    }
    this->Lattices[{ steps[0][0], steps[1][0], steps[2][0], steps[3][0], steps[4][0], steps[5][0] }]
      .push_back(lattices.size());
    lattices.emplace_back();
    const int* extent = image->GetExtent();
    lattices.back().Add(number, { extent[0], extent[2], extent[4] }, points);
    return lattices.back();
  }

private:
  using Key = std::array<std::int64_t, 6>;

  /// The steps that numbers of a lattice are in, and those that they would be in if they were a
  /// little larger or smaller.
  static void Quantize(vtkImageData* image, std::array<std::array<std::int64_t, 2>, 6>& steps)
  {
    const double zero[3] = { 0.0, 0.0, 0.0 };
    vtkirt::Vector3 origin;
    image->TransformPhysicalPointToContinuousIndex(zero, origin.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      constexpr double parts = 16.0;
      const double place = origin[axis] - std::floor(origin[axis]);
      const auto step = [](double part)
      {
        const auto whole = static_cast<std::int64_t>(std::floor(part * parts));
        return (whole + static_cast<std::int64_t>(parts)) % static_cast<std::int64_t>(parts);
      };
      steps[axis] = { step(place), step(place + Slack) };
      if (steps[axis][0] == steps[axis][1])
      {
        steps[axis][1] = step(place - Slack);
      }
      constexpr double perDoubling = 32.0;
      const double size = perDoubling * std::log2(std::abs(image->GetSpacing()[axis]));
      steps[3 + axis] = { static_cast<std::int64_t>(std::floor(size)),
        static_cast<std::int64_t>(std::floor(size + Slack * perDoubling)) };
      if (steps[3 + axis][0] == steps[3 + axis][1])
      {
        steps[3 + axis][1] = static_cast<std::int64_t>(std::floor(size - Slack * perDoubling));
      }
    }
  }

  std::map<Key, std::vector<std::size_t>> Lattices;
};

}

//------------------------------------------------------------------------------
bool FindFirstPoint(vtkImageData* lattice, vtkImageData* block, vtkirt::Index3& first)
{
  // If four corners are on lattice points, all points are.
  const int* extent = block->GetExtent();
  for (int corner = 0; corner < 4; ++corner)
  {
    vtkirt::Index3 offset = { 0, 0, 0 };
    vtkirt::Index3 index = { extent[0], extent[2], extent[4] };
    if (corner > 0)
    {
      const auto axis = static_cast<std::size_t>(corner - 1);
      offset[axis] = extent[2 * axis + 1] - extent[2 * axis];
      index = Block::Add(index, offset);
    }
    vtkirt::Vector3 point;
    vtkirt::Vector3 position;
    block->TransformIndexToPhysicalPoint(index.data(), point.data());
    lattice->TransformPhysicalPointToContinuousIndex(point.data(), position.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double whole = std::round(position[axis]);
      if (!(std::abs(position[axis] - whole) <= Slack) || !(std::abs(whole) < 0x1p30))
      {
        return false;
      }
      if (corner == 0)
      {
        first[axis] = static_cast<int>(whole);
      }
      else if (static_cast<int>(whole) != first[axis] + offset[axis])
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
std::vector<std::vector<Leaf>> Group(const std::vector<Leaf>& grids)
{
  std::vector<Lattice> lattices;
  Index index;
  std::vector<std::vector<Leaf>> groups;
  std::vector<std::size_t> lone;
  for (std::size_t i = 0; i < grids.size(); ++i)
  {
    if (vtkImageData::SafeDownCast(grids[i].Data))
    {
      index.Find(grids, i, lattices);
    }
    else
    {
      lone.push_back(i);
    }
  }
  for (const Lattice& lattice : lattices)
  {
    if (!lattice.IsDense())
    {
      lone.insert(lone.end(), lattice.Blocks.begin(), lattice.Blocks.end());
      continue;
    }
    groups.emplace_back();
    for (const std::size_t number : lattice.Blocks)
    {
      groups.back().push_back(grids[number]);
    }
  }
  std::sort(lone.begin(), lone.end());
  for (const std::size_t number : lone)
  {
    groups.push_back({ grids[number] });
  }
  return groups;
}

}

VTK_ABI_NAMESPACE_END
