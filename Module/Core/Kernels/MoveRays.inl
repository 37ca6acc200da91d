// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays that are cut to volumes and boxes, or moved from the space of a set of fields to that of a
// member. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Puts the bits of a vector of rays into a set that had none of them.
SIMD_INLINE void AddLanes(Mask mask, int first, RaySet& set)
{
  set.Words[first >> 6] |= static_cast<std::uint64_t>(ToBits(mask)) << (first & 63);
}

void CutPacketToBox(
  const RayPacket& packet, const double lower[3], const double upper[3], RaysInBox& inside)
{
  inside.Rays.Words[0] = 0;
  inside.Rays.Words[1] = 0;
  for (int i = 0; i < packet.Count; i += DoubleWidth)
  {
    const unsigned int exists = GetLanes(packet.Exists, i);
    if (exists == 0)
    {
      continue;
    }
    Doubles origin[3];
    Doubles inverse[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = Load(&packet.Origin[axis][i]);
      inverse[axis] = Load(&packet.Inverse[axis][i]);
    }
    Doubles begin = Load(&packet.Begin[i]);
    Doubles end = Load(&packet.End[i]);
    const Mask isIn = CutToBox(lower, upper, origin, inverse, begin, end);
    Store(begin, &inside.Begin[i]);
    Store(end, &inside.End[i]);
    AddLanes(isIn & ToMask(exists), i, inside.Rays);
  }
}

/// Cuts the rays of a packet that exist; cut(rays) does so, and returns which of these are left.
template <typename Rays, typename Cut>
SIMD_INLINE void CutRays(RayPacket& packet, const Cut& cut)
{
  const RaySet given = packet.Exists;
  packet.Exists.Words[0] = 0;
  packet.Exists.Words[1] = 0;
  for (int i = 0; i < packet.Count; i += DoubleWidth)
  {
    const unsigned int some = GetLanes(given, i);
    if (some == 0)
    {
      continue;
    }
    Rays rays;
    for (int axis = 0; axis < 3; ++axis)
    {
      rays.Origin[axis] = Load(&packet.Origin[axis][i]);
      rays.Direction[axis] = Load(&packet.Direction[axis][i]);
    }
    rays.Begin = Load(&packet.Begin[i]);
    rays.End = Load(&packet.End[i]);
    const Mask exists = cut(rays);
    StoreRays(rays, i, packet);
    AddLanes(exists & ToMask(some), i, packet.Exists);
  }
}

void ClipRays(const int dimensions[3], RayPacket& packet)
{
  const double lastPlanes[3] = { dimensions[0] - 1.0, dimensions[1] - 1.0, dimensions[2] - 1.0 };
  CutRays<ClippedRays<Doubles>>(
    packet, [&](ClippedRays<Doubles>& rays) { return ClipToVolume(dimensions, lastPlanes, rays); });
}

void MoveRaysToBox(const double lower[3], const double upper[3], RayPacket& packet)
{
  CutRays<BoxedRays<Doubles>>(
    packet, [&](BoxedRays<Doubles>& rays) { return MoveToBox(lower, upper, rays); });
}

void MoveRays(const RayPacket& rays, const RaysInBox& parts, const double* ownFromRays,
  const int dimensions[3], RayPacket& moved)
{
  const double lastPlanes[3] = { dimensions[0] - 1.0, dimensions[1] - 1.0, dimensions[2] - 1.0 };
  moved.Count = rays.Count;
  moved.Columns = rays.Columns;
  moved.Exists.Words[0] = 0;
  moved.Exists.Words[1] = 0;
  for (int i = 0; i < rays.Count; i += DoubleWidth)
  {
    const unsigned int some = GetLanes(parts.Rays, i);
    if (some == 0)
    {
      continue;
    }
    Doubles origin[3];
    Doubles direction[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = Load(&rays.Origin[axis][i]);
      direction[axis] = Load(&rays.Direction[axis][i]);
    }
    ClippedRays<Doubles> clipped;
    TransformDirection(ownFromRays, direction, clipped.Direction);
    TransformDirection(ownFromRays, origin, clipped.Origin);
    for (int axis = 0; axis < 3; ++axis)
    {
      clipped.Origin[axis] = clipped.Origin[axis] + ownFromRays[4 * axis + 3];
    }
    clipped.Begin = Load(&parts.Begin[i]);
    clipped.End = Load(&parts.End[i]);
    const Mask exists = ClipToVolume(dimensions, lastPlanes, clipped);
    StoreRays(clipped, i, moved);
    AddLanes(exists & ToMask(some), i, moved.Exists);
  }
}

}
}
