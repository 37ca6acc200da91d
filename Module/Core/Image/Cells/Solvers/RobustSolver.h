// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RobustSolver_h
#define RobustSolver_h

#include "Image/Cells/CellSegment.h"
#include "Image/Cells/TrilinearCell.h"
#include "Math/MonotonePieces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// The default solver: Bernstein form, cut into monotone pieces, guarded Newton, all in double.
///
/// If all coefficients are on one side, there is no root (the hull). Else the interval is cut at
/// the extrema (Marmitt et al. 2004, see MarmittSolver.h), and a piece has a root if and only if
/// the signs at its ends differ. The ends of the segment have the sign that both cells of a face
/// see.
namespace Robust
{

/// Newton's method stops at a step of this size, in fractions of the segment. It has then converged
/// to the square of it.
constexpr double Tolerance = 1e-10;
/// Where that does not come soon (near a triple root), bisection brings it to an end.
constexpr int NewtonIterations = 40;
constexpr int MaximumIterations = NewtonIterations + 36;

/// The cubic at a fraction of its interval, by convex combinations (de Casteljau).
inline double Evaluate(const BernsteinCubic& b, double u)
{
  const double b01 = Lerp(b[0], b[1], u);
  const double b12 = Lerp(b[1], b[2], u);
  const double b23 = Lerp(b[2], b[3], u);
  return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
}

/// Where the cubic turns, in (0, 1). Returns how often.
inline int Extrema(const BernsteinCubic& b, double turns[2])
{
  const double d0 = b[1] - b[0];
  const double d1 = b[2] - b[1];
  const double d2 = b[3] - b[2];
  const bool monotone =
    (d0 >= 0.0 && d1 >= 0.0 && d2 >= 0.0) || (d0 <= 0.0 && d1 <= 0.0 && d2 <= 0.0);
  return monotone ? 0 : TurningPoints((d2 - d1) - (d1 - d0), d1 - d0, d0, turns);
}

/// The root in [lo, hi], where the cubic is monotone and its signs at the ends differ: Newton's
/// method, kept inside a shrinking bracket by bisection.
inline double RefineRoot(const BernsteinCubic& b, double lo, double hi, double atLo, double atHi)
{
  const double c1 = 3.0 * (b[1] - b[0]);
  const double c2 = 3.0 * ((b[2] - b[1]) - (b[1] - b[0]));
  const double c3 = (b[3] - b[0]) - 3.0 * (b[2] - b[1]);
  const bool insideAtLo = IsInside(atLo);
  double u = std::min(hi, lo + (hi - lo) * (atLo / (atLo - atHi)));
  for (int i = 0; i < MaximumIterations; ++i)
  {
    const double f = ((c3 * u + c2) * u + c1) * u + b[0];
    (IsInside(f) == insideAtLo ? lo : hi) = u;
    const double slope = (3.0 * c3 * u + 2.0 * c2) * u + c1;
    double next = u - f / slope;
    if (!(next >= lo && next <= hi) || i >= NewtonIterations)
    {
      next = lo + 0.5 * (hi - lo);
    }
    const bool done = std::abs(next - u) <= Tolerance;
    u = next;
    if (done)
    {
      break;
    }
  }
  return u;
}

/// Brings coefficients of extreme size near 1, by a power of two, where squares neither overflow
/// nor vanish. The roots stay where they are, and so does the sign of every coefficient.
inline BernsteinCubic Normalize(BernsteinCubic b)
{
  const double size =
    std::max(std::max(std::abs(b[0]), std::abs(b[1])), std::max(std::abs(b[2]), std::abs(b[3])));
  const bool isExtreme = size < 1e-100 || size > 1e100;
  if (!isExtreme || size == 0.0 || !std::isfinite(size))
  {
    return b;
  }
  const int exponent = std::clamp(-std::ilogb(size), -1000, 1000);
  for (double& coefficient : b)
  {
    const double scaled = std::ldexp(coefficient, exponent);
    const bool vanishes = coefficient < 0.0 && scaled > -SmallestDifference;
    coefficient = vanishes ? -SmallestDifference : scaled;
  }
  return b;
}

/// Calls visit(u, entering) for every root of the cubic in [0, 1], in order, until visit returns
/// true. Entering tells whether the ray goes in (from below the isovalue to at or above it).
template <typename Visit>
void ForEachRoot(const BernsteinCubic& coefficients, Visit&& visit)
{
  const bool inside = IsInside(coefficients[0]);
  if (IsInside(coefficients[1]) == inside && IsInside(coefficients[2]) == inside &&
    IsInside(coefficients[3]) == inside)
  {
    return;
  }
  const BernsteinCubic b = Normalize(coefficients);
  double turns[2];
  const int count = Extrema(b, turns);
  ForEachSignChange(
    turns, count, b[0], b[3], [&b](double u) { return Evaluate(b, u); },
    [&b](double lo, double hi, double atLo, double atHi)
    { return RefineRoot(b, lo, hi, atLo, atHi); },
    visit);
}

/// The roots of the interpolant of corner values (isovalue taken off) along a segment of the cell.
template <typename Visit>
void ForEachRoot(const CellCorners& difference, const CellSegment& segment, Visit&& visit)
{
  ForEachRoot(CubicAlongSegment(difference, segment.Entry, segment.Exit), visit);
}

}
}

#endif
