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
  Bounds all = NoBounds();
  for (const Bounds& box : boxes)
  {
    all = Unite(all, box);
  }
  std::vector<std::pair<std::uint64_t, std::size_t>> codes;
  codes.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    codes.emplace_back(GetMortonCode(GetCenter(boxes[i]), all), i);
  }
  std::sort(codes.begin(), codes.end());
  std::vector<Bounds> level;
  for (const auto& [code, number] : codes)
  {
    this->Order.push_back(number);
    level.push_back(boxes[number]);
  }
  this->Levels.push_back(std::move(level));
  while (this->Levels.back().size() > 1)
  {
    const std::vector<Bounds>& below = this->Levels.back();
    std::vector<Bounds> above;
    for (std::size_t first = 0; first < below.size(); first += Width)
    {
      Bounds box = NoBounds();
      for (std::size_t i = first; i < std::min(first + Width, below.size()); ++i)
      {
        box = Unite(box, below[i]);
      }
      above.push_back(box);
    }
    this->Levels.push_back(std::move(above));
  }
}

//------------------------------------------------------------------------------
std::size_t BoundsTree::GetMemory() const
{
  std::size_t bytes = this->Order.size() * sizeof(this->Order[0]);
  for (const std::vector<Bounds>& level : this->Levels)
  {
    bytes += level.size() * sizeof(level[0]);
  }
  return bytes;
}

}
