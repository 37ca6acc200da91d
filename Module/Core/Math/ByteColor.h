// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ByteColor_h
#define ByteColor_h

#include "Math/Arithmetic.h"

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// A component of a colour, in [0, 1], scaled to where truncation rounds it to the nearest byte.
/// NaN, from a light without any attenuation at its own position, is black.
template <typename Number>
SIMD_INLINE Number ScaleToByte(Number value)
{
  return 255.0 * Select(0.0 < value, Min(value, Number(1.0)), Number(0.0)) + 0.5;
}

inline std::uint8_t ToByte(double value)
{
  return static_cast<std::uint8_t>(ScaleToByte(value));
}

}

#endif
