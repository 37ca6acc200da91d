// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RoundOutward_h
#define RoundOutward_h

#include <cstdint>
#include <cstring>

namespace vtkIsosurfaceRayTracing
{

/// The largest float that is not larger.
inline float RoundDown(double value)
{
  auto rounded = static_cast<float>(value);
  // The next float is the next integer, counted from zero: std::nextafter would take longer.
  std::int32_t bits;
  std::memcpy(&bits, &rounded, sizeof(bits));
  constexpr std::int32_t smallestBelowZero = static_cast<std::int32_t>(0x80000001U);
  const std::int32_t next = rounded > 0.0F ? bits - 1
    : rounded < 0.0F                       ? bits + 1
                                           : smallestBelowZero;
  bits = static_cast<double>(rounded) > value ? next : bits;
  std::memcpy(&rounded, &bits, sizeof(bits));
  return rounded;
}

/// The smallest float that is not smaller.
inline float RoundUp(double value)
{
  return -RoundDown(-value);
}

}

#endif
