// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayPacket_h
#define RayPacket_h

#include "Kernels/Kernels.h"
#include "Rays/Ray.h"

#include <optional>

namespace vtkIsosurfaceRayTracing
{

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

/// Puts a ray at the end of a group that has room for it.
inline void AddRay(const std::optional<Ray>& ray, RayPacket& group)
{
  const int place = group.Count++;
  if (!ray)
  {
    return;
  }
  Add(place, group.Exists);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    group.Origin[axis][place] = ray->Origin[axis];
    group.Direction[axis][place] = ray->Direction[axis];
    group.Inverse[axis][place] = ray->Inverse[axis];
  }
  group.Begin[place] = ray->Begin;
  group.End[place] = ray->End;
  group.Base[place] = ray->Base;
}

/// A ray of a group that exists.
inline Ray GetRay(const RayPacket& group, int place)
{
  Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = group.Origin[axis][place];
    ray.Direction[axis] = group.Direction[axis][place];
    ray.Inverse[axis] = group.Inverse[axis][place];
    ray.Step[axis] = ray.Direction[axis] > 0.0 ? 1 : (ray.Direction[axis] < 0.0 ? -1 : 0);
  }
  ray.Begin = group.Begin[place];
  ray.End = group.End[place];
  ray.Base = group.Base[place];
  return ray;
}

}

#endif
