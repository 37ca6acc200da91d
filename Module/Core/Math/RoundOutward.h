// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RoundOutward_h
#define RoundOutward_h

#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// The largest float that is not larger.
inline float RoundDown(double value)
{
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) > value
    ? std::nextafterf(rounded, -std::numeric_limits<float>::infinity())
    : rounded;
}

/// The smallest float that is not smaller.
inline float RoundUp(double value)
{
  return -RoundDown(-value);
}

}

#endif
