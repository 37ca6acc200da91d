// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Hemisphere_h
#define Hemisphere_h

#include "Math/Vector.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Pseudorandom numbers that are a function of the position of a hit alone: they do not depend on
/// threads, tiles or order. Positions are rounded to a thousandth of a cell, so that the last bits
/// of a camera make no difference. Frames that are averaged have different numbers.
class HitNumbers
{
public:
  /// The point is counted in cells.
  explicit HitNumbers(const Vector3& point, int frame = 0)
    : State(static_cast<std::uint64_t>(frame) * 0x9e3779b97f4a7c15U)
  {
    for (const double coordinate : point)
    {
      // Surfaces often lie at simple fractions of a cell; the steps do not.
      const double step = std::floor(1024.0 * coordinate + 0.37);
      this->State = Mix(this->State ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(step)));
    }
  }

  /// In [0, 1).
  double Next()
  {
    this->State += 0x9e3779b97f4a7c15U;
    return static_cast<double>(Mix(this->State) >> 11) * 0x1p-53;
  }

private:
  /// G. Steele, D. Lea, C. Flood: Fast Splittable Pseudorandom Number Generators, OOPSLA 2014.
  static std::uint64_t Mix(std::uint64_t z)
  {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
  }

  std::uint64_t State;
};

/// Directions about a normal, distributed by the cosine. They lie above the points of a sunflower
/// on a disc (H. Vogel, 1979): for each a new angle, the golden one, and a new ring of the same
/// area. Only + - * / and square roots are used, which give the same bits everywhere.
class Hemisphere
{
public:
  /// The normal has length one; rotated about it, and shifted in the rings, by numbers of the hit.
  Hemisphere(const Vector3& normal, int count, HitNumbers numbers)
    : Normal(normal)
    , Count(count)
    , Offset(numbers.Next())
  {
    // T. Duff et al.: Building an Orthonormal Basis, Revisited. JCGT 6(1), 2017.
    const double sign = std::copysign(1.0, normal[2]);
    const double a = -1.0 / (sign + normal[2]);
    const double b = normal[0] * normal[1] * a;
    this->Across = { 1.0 + sign * normal[0] * normal[0] * a, sign * b, -sign * normal[0] };
    this->Up = { b, sign + normal[1] * normal[1] * a, -normal[1] };
    double square = 0.0;
    while (!(square > 0.01 && square <= 1.0))
    {
      this->Angle = { 2.0 * numbers.Next() - 1.0, 2.0 * numbers.Next() - 1.0 };
      square = this->Angle[0] * this->Angle[0] + this->Angle[1] * this->Angle[1];
    }
    const double length = std::sqrt(square);
    this->Angle = { this->Angle[0] / length, this->Angle[1] / length };
  }

  /// The next of so many directions, of length one.
  Vector3 Next()
  {
    constexpr double cosine = -0.7373688780783197; // of the golden angle
    constexpr double sine = 0.6754902942615238;
    const double share = (this->Done++ + this->Offset) / this->Count;
    const double radius = std::sqrt(share);
    this->Angle = { this->Angle[0] * cosine - this->Angle[1] * sine,
      this->Angle[0] * sine + this->Angle[1] * cosine };
    return this->Across * (radius * this->Angle[0]) + this->Up * (radius * this->Angle[1]) +
      this->Normal * std::sqrt(1.0 - share);
  }

private:
  Vector3 Normal;
  Vector3 Across;
  Vector3 Up;
  int Count;
  int Done = 0;
  double Offset;
  std::array<double, 2> Angle = { 1.0, 0.0 };
};

}

#endif
