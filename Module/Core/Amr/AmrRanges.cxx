// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrRanges.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Includes the samples of a patch that are of the cells of a box.
void Include(
  const AmrPatch& patch, bool ofCells, const Index3& first, const Index3& end, AmrRange& range)
{
  Index3 low;
  Index3 count;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::max(first[axis] - patch.First[axis], 0);
    count[axis] =
      std::min(end[axis] - patch.First[axis], patch.Cells[axis]) - low[axis] + (ofCells ? 0 : 1);
  }
  DispatchScalarType(patch.Samples,
    [&](const auto& samples)
    {
      ForEachIndex(low, count,
        [&](const Index3& i)
        {
          const auto value = static_cast<double>(*samples.At(i));
          const bool isFinite = std::isfinite(value);
          range.Min = isFinite ? std::min(range.Min, value) : range.Min;
          range.Max = isFinite ? std::max(range.Max, value) : range.Max;
        });
    });
}

}

//------------------------------------------------------------------------------
AmrRanges::AmrRanges(const AmrPatches& patches)
  : Patches(patches)
{
  for (std::size_t i = 0; this->Patches.AreOfCells() && i < this->Patches.GetCount(); ++i)
  {
    const AmrPatch& patch = this->Patches.Get(i);
    if (!this->Patches.IsInCoarser(patch))
    {
      this->LentRanges.resize(this->Patches.GetCount());
      Include(patch, true, patch.First, GetEnd(patch.First, patch.Cells), this->LentRanges[i]);
    }
  }
}

//------------------------------------------------------------------------------
/// Includes what finer patches may give the cells of a box that a level lacks: their samples there,
/// or, quicker but for more, all of them.
void AmrRanges::IncludeLent(
  int level, Index3 first, Index3 end, bool asWhole, AmrRange& range) const
{
  if (this->LentRanges.empty())
  {
    return;
  }
  for (int finer = level + 1; finer < this->Patches.GetNumberOfLevels(); ++finer)
  {
    const AmrPatches::Level& all = this->Patches.GetLevel(finer);
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] *= all.Ratio[axis];
      end[axis] *= all.Ratio[axis];
      count[axis] = end[axis] - first[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t number)
      {
        const AmrRange& lent = this->LentRanges[number];
        if (asWhole)
        {
          range.Min = std::min(range.Min, lent.Min);
          range.Max = std::max(range.Max, lent.Max);
        }
        else if (lent.Min <= lent.Max)
        {
          Include(this->Patches.Get(number), true, first, end, range);
        }
      });
  }
}

//------------------------------------------------------------------------------
/// Nodes have values of samples, means of them, or are between those of coarser levels.
AmrRange AmrRanges::Find(const AmrRegion& region) const
{
  // The cells that touch nodes of the region, of the layer behind it, and of the cells of coarser
  // levels that these are in.
  const int margin = this->Patches.AreOfCells() ? 1 : 2;
  Index3 first = region.First;
  Index3 end = GetEnd(first, region.Cells);
  AmrRange range;
  for (int level = region.Level; level >= 0; --level)
  {
    const AmrPatches::Level& all = this->Patches.GetLevel(level);
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] -= margin;
      end[axis] += margin;
      count[axis] = end[axis] - first[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t other)
      { Include(this->Patches.Get(other), this->Patches.AreOfCells(), first, end, range); });
    // Coarser cells are as large as many of the finest.
    this->IncludeLent(level, first, end, level < region.Level, range);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = FloorDivide(first[axis], all.Ratio[axis]);
      end[axis] = -FloorDivide(-end[axis], all.Ratio[axis]);
    }
  }
  // More than the rounding of means.
  const double slack = 1e-12 * std::max(std::abs(range.Min), std::abs(range.Max));
  return range.Min <= range.Max ? AmrRange{ range.Min - slack, range.Max + slack } : range;
}

}
