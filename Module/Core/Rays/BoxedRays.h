// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxedRays_h
#define BoxedRays_h

#include "Math/Arithmetic.h"

namespace vtkIsosurfaceRayTracing
{

/// Rays that are moved to begin where they enter a box: one ray, or one for each lane.
template <typename Number>
struct BoxedRays
{
  Number Origin[3];
  Number Direction[3];
  Number Inverse[3];
  Number Begin;
  Number End;
  Number Base;
};

/// Moves rays with origin, direction, begin and end to a box, and computes their other members.
/// Returns which rays meet it; the others have undefined values.
template <typename Number>
SIMD_INLINE auto MoveToBox(const double lower[3], const double upper[3], BoxedRays<Number>& rays)
{
  using Mask = decltype(Number() < Number());
  const Number infinity = Infinity;
  const Number zero = 0.0;
  const Number one = 1.0;
  Mask isRay = zero < infinity;
  Number begin = rays.Begin;
  Number end = rays.End;
  Number size = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Number origin = rays.Origin[axis];
    const Number direction = rays.Direction[axis];
    const Mask isOriginFinite = Abs(origin) < infinity;
    const Mask isDirectionFinite = Abs(direction) < infinity;
    isRay = isRay & isOriginFinite & isDirectionFinite;
    rays.Inverse[axis] = one / direction;
    const Number a = (lower[axis] - origin) * rays.Inverse[axis];
    const Number b = (upper[axis] - origin) * rays.Inverse[axis];
    // A ray parallel to the planes has all of the slab between them, or nothing.
    const Mask isParallel = direction == zero;
    const Mask isWithin = (lower[axis] <= origin) & (origin <= upper[axis]);
    begin = Max(begin, Select(isParallel, Select(isWithin, zero - infinity, one), Min(a, b)));
    end = Min(end, Select(isParallel, Select(isWithin, infinity, zero), Max(a, b)));
    size = Max(size, Abs(direction));
  }
  // A ray in a face of the box, or along it, is in or out by rounding. It has no length to lose.
  const Number slack = 0x1p-40 * (Abs(begin) + Abs(end));
  const Mask hasLength = one / size < infinity;
  isRay = isRay & hasLength & (begin <= end + slack);
  // The new origin is near the box: its coordinates have as many digits as those in it.
  rays.Base = begin;
  for (int axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = FusedMultiplyAdd(begin, rays.Direction[axis], rays.Origin[axis]);
  }
  rays.Begin = rays.Begin - begin;
  rays.End = rays.End - begin;
  return isRay;
}

}

#endif
