// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RaysInBox_h
#define RaysInBox_h

#include "Math/Arithmetic.h"
#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// The parts of the rays of a packet that are in a box.
struct RaysInBox
{
  /// Those that meet it; the others have no defined values.
  RaySet Rays;
  alignas(64) double Begin[RayPacket::Capacity];
  alignas(64) double End[RayPacket::Capacity];
};

/// Narrows rays to a box. Rays in its faces, or parallel to them, are in it or not, by rounding.
/// Returns which meet it.
template <typename Number>
SIMD_INLINE auto CutToBox(const double lower[3], const double upper[3], const Number origin[3],
  const Number inverse[3], Number& begin, Number& end)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const Number a = (lower[axis] - origin[axis]) * inverse[axis];
    const Number b = (upper[axis] - origin[axis]) * inverse[axis];
    begin = Max(begin, Min(a, b));
    end = Min(end, Max(a, b));
  }
  return begin <= end;
}

}

#endif
