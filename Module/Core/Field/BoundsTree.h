// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoundsTree_h
#define BoundsTree_h

#include "Math/Bounds.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A hierarchy over boxes, which are sorted along a Morton curve: eight that follow each other have
/// a parent, level over level. It has no pointers, and is built in the time of sorting.
class BoundsTree
{
public:
  explicit BoundsTree(const std::vector<Bounds>& boxes);

  /// The bounds of all boxes.
  Bounds GetBounds() const
  {
    return this->Levels.empty() ? NoBounds() : this->Levels.back().front();
  }

  std::size_t GetMemory() const;

  /// Calls visit(number) for the boxes that meet(box) says true of; it must say so of larger boxes
  /// around them, too.
  template <typename Meet, typename Visit>
  void Find(const Meet& meet, const Visit& visit) const
  {
    if (!this->Levels.empty())
    {
      this->FindBelow(this->Levels.size() - 1, 0, meet, visit);
    }
  }

private:
  static constexpr std::size_t Width = 8;

  template <typename Meet, typename Visit>
  void FindBelow(std::size_t level, std::size_t node, const Meet& meet, const Visit& visit) const
  {
    if (!meet(this->Levels[level][node]))
    {
      return;
    }
    if (level == 0)
    {
      visit(this->Order[node]);
      return;
    }
    const std::size_t end = std::min((node + 1) * Width, this->Levels[level - 1].size());
    for (std::size_t child = node * Width; child < end; ++child)
    {
      this->FindBelow(level - 1, child, meet, visit);
    }
  }

  /// The numbers of the boxes as they are sorted.
  std::vector<std::size_t> Order;
  /// The first level has the boxes, the last a single one.
  std::vector<std::vector<Bounds>> Levels;
};

}

#endif
