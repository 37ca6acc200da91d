// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayPacket_h
#define RayPacket_h

#include "Rays/Ray.h"

#include <cstdint>
#include <optional>

namespace vtkIsosurfaceRayTracing
{

/// Some of up to 128 rays.
struct RaySet
{
  std::uint64_t Words[2];
};

/// Rays that are traced side by side, in arrays.
struct RayPacket
{
  static constexpr int Capacity = 128;

  int Count;
  /// Those that meet the volume at all; the others have no defined values.
  RaySet Exists;
  // As in Ray. The direction is zero along an axis that the ray is parallel to.
  alignas(64) double Origin[3][Capacity];
  alignas(64) double Direction[3][Capacity];
  alignas(64) double Inverse[3][Capacity];
  alignas(64) double Begin[Capacity];
  alignas(64) double End[Capacity];
  alignas(64) double Base[Capacity];
};

inline bool Has(const RaySet& set, int ray)
{
  return (set.Words[ray / 64] >> (ray % 64) & 1) != 0;
}

inline void Add(int ray, RaySet& set)
{
  set.Words[ray / 64] |= std::uint64_t{ 1 } << (ray % 64);
}

inline void Remove(int ray, RaySet& set)
{
  set.Words[ray / 64] &= ~(std::uint64_t{ 1 } << (ray % 64));
}

inline bool IsEmpty(const RaySet& set)
{
  return (set.Words[0] | set.Words[1]) == 0;
}

inline int CountOf(const RaySet& set)
{
  return __builtin_popcountll(set.Words[0]) + __builtin_popcountll(set.Words[1]);
}

/// Puts a ray at the end of a packet that has room for it.
inline void AddRay(const std::optional<Ray>& ray, RayPacket& packet)
{
  const int place = packet.Count++;
  if (!ray)
  {
    return;
  }
  Add(place, packet.Exists);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    packet.Origin[axis][place] = ray->Origin[axis];
    packet.Direction[axis][place] = ray->Direction[axis];
    packet.Inverse[axis][place] = ray->Inverse[axis];
  }
  packet.Begin[place] = ray->Begin;
  packet.End[place] = ray->End;
  packet.Base[place] = ray->Base;
}

/// A ray of a packet that exists.
inline Ray GetRay(const RayPacket& packet, int place)
{
  Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = packet.Origin[axis][place];
    ray.Direction[axis] = packet.Direction[axis][place];
    ray.Inverse[axis] = packet.Inverse[axis][place];
    ray.Step[axis] = ray.Direction[axis] > 0.0 ? 1 : (ray.Direction[axis] < 0.0 ? -1 : 0);
  }
  ray.Begin = packet.Begin[place];
  ray.End = packet.End[place];
  ray.Base = packet.Base[place];
  return ray;
}

}

#endif
