// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayHits_h
#define RayHits_h

#include "Rays/Hit.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The hits of a number of rays: ray i has those from First[i] to First[i + 1], front to back.
struct RayHits
{
  std::vector<Hit> Hits;
  std::vector<std::size_t> First;

  void Clear()
  {
    this->Hits.clear();
    this->First.assign(1, 0);
  }

  /// Ends the hits of a ray: those added from now on are the next ray's.
  void EndRay() { this->First.push_back(this->Hits.size()); }

  /// Adds those of further rays.
  void Append(const RayHits& others)
  {
    const std::size_t before = this->Hits.size();
    this->Hits.insert(this->Hits.end(), others.Hits.begin(), others.Hits.end());
    for (std::size_t ray = 1; ray < others.First.size(); ++ray)
    {
      this->First.push_back(before + others.First[ray]);
    }
  }
};

}

#endif
