// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Slab_h
#define Slab_h

#include "Math/Arithmetic.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

/// A part of a ray.
struct Slab
{
  double Begin;
  double End;
};

/// The part of a ray between two planes across an axis. A ray parallel to them has all of it, or
/// nothing.
inline Slab CutToSlab(double origin, double direction, double inverse, double lower, double upper)
{
  if (direction == 0.0)
  {
    return origin >= lower && origin <= upper ? Slab{ -Infinity, Infinity } : Slab{ 1.0, 0.0 };
  }
  const double a = (lower - origin) * inverse;
  const double b = (upper - origin) * inverse;
  return { std::min(a, b), std::max(a, b) };
}

}

#endif
