// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ClippedRays_h
#define ClippedRays_h

#include "Math/Arithmetic.h"

namespace vtkIsosurfaceRayTracing
{

/// Rays in index space that are clipped to a volume; see Ray for what its numbers mean.
template <typename Number>
struct ClippedRays
{
  using Mask = decltype(Number() < Number());

  Number Origin[3];
  Number Direction[3];
  Number Inverse[3];
  /// Whether the ray goes up an axis, and whether it is parallel to its planes.
  Mask Up[3];
  Mask Parallel[3];
  Number Begin;
  Number End;
  Number Base;
};

/// Narrows [Begin, End] to the slabs of the box. A ray parallel to the planes of an axis must lie
/// between them; a ray in a face does. Returns which rays meet the box.
template <typename Number>
SIMD_INLINE auto ClipToSlabs(
  const int dimensions[3], const double lastPlanes[3], ClippedRays<Number>& rays)
{
  using Mask = typename ClippedRays<Number>::Mask;
  const Number zero = 0.0;
  Mask meets = zero <= zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Number last = lastPlanes[axis];
    const Number origin = rays.Origin[axis];
    const Mask up = rays.Up[axis];
    const Mask parallel = rays.Parallel[axis];
    meets = AndNot(meets, AndNot(parallel, (zero <= origin) & (origin <= dimensions[axis] - 1)));
    const Number in = (Select(up, zero, last) - origin) * rays.Inverse[axis];
    const Number out = (Select(up, last, zero) - origin) * rays.Inverse[axis];
    rays.Begin = Select(parallel, rays.Begin, Max(rays.Begin, in));
    rays.End = Select(parallel, rays.End, Min(rays.End, out));
  }
  return meets & (rays.Begin <= rays.End);
}

/// So little of its distances, a ray is off a plane by rounding.
constexpr double NegligibleOffPlane = 0x1p-46;
/// But no more, in cells.
constexpr double MostOffPlane = 0x1p-26;

/// Puts rays into lattice planes that they are parallel to and lie in, but for rounding. Pieces of
/// a volume count their samples from their own first one, so they round otherwise: a ray in the
/// plane where two of them meet, as rays of views along an axis are, would be in a cell of neither,
/// or of both. It is in the plane for all.
template <typename Number>
SIMD_INLINE void SnapToPlanes(const int dimensions[3], ClippedRays<Number>& rays)
{
  Number reach = static_cast<double>(dimensions[0]) + dimensions[1] + dimensions[2];
  Number length = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    reach = reach + Abs(rays.Origin[axis]);
    length = length + Abs(rays.Direction[axis]);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto isParallel = Abs(rays.Direction[axis]) <= NegligibleOffPlane * length;
    if (Any(isParallel))
    {
      const Number plane = Floor(rays.Origin[axis] + 0.5);
      const Number most = Min(NegligibleOffPlane * reach, Number(MostOffPlane));
      const auto isInPlane = isParallel & (Abs(rays.Origin[axis] - plane) <= most);
      rays.Origin[axis] = Select(isInPlane, plane, rays.Origin[axis]);
      rays.Direction[axis] = Select(isInPlane, Number(0.0), rays.Direction[axis]);
    }
  }
}

/// Clips rays with origin, direction, begin and end to a volume of the given dimensions, whose last
/// lattice planes have the given coordinates, and computes their other members. Returns which rays
/// meet it; the others have undefined values.
template <typename Number>
SIMD_INLINE auto ClipToVolume(
  const int dimensions[3], const double lastPlanes[3], ClippedRays<Number>& rays)
{
  using Mask = typename ClippedRays<Number>::Mask;
  SnapToPlanes(dimensions, rays);
  const Number zero = 0.0;
  const Number infinity = Infinity;
  Mask isFinite = zero < infinity;
  Mask isRay = infinity < zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Number direction = rays.Direction[axis];
    const Mask isOriginFinite = Abs(rays.Origin[axis]) < infinity;
    const Mask isDirectionFinite = Abs(direction) < infinity;
    isFinite = isFinite & isOriginFinite & isDirectionFinite;
    // A component so small that its inverse is infinite does not move the ray across any volume.
    rays.Inverse[axis] = 1.0 / direction;
    const Mask moves = Abs(rays.Inverse[axis]) < infinity;
    rays.Parallel[axis] = AndNot(zero < infinity, moves);
    rays.Up[axis] = zero < direction;
    rays.Direction[axis] = Select(moves, direction, zero);
    isRay = isRay | moves;
  }
  const Number begin = rays.Begin;
  const Number end = rays.End;
  const Mask meets = isFinite & isRay & ClipToSlabs(dimensions, lastPlanes, rays);
  // The new origin lies on the ray to the last bit of its own, small, coordinates.
  rays.Base = rays.Begin;
  for (int axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = FusedMultiplyAdd(rays.Base, rays.Direction[axis], rays.Origin[axis]);
  }
  rays.Begin = begin - rays.Base;
  rays.End = end - rays.Base;
  const Mask stillMeets = meets & ClipToSlabs(dimensions, lastPlanes, rays);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (Any(rays.Parallel[axis]))
    {
      const Number last = dimensions[axis] - 2;
      const Number cell = Min(Floor(rays.Origin[axis]), last);
      rays.Inverse[axis] = Select(rays.Parallel[axis], cell, rays.Inverse[axis]);
    }
  }
  return stillMeets;
}

}

#endif
