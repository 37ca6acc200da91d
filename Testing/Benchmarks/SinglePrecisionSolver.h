// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SinglePrecisionSolver_h
#define SinglePrecisionSolver_h

#include "Image/Cells/CellSegment.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace Benchmark
{

/// The algorithm of RobustSolver.h in single precision: what double precision costs and gains.
namespace SinglePrecision
{

using Cubic = std::array<float, 4>;
using Point = std::array<float, 3>;

/// A root is refined until a step is no larger than a few roundings; where that takes Newton's
/// method too long (near a triple root), by bisection.
constexpr float Tolerance = 1e-6F;
constexpr int NewtonIterations = 12;
constexpr int MaximumIterations = NewtonIterations + 24;

inline float Lerp(float a, float b, float t)
{
  return (1.0F - t) * a + t * b;
}

/// The Bernstein coefficients of the interpolant along the segment; see CubicAlongSegment.
inline Cubic MakeCubic(const std::array<float, 8>& v, const Point& p, const Point& q)
{
  float x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    x[0][i] = Lerp(v[2 * i], v[2 * i + 1], p[0]);
    x[1][i] = Lerp(v[2 * i], v[2 * i + 1], q[0]);
  }
  const auto blossom = [&x](int fromX, float y, float z)
  { return Lerp(Lerp(x[fromX][0], x[fromX][1], y), Lerp(x[fromX][2], x[fromX][3], y), z); };
  constexpr float third = 1.0F / 3.0F;
  return { blossom(0, p[1], p[2]),
    (blossom(1, p[1], p[2]) + blossom(0, q[1], p[2]) + blossom(0, p[1], q[2])) * third,
    (blossom(1, q[1], p[2]) + blossom(1, p[1], q[2]) + blossom(0, q[1], q[2])) * third,
    blossom(1, q[1], q[2]) };
}

inline float Evaluate(const Cubic& b, float u)
{
  const float b01 = Lerp(b[0], b[1], u);
  const float b12 = Lerp(b[1], b[2], u);
  const float b23 = Lerp(b[2], b[3], u);
  return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
}

/// The ends of the three monotone pieces; where there are fewer, some are empty.
inline Cubic FindPieces(const Cubic& b)
{
  const float d0 = b[1] - b[0];
  const float d1 = b[2] - b[1];
  const float d2 = b[3] - b[2];
  const float h = d1 - d0;
  const float a = (d2 - d1) - h;
  // NaN where nothing turns: comparisons with it are false.
  const float w = -(h + std::copysign(std::sqrt(h * h - a * d0), h));
  const float first = std::min(w / a, d0 / w);
  const float second = std::max(w / a, d0 / w);
  return { 0.0F, first > 0.0F && first < 1.0F ? first : 0.0F,
    second > 0.0F && second < 1.0F ? second : 1.0F, 1.0F };
}

/// The root in [lo, hi], where the cubic is monotone and its signs at the ends differ.
inline float RefineRoot(const Cubic& b, float lo, float hi, float atLo, float atHi)
{
  const float c1 = 3.0F * (b[1] - b[0]);
  const float c2 = 3.0F * ((b[2] - b[1]) - (b[1] - b[0]));
  const float c3 = (b[3] - b[0]) - 3.0F * (b[2] - b[1]);
  float u = std::min(hi, lo + (hi - lo) * (atLo / (atLo - atHi)));
  for (int i = 0; i < MaximumIterations; ++i)
  {
    const float f = Evaluate(b, u);
    ((f >= 0.0F) == (atLo >= 0.0F) ? lo : hi) = u;
    float next = u - f / ((3.0F * c3 * u + 2.0F * c2) * u + c1);
    if (!(next >= lo && next <= hi) || i >= NewtonIterations)
    {
      next = lo + 0.5F * (hi - lo);
    }
    const bool isDone = std::abs(next - u) <= Tolerance;
    u = next;
    if (isDone)
    {
      break;
    }
  }
  return u;
}

/// Calls visit(u, entering) for the roots along the segment, in order, until it returns true.
template <typename Visit>
void ForEachRoot(const vtkIsosurfaceRayTracing::CellCorners& difference,
  const vtkIsosurfaceRayTracing::CellSegment& segment, Visit&& visit)
{
  std::array<float, 8> corners;
  // What is outside stays outside: a negative number does not become zero, here nor in three
  // interpolations in turn.
  std::transform(difference.begin(), difference.end(), corners.begin(),
    [](double value)
    {
      return value < 0.0 ? std::min(static_cast<float>(value), -0x1p-100F)
                         : static_cast<float>(value);
    });
  Point entry;
  Point exit;
  std::copy(segment.Entry.begin(), segment.Entry.end(), entry.begin());
  std::copy(segment.Exit.begin(), segment.Exit.end(), exit.begin());
  const Cubic b = MakeCubic(corners, entry, exit);
  const bool inside = b[0] >= 0.0F;
  if ((b[1] >= 0.0F) == inside && (b[2] >= 0.0F) == inside && (b[3] >= 0.0F) == inside)
  {
    return;
  }
  const Cubic ends = FindPieces(b);
  float atLo = b[0];
  for (std::size_t piece = 0; piece < 3; ++piece)
  {
    const float hi = ends[piece + 1];
    // At the ends of the segment, to the last bit the values that both cells of a face see.
    const float atHi = hi <= 0.0F ? b[0] : (hi >= 1.0F ? b[3] : Evaluate(b, hi));
    const bool isInside = atHi >= 0.0F;
    if ((atLo >= 0.0F) != isInside && visit(RefineRoot(b, ends[piece], hi, atLo, atHi), isInside))
    {
      return;
    }
    atLo = atHi;
  }
}

}
}

#endif
