// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PlaneRounding_h
#define PlaneRounding_h

#include "Math/Bounds.h"
#include "Rays/Visibility.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// By how much a plane is off for the points of a box, in units of its offset, if rounding takes so
/// large a part from the offset, and from the coordinates of the points.
inline double FindRounding(
  const HalfSpace& half, const Bounds& box, double ofOffset, double ofPoints)
{
  double rounding = ofOffset * std::abs(half.Offset);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    rounding += std::abs(half.Normal[axis]) * ofPoints *
      std::max(std::abs(box.Lower[axis]), std::abs(box.Upper[axis]));
  }
  return rounding;
}

}

#endif
