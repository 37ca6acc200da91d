// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TraceLine_h
#define TraceLine_h

#include "Image/Lattice/Ray.h"
#include "TestLines.h"
#include "TestRequest.h"
#include "TestVolume.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// An opacity so small that a ray passes any number of such surfaces.
inline constexpr double Glass = 1e-9;

template <typename T>
std::unique_ptr<ImageField> NewTraced(
  const TestVolume<T>& volume, const TestRequest& request, const ImageSettings& settings = {})
{
  auto traced = ImageField::New(volume.View(), settings, 2);
  Select(*traced, request, 2);
  return traced;
}

template <typename T>
std::unique_ptr<ImageField> NewTraced(const TestVolume<T>& volume,
  const std::vector<Isosurface>& surfaces, const ImageSettings& settings = {})
{
  return NewTraced(volume, TestRequest(surfaces), settings);
}

/// The hits of a line from t = begin to t = end.
inline std::vector<Hit> Trace(
  TracedField& field, const Line& line, double end = Infinity, double begin = 0.0)
{
  RayPacket packet;
  packet.Count = 0;
  packet.Exists = {};
  field.AddRay(line.Origin, line.Direction, begin, end, packet);
  RayHits hits;
  field.Trace(packet, hits);
  return hits.Hits;
}

/// The hits of any number of rays, packet by packet. No rays are an empty packet.
inline void Trace(TracedField& field, const std::vector<std::optional<Ray>>& rays, RayHits& hits)
{
  hits.Clear();
  std::size_t next = 0;
  do
  {
    RayPacket packet;
    packet.Count = 0;
    packet.Exists = {};
    while (next < rays.size() && packet.Count < RayPacket::Capacity)
    {
      AppendRay(rays[next++], packet);
    }
    RayHits some;
    field.Trace(packet, some);
    hits.Append(some);
  } while (next < rays.size());
}

}

#endif
