// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CastRays.h"

#include <algorithm>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

RayHits CastRays(ImageField& volume, const std::vector<std::optional<Ray>>& rays, int threads)
{
  // As many rays at a time as a tile of an image has.
  constexpr std::size_t portionSize = 128;
  const std::size_t portions = (rays.size() + portionSize - 1) / portionSize;
  std::vector<RayHits> found(portions);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(portions); ++i)
  {
    const auto portion = static_cast<std::size_t>(i);
    const auto first = rays.begin() + static_cast<std::ptrdiff_t>(portion * portionSize);
    const std::size_t count = std::min(portionSize, rays.size() - portion * portionSize);
    volume.Trace({ first, first + static_cast<std::ptrdiff_t>(count) }, found[portion]);
  }

  RayHits all;
  all.Clear();
  for (const RayHits& some : found)
  {
    all.Append(some);
  }
  return all;
}

}
