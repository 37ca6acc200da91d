// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CroppedBlocks_h
#define CroppedBlocks_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Macrocells/BlockMask.h"
#include "Rays/Visibility.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Which cells of blocks of 8^3 are in visible regions of cropping: all of their points, some, or
/// none.
class CroppedBlocks
{
public:
  CroppedBlocks(const CroppingRegions& regions, const CellLattice& lattice)
    : Regions(regions)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int count = lattice.GetCells()[axis];
      this->Blocks[axis].resize(static_cast<std::size_t>((count - 1) / BlockMask::Edge + 1));
      for (int cell = 0; cell < count; ++cell)
      {
        Intervals& intervals = this->Blocks[axis][static_cast<std::size_t>(cell / BlockMask::Edge)];
        const auto bit = static_cast<unsigned char>(1U << cell % BlockMask::Edge);
        for (std::size_t i = 0; i < 3; ++i)
        {
          intervals[i] |= Reaches(lattice, regions.Planes[axis], axis, cell, i) ? bit : 0U;
        }
      }
    }
  }

  /// Whether all cells of a block are visible as a whole.
  bool IsVisible(const Index3& block) const
  {
    bool isVisible = true;
    this->ForEachRegion(block,
      [this, &isVisible](int region, unsigned int /*x*/, unsigned int /*y*/, unsigned int /*z*/)
      { isVisible = isVisible && this->Has(region); });
    return isVisible;
  }

  /// Finds which cells of a mask are visible as a whole, and which are in part.
  void Split(const Index3& block, const BlockMask& mask, BlockMask& whole, BlockMask& part) const
  {
    BlockMask shown = {};
    BlockMask hidden = {};
    this->ForEachRegion(block,
      [&](int region, unsigned int x, unsigned int y, unsigned int z)
      { AddCells(x, y, z, this->Has(region) ? shown : hidden); });
    for (int slice = 0; slice < BlockMask::Edge; ++slice)
    {
      const std::uint64_t cells = mask.Slices[2][slice] & shown.Slices[2][slice];
      whole.Slices[2][slice] = cells & ~hidden.Slices[2][slice];
      part.Slices[2][slice] = cells & hidden.Slices[2][slice];
    }
    whole.CompleteSlices();
    part.CompleteSlices();
  }

private:
  /// For the cells of a block along an axis, which of them reach into each of the three intervals
  /// between the planes: a bit for each.
  using Intervals = std::array<unsigned char, 3>;

  /// Whether points of a cell may be in an interval. They are rounded, as CellLattice::GetPoint
  /// does; rounding is monotone.
  static bool Reaches(const CellLattice& lattice, const std::array<double, 2>& planes,
    std::size_t axis, int cell, std::size_t interval)
  {
    Index3 place = { 0, 0, 0 };
    place[axis] = cell;
    Vector3 end = { 0.0, 0.0, 0.0 };
    const double low = lattice.GetPoint(place, end)[axis];
    end[axis] = 1.0;
    const double high = lattice.GetPoint(place, end)[axis];
    return interval == 0
      ? low < planes[0]
      : (interval == 2 ? high > planes[1] : !(high < planes[0]) && !(low > planes[1]));
  }

  bool Has(int region) const { return (this->Regions.Visible >> region & 1U) != 0; }

  /// Calls visit(region, x, y, z) for the regions that cells of a block reach into, with a bit for
  /// each of these along every axis.
  template <typename Visit>
  void ForEachRegion(const Index3& block, const Visit& visit) const
  {
    const auto intervals = [this, &block](std::size_t axis) -> const Intervals&
    { return this->Blocks[axis][static_cast<std::size_t>(block[axis])]; };
    int region = 0;
    for (const unsigned int z : intervals(2))
    {
      for (const unsigned int y : intervals(1))
      {
        for (const unsigned int x : intervals(0))
        {
          if (x != 0 && y != 0 && z != 0)
          {
            visit(region, x, y, z);
          }
          ++region;
        }
      }
    }
  }

  /// Adds a product of cells along the axes to the slices across z.
  static void AddCells(unsigned int x, unsigned int y, unsigned int z, BlockMask& mask)
  {
    std::uint64_t slice = 0;
    for (int row = 0; row < BlockMask::Edge; ++row)
    {
      slice |= (y >> row & 1U) != 0 ? std::uint64_t{ x } << (8 * row) : 0U;
    }
    for (int i = 0; i < BlockMask::Edge; ++i)
    {
      mask.Slices[2][i] |= (z >> i & 1U) != 0 ? slice : 0U;
    }
  }

  CroppingRegions Regions;
  std::array<std::vector<Intervals>, 3> Blocks;
};

}

#endif
