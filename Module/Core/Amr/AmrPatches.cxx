// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrPatches.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
AmrPatches::AmrPatches(std::vector<Index3> ratios, std::vector<AmrPatch> patches, bool ofCells)
  : OfCells(ofCells)
  , All(std::move(patches))
{
  for (const Index3& ratio : ratios)
  {
    this->Levels.push_back({ ratio, {}, nullptr });
  }
  for (std::size_t i = 0; i < this->All.size(); ++i)
  {
    this->Levels[static_cast<std::size_t>(this->All[i].Level)].Numbers.push_back(i);
  }
  for (Level& level : this->Levels)
  {
    std::vector<Bounds> boxes;
    for (const std::size_t number : level.Numbers)
    {
      const AmrPatch& patch = this->All[number];
      boxes.push_back(GetBox(patch.First, patch.Cells));
    }
    level.Tree = std::make_unique<BoundsTree>(boxes);
    level.HasOverlaps = this->HasOverlaps(level);
  }
}

//------------------------------------------------------------------------------
bool AmrPatches::HasOverlaps(const Level& level) const
{
  return std::any_of(level.Numbers.begin(), level.Numbers.end(),
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->All[number];
      const Bounds own = GetBox(patch.First, patch.Cells);
      int count = 0;
      level.ForEachIn(own, [&count](std::size_t) { ++count; });
      return count > 1;
    });
}

//------------------------------------------------------------------------------
const AmrPatch* AmrPatches::FindOwner(int level, const Index3& cell) const
{
  const Level& all = this->GetLevel(level);
  const Bounds ofCell = GetBox(cell, { 1, 1, 1 });
  const AmrPatch* owner = nullptr;
  all.ForEachIn(ofCell,
    [&](std::size_t number)
    {
      const AmrPatch* patch = &this->All[number];
      if (Owns(*patch, cell) && (!owner || patch < owner))
      {
        owner = patch;
      }
    });
  return owner;
}

//------------------------------------------------------------------------------
const AmrPatch* AmrPatches::FindOwner(int level, const Index3& cell, Likely& likely) const
{
  if (!this->GetLevel(level).HasOverlaps)
  {
    for (const AmrPatch* patch : likely.Patches)
    {
      if (patch && Owns(*patch, cell))
      {
        return patch;
      }
    }
  }
  const AmrPatch* owner = this->FindOwner(level, cell);
  if (owner)
  {
    likely.Patches[likely.Next] = owner;
    likely.Next = (likely.Next + 1) % likely.Patches.size();
  }
  return owner;
}

//------------------------------------------------------------------------------
bool AmrPatches::IsCoveredByFiner(int level, const Index3& cell) const
{
  Index3 inside = cell;
  for (int finer = level + 1; finer < this->GetNumberOfLevels(); ++finer)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      inside[axis] =
        inside[axis] * this->GetLevel(finer).Ratio[axis] + this->GetLevel(finer).Ratio[axis] / 2;
    }
    if (this->FindOwner(finer, inside))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool AmrPatches::IsCoveredByCoarser(int level, const Index3& cell, int coarsest) const
{
  Index3 around = cell;
  for (int coarser = level - 1; coarser >= coarsest; --coarser)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      around[axis] = FloorDivide(around[axis], this->GetLevel(coarser + 1).Ratio[axis]);
    }
    if (this->FindOwner(coarser, around))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool AmrPatches::IsShown(int level, const Index3& cell) const
{
  Index3 around = cell;
  for (int coarser = level; coarser >= 0; --coarser)
  {
    if (const AmrPatch* owner = this->FindOwner(coarser, around))
    {
      return !owner->HiddenCells || owner->HiddenCells[GetNumber(*owner, around)] == 0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      around[axis] = FloorDivide(around[axis], this->GetLevel(coarser).Ratio[axis]);
    }
  }
  return false;
}

//------------------------------------------------------------------------------
double AmrPatches::FindMean(int level, const Index3& cell) const
{
  double sum = 0.0;
  double covered = 0.0;
  double volume = 1.0;
  Index3 first = cell;
  Index3 count = { 1, 1, 1 };
  for (int finer = level + 1; finer < this->GetNumberOfLevels(); ++finer)
  {
    const Level& all = this->GetLevel(finer);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] *= all.Ratio[axis];
      count[axis] *= all.Ratio[axis];
      volume /= all.Ratio[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t number)
      {
        const AmrPatch& patch = this->All[number];
        Index3 low;
        Index3 common;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::max(first[axis], patch.First[axis]);
          common[axis] =
            std::min(first[axis] + count[axis], patch.First[axis] + patch.Cells[axis]) - low[axis];
        }
        ForEachIndex(low, common,
          [&](const Index3& inside)
          {
            if (this->FindOwner(finer, inside) == &patch &&
              !this->IsCoveredByCoarser(finer, inside, level + 1))
            {
              sum += volume * GetSample(patch, inside);
              covered += volume;
            }
          });
      });
  }
  return sum / covered;
}

//------------------------------------------------------------------------------
bool AmrPatches::IsInCoarser(const AmrPatch& patch) const
{
  Index3 first = patch.First;
  Index3 end = GetEnd(first, patch.Cells);
  for (int coarser = patch.Level - 1; coarser >= 0; --coarser)
  {
    const Index3& ratio = this->GetLevel(coarser + 1).Ratio;
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = FloorDivide(first[axis], ratio[axis]);
      end[axis] = -FloorDivide(-end[axis], ratio[axis]);
      count[axis] = end[axis] - first[axis];
    }
    if (!this->Covers(this->GetLevel(coarser), first, count))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/// Whether patches of a level without overlaps and ghosts fill a box.
bool AmrPatches::Covers(const Level& level, const Index3& first, const Index3& count) const
{
  const Bounds box = GetBox(first, count);
  double covered = 0.0;
  bool isPlain = !level.HasOverlaps;
  level.ForEachIn(box,
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->All[number];
      const Bounds other = GetBox(patch.First, patch.Cells);
      isPlain = isPlain && !patch.GhostCells;
      double common = 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        common *= std::min(box.Upper[axis], other.Upper[axis]) -
          std::max(box.Lower[axis], other.Lower[axis]);
      }
      covered += common;
    });
  return isPlain && covered == static_cast<double>(Count(count));
}

}
