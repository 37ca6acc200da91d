// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketCollector_h
#define PacketCollector_h

#include "Image/Tracers/ImageSelection.h"

#include <array>
#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Collects the hits of the rays of a packet: those of each ray come front to back.
class PacketCollector
{
public:
  /// The selection must outlive the collector.
  PacketCollector(const ImageSelection& selection, int rays)
    : Collectors(static_cast<std::size_t>(rays), selection.NewCollector(this->Hits))
  {
  }
  // The collectors refer to the hits.
  PacketCollector(const PacketCollector&) = delete;
  PacketCollector& operator=(const PacketCollector&) = delete;

  /// Adds a hit, if it is visible. Returns whether nothing of the ray is left behind it.
  bool Add(int ray, const Hit& hit)
  {
    const bool isOver = this->Collectors[static_cast<std::size_t>(ray)].Add(hit);
    if (this->Hits.size() > this->Rays.size())
    {
      this->Rays.push_back(ray);
    }
    return isOver;
  }

  /// Appends the hits of all rays.
  void AppendTo(RayHits& hits) const
  {
    std::array<std::size_t, RayPacket::Capacity + 1> next = {};
    for (const int ray : this->Rays)
    {
      ++next[static_cast<std::size_t>(ray) + 1];
    }
    next[0] = hits.Hits.size();
    for (std::size_t ray = 1; ray <= this->Collectors.size(); ++ray)
    {
      next[ray] += next[ray - 1];
      hits.First.push_back(next[ray]);
    }
    hits.Hits.resize(next[this->Collectors.size()]);
    for (std::size_t i = 0; i < this->Hits.size(); ++i)
    {
      hits.Hits[next[static_cast<std::size_t>(this->Rays[i])]++] = this->Hits[i];
    }
  }

private:
  /// Of all rays, as they came; and their rays.
  std::vector<Hit> Hits;
  std::vector<int> Rays;
  std::vector<HitCollector> Collectors;
};

}

#endif
