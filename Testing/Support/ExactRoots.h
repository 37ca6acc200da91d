// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ExactRoots_h
#define ExactRoots_h

#include "Quad.h"

#include <array>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// In Bernstein form.
using QuadCubic = std::array<Quad, 4>;

inline bool IsInside(Quad value)
{
  return value >= 0;
}

/// The two halves of a cubic (de Casteljau).
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

/// Appends the roots in [low, high] at which a cubic changes its sign. The interval is halved 80
/// times, or until the coefficients have one sign.
inline void FindSignChanges(
  const QuadCubic& b, Quad low, Quad high, std::vector<Quad>& roots, int depth = 0)
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
      roots.push_back((low + high) / 2);
    }
    return;
  }
  const Quad middle = (low + high) / 2;
  const auto halves = Halves(b);
  FindSignChanges(halves[0], low, middle, roots, depth + 1);
  FindSignChanges(halves[1], middle, high, roots, depth + 1);
}

}

#endif
