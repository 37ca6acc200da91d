// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CastRays.h"

#include "Field/FirstException.h"

#include <algorithm>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
RayHits CastRays(TracedField& field, const std::vector<CastRay>& rays, int threads)
{
  constexpr std::size_t size = RayPacket::Capacity;
  const std::size_t packets = (rays.size() + size - 1) / size;
  std::vector<RayHits> found(packets);
  FirstException exception;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(packets); ++i)
  {
    exception.Guard(
      [&]
      {
        const auto number = static_cast<std::size_t>(i);
        const std::size_t end = std::min((number + 1) * size, rays.size());
        RayPacket packet;
        packet.Clear();
        for (std::size_t ray = number * size; ray < end; ++ray)
        {
          field.AddRay(
            rays[ray].Origin, rays[ray].Direction, rays[ray].Begin, rays[ray].End, packet);
        }
        field.Trace(packet, found[number]);
      });
  }
  exception.Rethrow();

  RayHits all;
  all.Clear();
  for (const RayHits& some : found)
  {
    all.Append(some);
  }
  return all;
}

}
