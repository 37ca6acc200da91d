// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrHiddenCells.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
AmrHiddenCells::AmrHiddenCells(const AmrPatches& patches, const AmrRegion& region)
  : First(region.First)
  , Size{ region.Cells[0] + 1, region.Cells[1] + 1, region.Cells[2] + 1 }
  , Flags(Count(this->Size), 0)
{
  this->HideOwn(patches, region);
  this->HideReplaced(patches, region);
  if (!this->IsEmpty())
  {
    this->HideBehind(patches, region);
  }
}

//------------------------------------------------------------------------------
bool AmrHiddenCells::IsEmpty() const
{
  return std::find(this->Flags.begin(), this->Flags.end(), 1) == this->Flags.end();
}

//------------------------------------------------------------------------------
/// Hides the cells that patches of a region do not have, or do not show.
void AmrHiddenCells::HideOwn(const AmrPatches& patches, const AmrRegion& region)
{
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = patches.Get(number);
    ForEachIndex(patch.First, patch.Cells,
      [&](const Index3& cell)
      {
        const std::size_t place = GetNumber(patch, cell);
        if ((patch.GhostCells && patch.GhostCells[place] != 0) ||
          (patch.HiddenCells && patch.HiddenCells[place] != 0))
        {
          this->Add(cell);
        }
      });
  }
}

//------------------------------------------------------------------------------
/// Hides the cells in place of which others count: finer ones, and those of the patches of the
/// level that come first. Cells behind the region count, too: a ray in a face of it may be taken
/// for one in these.
void AmrHiddenCells::HideReplaced(const AmrPatches& patches, const AmrRegion& region)
{
  // In cells of each level.
  Bounds around = GetBox(region.First, this->Size);
  Index3 ratio = { 1, 1, 1 };
  for (int level = region.Level; level < patches.GetNumberOfLevels(); ++level)
  {
    const bool isOwnLevel = level == region.Level;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ratio[axis] *= isOwnLevel ? 1 : patches.GetLevel(level).Ratio[axis];
      around.Lower[axis] *= isOwnLevel ? 1.0 : patches.GetLevel(level).Ratio[axis];
      around.Upper[axis] *= isOwnLevel ? 1.0 : patches.GetLevel(level).Ratio[axis];
    }
    patches.GetLevel(level).ForEachIn(around,
      [&](std::size_t number)
      {
        // A region of several patches overlaps no other.
        if (isOwnLevel && number >= region.Patches.front())
        {
          return;
        }
        const AmrPatch& other = patches.Get(number);
        // The cells that the other patch has as a whole.
        Index3 low;
        Index3 count;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const int end = FloorDivide(other.First[axis] + other.Cells[axis], ratio[axis]);
          low[axis] = std::max(-FloorDivide(-other.First[axis], ratio[axis]), region.First[axis]);
          count[axis] = std::min(end, region.First[axis] + region.Cells[axis] + 1) - low[axis];
        }
        ForEachIndex(low, count,
          [&](const Index3& cell)
          {
            if (!isOwnLevel || (IsIn(region, cell) && Owns(other, cell)))
            {
              this->Add(cell);
            }
          });
      });
  }
}

//------------------------------------------------------------------------------
/// Hides cells of the layer behind a region that are behind hidden ones, and have nothing of their
/// own to show: rays of projections go on into them.
void AmrHiddenCells::HideBehind(const AmrPatches& patches, const AmrRegion& region)
{
  ForEachIndex(region.First, this->Size,
    [&](const Index3& cell)
    {
      Index3 last;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        last[axis] = std::min(cell[axis], region.First[axis] + region.Cells[axis] - 1);
      }
      if (cell != last && this->Has(last) && !patches.IsShown(region.Level, cell))
      {
        this->Add(cell);
      }
    });
}

}
