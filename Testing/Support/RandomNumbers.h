// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RandomNumbers_h
#define RandomNumbers_h

#include "Math/Vector.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{

/// Random numbers that every standard library draws alike from a seed. An assertion that fails
/// while the generator is in scope prints the seed.
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : Trace(__FILE__, __LINE__, "seed " + std::to_string(seed))
    , Engine(seed)
  {
  }

  std::uint64_t Bits() { return this->Engine(); }

  /// Of random bits: infinities, NaNs and denormal numbers too.
  double AnyDouble()
  {
    const std::uint64_t bits = this->Engine();
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  double Uniform(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(this->Engine() >> 11) * 0x1p-53);
  }

  /// One of low, low + 1, ..., high.
  int Integer(int low, int high)
  {
    const auto count = static_cast<std::uint64_t>(std::int64_t{ high } - low + 1);
    return static_cast<int>(low + static_cast<std::int64_t>(this->Engine() % count));
  }

  /// Of either sign, and of any order of magnitude between two powers of ten.
  double WideMagnitude(double lowExponent, double highExponent)
  {
    const double magnitude = std::pow(10.0, this->Uniform(lowExponent, highExponent));
    return this->Integer(0, 1) == 0 ? magnitude : -magnitude;
  }

  Vector3 PointInBox(const Vector3& low, const Vector3& high)
  {
    const double x = this->Uniform(low[0], high[0]);
    const double y = this->Uniform(low[1], high[1]);
    return { x, y, this->Uniform(low[2], high[2]) };
  }

  /// Between the first and the last samples of a volume.
  Vector3 PointInVolume(const Index3& dimensions)
  {
    return this->PointInBox(
      { 0.0, 0.0, 0.0 }, { dimensions[0] - 1.0, dimensions[1] - 1.0, dimensions[2] - 1.0 });
  }

  /// Of length one, uniformly distributed.
  Vector3 Direction()
  {
    for (;;)
    {
      const Vector3 v = this->PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
      const double length = std::hypot(v[0], v[1], v[2]);
      if (length > 0.1 && length <= 1.0)
      {
        return { v[0] / length, v[1] / length, v[2] / length };
      }
    }
  }

private:
  testing::ScopedTrace Trace;
  std::mt19937_64 Engine;
};

}

#endif
