// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoundsTree_h
#define BoundsTree_h

#include "Math/Bounds.h"
#include "Math/Compiler.h"
#include "Rays/BoxGroup.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A box of a group.
inline Bounds GetBox(const BoxGroup& group, std::size_t i)
{
  Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Lower[axis] = group.Lower[axis][i];
    box.Upper[axis] = group.Upper[axis][i];
  }
  return box;
}

inline void SetBox(const Bounds& box, std::size_t i, BoxGroup& group)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    group.Lower[axis][i] = box.Lower[axis];
    group.Upper[axis][i] = box.Upper[axis];
  }
}

/// A hierarchy over boxes, which are sorted along a Morton curve: eight that follow each other have
/// a parent, level over level. It has no pointers, and is built in the time of sorting.
class BoundsTree
{
public:
  explicit BoundsTree(const std::vector<Bounds>& boxes);

  /// The bounds of all boxes.
  const Bounds& GetBounds() const { return this->Box; }

  std::size_t GetMemory() const;

  /// Calls visit(number) for the boxes that meet(box) says true of; it must say so of larger boxes
  /// around them, too.
  template <typename Meet, typename Visit>
  void Find(const Meet& meet, const Visit& visit) const
  {
    if (!this->Levels.empty())
    {
      this->FindInGroup(this->Levels.size() - 1, 0, meet, visit);
    }
  }

  /// Calls visit(number, box) for the boxes that meet(group), which has a bit for each box of a
  /// group, says true of; it must say so of larger boxes around them, too.
  template <typename Meet, typename Visit>
  void FindByGroups(const Meet& meet, const Visit& visit) const
  {
    if (!this->Levels.empty())
    {
      this->FindInGroupByBits(this->Levels.size() - 1, 0, meet, visit);
    }
  }

private:
  static constexpr std::size_t Width = BoxGroup::Size;

  /// The boxes of a level, by groups, of which the last one may not be full.
  struct Level
  {
    std::size_t Size = 0;
    std::vector<BoxGroup> Groups;

    void Add(const Bounds& box);
    std::size_t GetSizeOfGroup(std::size_t group) const
    {
      return std::min(Width, this->Size - group * Width);
    }
    Bounds GetBoundsOfGroup(std::size_t group) const;
  };

  template <typename Meet, typename Visit>
  void FindInGroup(std::size_t level, std::size_t group, const Meet& meet, const Visit& visit) const
  {
    const Level& boxes = this->Levels[level];
    const std::size_t size = boxes.GetSizeOfGroup(group);
    for (std::size_t i = 0; i < size; ++i)
    {
      if (!meet(GetBox(boxes.Groups[group], i)))
      {
        continue;
      }
      if (level == 0)
      {
        visit(this->Order[group * Width + i]);
      }
      else
      {
        this->FindInGroup(level - 1, group * Width + i, meet, visit);
      }
    }
  }

  template <typename Meet, typename Visit>
  void FindInGroupByBits(
    std::size_t level, std::size_t group, const Meet& meet, const Visit& visit) const
  {
    const Level& boxes = this->Levels[level];
    const unsigned int all = (1U << boxes.GetSizeOfGroup(group)) - 1;
    for (unsigned int met = meet(boxes.Groups[group]) & all; met != 0; met &= met - 1)
    {
      const auto i = static_cast<std::size_t>(LowestBit(met));
      if (level == 0)
      {
        visit(this->Order[group * Width + i], GetBox(boxes.Groups[group], i));
      }
      else
      {
        this->FindInGroupByBits(level - 1, group * Width + i, meet, visit);
      }
    }
  }

  Bounds Box = NoBounds();
  /// The numbers of the boxes as they are sorted.
  std::vector<std::size_t> Order;
  /// The first level has the boxes, another one those around the groups of the one before it, the
  /// last a single group.
  std::vector<Level> Levels;
};

}

#endif
