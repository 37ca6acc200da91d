// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CubicRoots_h
#define CubicRoots_h

#include "TrilinearCell.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// The sign rule of the whole ray tracer: what is equal to the isovalue is inside. A root is a
/// place where the sign changes. To touch the isovalue from inside and turn back is none; to touch
/// it from outside is to go in and out again at one place.
inline bool IsInside(double valueMinusIsovalue)
{
  return valueMinusIsovalue >= 0.0;
}

namespace Robust
{

/// Newton's method stops at a step of this size, in fractions of the segment. The step after it,
/// squared by the convergence, is taken too.
constexpr double Tolerance = 1e-10;
/// Bisection alone would be done by then.
constexpr int MaximumIterations = 64;

/// The cubic at a fraction of its interval, by convex combinations (de Casteljau).
inline double Evaluate(const BernsteinCubic& b, double u)
{
  const double b01 = Lerp(b[0], b[1], u);
  const double b12 = Lerp(b[1], b[2], u);
  const double b23 = Lerp(b[2], b[3], u);
  return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
}

/// The fractions in (0, 1) where the cubic may turn, in order: the interval falls into monotone
/// pieces. Returns how many there are (0 to 2).
inline int Extrema(const BernsteinCubic& b, double extrema[2])
{
  const double d0 = b[1] - b[0];
  const double d1 = b[2] - b[1];
  const double d2 = b[3] - b[2];
  if ((d0 >= 0.0 && d1 >= 0.0 && d2 >= 0.0) || (d0 <= 0.0 && d1 <= 0.0 && d2 <= 0.0))
  {
    return 0;
  }
  // The derivative is a u^2 + 2 h u + d0, up to a factor. Its roots in the form that does not
  // cancel; where a or w is zero, a quotient is infinite or NaN and falls out of the comparisons.
  const double h = d1 - d0;
  const double a = d2 - d1 - h;
  const double discriminant = h * h - a * d0;
  if (!(discriminant > 0.0))
  {
    return 0;
  }
  const double w = -(h + std::copysign(std::sqrt(discriminant), h));
  const double first = std::min(w / a, d0 / w);
  const double second = std::max(w / a, d0 / w);
  int count = 0;
  for (const double u : { first, second })
  {
    if (u > 0.0 && u < 1.0)
    {
      extrema[count++] = u;
    }
  }
  return count;
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
    if (!(next >= lo && next <= hi))
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
    const bool vanished = scaled == 0.0 && coefficient < 0.0;
    coefficient = vanished ? -std::numeric_limits<double>::denorm_min() : scaled;
  }
  return b;
}

/// Calls visit(u, rising) for every root of the cubic in [0, 1], in order, until visit returns
/// true. Rising tells whether the ray goes in (from below the isovalue to at or above it).
///
/// If all coefficients are on one side, there is no root (the hull). Else the interval is cut at
/// the extrema (Marmitt et al.: Fast and Accurate Ray-Voxel Intersection Techniques for Iso-Surface
/// Ray Tracing, VMV 2004), and a piece has a root if and only if the signs at its ends differ. All
/// in double.
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
  double ends[3];
  const int turns = Extrema(b, ends);
  ends[turns] = 1.0;
  double lo = 0.0;
  double atLo = b[0];
  for (int piece = 0; piece <= turns; ++piece)
  {
    const double hi = ends[piece];
    const double atHi = piece == turns ? b[3] : Evaluate(b, hi);
    if (IsInside(atLo) != IsInside(atHi) &&
      visit(RefineRoot(b, lo, hi, atLo, atHi), IsInside(atHi)))
    {
      return;
    }
    lo = hi;
    atLo = atHi;
  }
}

}
}

#endif
