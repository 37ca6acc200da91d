// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RandomNumbers_h
#define RandomNumbers_h

#include "Math/Vector.h"

#include <cmath>
#include <cstdint>
#include <random>

namespace vtkIsosurfaceRayTracing
{

/// Random numbers that every standard library draws alike from a seed.
class RandomNumbers
{
public:
  explicit RandomNumbers(std::uint64_t seed)
    : Engine(seed)
  {
  }

  std::uint64_t Bits() { return this->Engine(); }

  double Uniform(double low, double high)
  {
    return low + (high - low) * (static_cast<double>(this->Engine() >> 11) * 0x1p-53);
  }

  /// One of low, low + 1, ..., high.
  int Integer(int low, int high)
  {
    const auto count = static_cast<std::uint64_t>(high - low + 1);
    return low + static_cast<int>(this->Engine() % count);
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

  /// Of length one, no direction likelier than another.
  Vector3 Direction()
  {
    for (;;)
    {
      const Vector3 v = this->PointInBox({ -1.0, -1.0, -1.0 }, { 1.0, 1.0, 1.0 });
      const double square = Dot(v, v);
      if (square > 0.01 && square <= 1.0)
      {
        return v * (1.0 / std::sqrt(square));
      }
    }
  }

private:
  std::mt19937_64 Engine;
};

}

#endif
