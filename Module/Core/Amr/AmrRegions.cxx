// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrRegions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The places along an axis where the patches of a region can be parted: none reaches across.
std::vector<int> FindGaps(const AmrPatches& patches, const AmrRegion& region, std::size_t axis)
{
  std::vector<std::pair<int, int>> ranges;
  for (const std::size_t number : region.Patches)
  {
    const int first = patches.Get(number).First[axis];
    ranges.emplace_back(first, first + patches.Get(number).Cells[axis]);
  }
  std::sort(ranges.begin(), ranges.end());
  std::vector<int> gaps;
  int end = ranges.front().second;
  for (const auto& range : ranges)
  {
    if (range.first >= end)
    {
      gaps.push_back(range.first);
    }
    end = std::max(end, range.second);
  }
  return gaps;
}

/// A plane between patches.
struct Cut
{
  std::size_t Axis;
  int Place;
};

/// The cut of a region that is the nearest to the middle, in parts of its size.
std::optional<Cut> FindCut(const AmrPatches& patches, const AmrRegion& region)
{
  std::optional<Cut> cut;
  double nearest = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const int place : FindGaps(patches, region, axis))
    {
      const double part = static_cast<double>(place - region.First[axis]) / region.Cells[axis];
      if (std::abs(part - 0.5) < nearest)
      {
        nearest = std::abs(part - 0.5);
        cut = Cut{ axis, place };
      }
    }
  }
  return cut;
}

/// With the box around some patches of a level.
AmrRegion MakeRegion(const AmrPatches& patches, std::vector<std::size_t>&& numbers)
{
  const AmrPatch& one = patches.Get(numbers.front());
  AmrRegion region = { one.Level, one.First, one.Cells, std::move(numbers) };
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = patches.Get(number);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int first = std::min(region.First[axis], patch.First[axis]);
      const int end =
        std::max(region.First[axis] + region.Cells[axis], patch.First[axis] + patch.Cells[axis]);
      region.First[axis] = first;
      region.Cells[axis] = end - first;
    }
  }
  return region;
}

/// Whether patches that do not overlap fill the box of a region, and are of one kind.
bool IsFilled(const AmrPatches& patches, const AmrRegion& region)
{
  const int kind = patches.Get(region.Patches.front()).Kind;
  std::size_t cells = 0;
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = patches.Get(number);
    cells += patch.Kind == kind ? Count(patch.Cells) : 0;
  }
  return cells == Count(region.Cells);
}

/// Cuts patches that do not overlap apart until they fill boxes, and appends these.
void Split(const AmrPatches& patches, AmrRegion&& region, std::vector<AmrRegion>& regions)
{
  if (IsFilled(patches, region))
  {
    regions.push_back(std::move(region));
    return;
  }
  const std::optional<Cut> cut = FindCut(patches, region);
  if (!cut)
  {
    for (const std::size_t number : region.Patches)
    {
      regions.push_back(MakeRegion(patches, { number }));
    }
    return;
  }
  const auto middle = std::stable_partition(region.Patches.begin(), region.Patches.end(),
    [&](std::size_t number) { return patches.Get(number).First[cut->Axis] < cut->Place; });
  Split(patches, MakeRegion(patches, { region.Patches.begin(), middle }), regions);
  Split(patches, MakeRegion(patches, { middle, region.Patches.end() }), regions);
}

}

//------------------------------------------------------------------------------
std::vector<AmrRegion> MakeAmrRegions(const AmrPatches& patches, int cells)
{
  std::vector<AmrRegion> regions;
  for (int i = 0; i < patches.GetNumberOfLevels(); ++i)
  {
    const AmrPatches::Level& level = patches.GetLevel(i);
    std::map<Index3, std::vector<std::size_t>> cubes;
    for (const std::size_t number : level.Numbers)
    {
      const AmrPatch& patch = patches.Get(number);
      Index3 cube;
      bool isInCube = !level.HasOverlaps;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cube[axis] = FloorDivide(patch.First[axis], cells);
        isInCube =
          isInCube && FloorDivide(patch.First[axis] + patch.Cells[axis] - 1, cells) == cube[axis];
      }
      if (isInCube)
      {
        cubes[cube].push_back(number);
      }
      else
      {
        regions.push_back(MakeRegion(patches, { number }));
      }
    }
    for (auto& [cube, numbers] : cubes)
    {
      Split(patches, MakeRegion(patches, std::move(numbers)), regions);
    }
  }
  return regions;
}

//------------------------------------------------------------------------------
std::size_t FindPatch(const AmrPatches& patches, const AmrRegion& region, const Index3& cell)
{
  std::size_t found = region.Patches.front();
  if (region.Patches.size() > 1)
  {
    const AmrPatches::Level& level = patches.GetLevel(region.Level);
    const Bounds ofCell = GetBox(cell, { 1, 1, 1 });
    level.ForEachIn(ofCell, [&](std::size_t number) { found = number; });
  }
  return found;
}

}
