// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Field/BoundsTree.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int BitsOfAxis = 20;

/// Where a point of a box is on a Morton curve.
std::uint64_t GetMortonCode(const Vector3& point, const Bounds& box)
{
  std::uint64_t code = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = box.Upper[axis] - box.Lower[axis];
    const double place = length > 0.0 ? (point[axis] - box.Lower[axis]) / length : 0.0;
    constexpr double steps = (1 << BitsOfAxis) - 1;
    const auto step = static_cast<std::uint64_t>(steps * std::clamp(place, 0.0, 1.0));
    for (int bit = 0; bit < BitsOfAxis; ++bit)
    {
      code |= (step >> bit & 1U) << (3 * bit + static_cast<int>(axis));
    }
  }
  return code;
}

}

//------------------------------------------------------------------------------
BoundsTree::BoundsTree(const std::vector<Bounds>& boxes)
{
  if (boxes.empty())
  {
    return;
  }
  for (const Bounds& box : boxes)
  {
    this->Box = Unite(this->Box, box);
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> codes;
  codes.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    codes.emplace_back(GetMortonCode(GetCenter(boxes[i]), this->Box), i);
  }
  std::sort(codes.begin(), codes.end());
  this->Levels.emplace_back();
  for (const auto& [code, number] : codes)
  {
    this->Order.push_back(number);
    this->Levels.back().Add(boxes[number]);
  }
  while (this->Levels.back().Groups.size() > 1)
  {
    const Level& below = this->Levels.back();
    Level above;
    for (std::size_t group = 0; group < below.Groups.size(); ++group)
    {
      above.Add(below.GetBoundsOfGroup(group));
    }
    this->Levels.push_back(std::move(above));
  }
}

//------------------------------------------------------------------------------
void BoundsTree::Level::Add(const Bounds& box)
{
  const std::size_t place = this->Size++ % Width;
  if (place == 0)
  {
    this->Groups.emplace_back();
  }
  SetBox(box, place, this->Groups.back());
}

//------------------------------------------------------------------------------
Bounds BoundsTree::Level::GetBoundsOfGroup(std::size_t group) const
{
  Bounds box = NoBounds();
  for (std::size_t i = 0; i < this->GetSizeOfGroup(group); ++i)
  {
    box = Unite(box, GetBox(this->Groups[group], i));
  }
  return box;
}

//------------------------------------------------------------------------------
std::size_t BoundsTree::GetMemory() const
{
  std::size_t bytes = this->Order.size() * sizeof(this->Order[0]);
  for (const Level& level : this->Levels)
  {
    bytes += level.Groups.size() * sizeof(BoxGroup);
  }
  return bytes;
}

}
