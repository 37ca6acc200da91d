// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HardCases_Dice_h
#define HardCases_Dice_h

#include "Oracle.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

namespace HardCases
{

/// Random numbers that every standard library draws alike from a seed.
class Dice
{
public:
  explicit Dice(std::uint64_t seed)
    : Engine(seed)
  {
  }

  std::uint64_t Bits() { return this->Engine(); }

  /// A double of any kind at all.
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
    return low +
      static_cast<int>(this->Engine() % static_cast<std::uint64_t>(std::int64_t{ high } - low + 1));
  }

  Oracle::Triple Point(double low, double high)
  {
    const double x = this->Uniform(low, high);
    const double y = this->Uniform(low, high);
    return { x, y, this->Uniform(low, high) };
  }

  Oracle::Triple PointIn(const Oracle::Index& dimensions)
  {
    const double x = this->Uniform(0.0, dimensions[0] - 1);
    const double y = this->Uniform(0.0, dimensions[1] - 1);
    return { x, y, this->Uniform(0.0, dimensions[2] - 1) };
  }

  /// Of length one, no direction likelier than another.
  Oracle::Triple Direction()
  {
    for (;;)
    {
      const Oracle::Triple v = this->Point(-1.0, 1.0);
      const double length = Oracle::Length(v);
      if (length > 0.1 && length <= 1.0)
      {
        return { v[0] / length, v[1] / length, v[2] / length };
      }
    }
  }

private:
  std::mt19937_64 Engine;
};

}

#endif
