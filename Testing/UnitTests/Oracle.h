// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Oracle_h
#define Oracle_h

#include <array>
#include <vector>

// Numbers become longer here on purpose.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wdouble-promotion"
#endif

namespace vtkIsosurfaceRayTracing
{

/// Slow and exact arithmetic to judge the fast one by: 113 bits, where the compiler has them.
#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 Quad;
#else
using Quad = long double;
#endif

using QuadCubic = std::array<Quad, 4>;

inline bool IsInside(Quad value)
{
  return value >= 0;
}

/// The two halves of a cubic in Bernstein form (de Casteljau).
inline std::array<QuadCubic, 2> Halves(const QuadCubic& b)
{
  const Quad m01 = (b[0] + b[1]) / 2;
  const Quad m12 = (b[1] + b[2]) / 2;
  const Quad m23 = (b[2] + b[3]) / 2;
  const Quad left = (m01 + m12) / 2;
  const Quad right = (m12 + m23) / 2;
  const Quad middle = (left + right) / 2;
  return { QuadCubic{ b[0], m01, left, middle }, QuadCubic{ middle, right, m23, b[3] } };
}

/// Appends the places in [low, high] where a cubic in Bernstein form changes its sign: by halving
/// the interval until the signs of the coefficients leave no more than one such place, and then
/// until that place is known.
inline void FindSignChanges(
  const QuadCubic& b, Quad low, Quad high, std::vector<Quad>& places, int depth = 0)
{
  int changes = 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    changes += IsInside(b[i]) == IsInside(b[i + 1]) ? 0 : 1;
  }
  if (changes == 0)
  {
    return;
  }
  if (depth == 80)
  {
    if (IsInside(b[0]) != IsInside(b[3]))
    {
      places.push_back((low + high) / 2);
    }
    return;
  }
  const Quad middle = (low + high) / 2;
  const auto halves = Halves(b);
  FindSignChanges(halves[0], low, middle, places, depth + 1);
  FindSignChanges(halves[1], middle, high, places, depth + 1);
}

}

#endif
