// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PendingSegments_h
#define PendingSegments_h

#include "Kernels/CloudTile.h"

#include <array>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A list of segments for each pixel of a tile: those whose turn has not come.
class PendingSegments
{
public:
  void Clear() { this->Counts.fill(0); }

  void Add(int pixel, double depth, const SegmentLight& light)
  {
    int& count = this->Counts[static_cast<std::size_t>(pixel)];
    if (count == this->Room)
    {
      this->MakeRoom();
    }
    const std::size_t at = this->GetIndex(pixel, count++);
    this->Depths[at] = depth;
    this->Lights[at] = light;
  }

  /// The number of segments of all pixels.
  std::size_t GetCount() const;
  /// The most segments that a pixel has.
  int GetLongest() const;

  /// For Kernels::DrawSegments and KeepSegments; until something is added.
  SegmentLists GetLists()
  {
    return { this->Room, this->Counts.data(), this->Depths.data(), this->Lights.data(),
      this->Keys.data() };
  }

  /// The segments of a pixel in order by depth: numbers for GetDepth and GetLight. The order does
  /// not depend on which segment was added first: those that begin at one depth, in cells that
  /// overlap, are in order by their light.
  const std::vector<std::size_t>& FindOrder(int pixel);

  double GetDepth(std::size_t number) const { return this->Depths[number]; }
  const SegmentLight& GetLight(std::size_t number) const { return this->Lights[number]; }

private:
  std::size_t GetIndex(int pixel, int place) const
  {
    return static_cast<std::size_t>(SegmentLists::GetIndex(this->Room, pixel, place));
  }
  bool IsBefore(std::size_t a, std::size_t b) const;
  void MakeRoom();

  int Room = 0;
  std::array<int, CloudTile::Capacity> Counts = {};
  std::vector<double> Depths;
  std::vector<SegmentLight> Lights;
  std::vector<double> Keys;
  std::vector<std::size_t> Order;
};

}

#endif
