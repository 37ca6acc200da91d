// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NonicRoots_h
#define NonicRoots_h

#include "Math/Arithmetic.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// A polynomial of degree 9 on [0, 1] by its Bernstein coefficients.
using BernsteinNonic = std::array<double, 10>;

/// All roots of a polynomial of degree 9, found numerically.
///
/// By Descartes' rule a polynomial has no more roots in an interval than its Bernstein coefficients
/// there change sign: none if they do not, one if they do once. Where they do more often, the
/// interval is halved, which brings the coefficients nearer to the values (J. M. Lane, R. F.
/// Riesenfeld: Bounds on a polynomial. BIT 21, 1981). A root alone in its interval is found by
/// Newton's method in a bracket.
namespace Nonic
{

/// An interval this small is not halved any more: the signs at its ends decide whether it has a
/// root. Two roots nearer to each other, in fractions of the segment, may be missed.
constexpr double SmallestInterval = 0x1p-40;
/// Newton's method stops at a step of this size, in fractions of the segment. It has then converged
/// to the square of it.
constexpr double Tolerance = 1e-8;
/// Where it does not converge soon, bisection ends it.
constexpr int NewtonIterations = 40;
constexpr int MaximumIterations = NewtonIterations + 36;

/// A polynomial and its slope, by sums of products that are convex combinations.
class Sums
{
public:
  explicit Sums(const BernsteinNonic& b)
  {
    constexpr double binomial9[10] = { 1.0, 9.0, 36.0, 84.0, 126.0, 126.0, 84.0, 36.0, 9.0, 1.0 };
    constexpr double binomial8[9] = { 1.0, 8.0, 28.0, 56.0, 70.0, 56.0, 28.0, 8.0, 1.0 };
    for (std::size_t i = 0; i < 9; ++i)
    {
      this->Values[i] = binomial9[i] * b[i];
      this->Slopes[i] = 9.0 * binomial8[i] * (b[i + 1] - b[i]);
    }
    this->Values[9] = b[9];
  }

  void Evaluate(double u, double& value, double& slope) const
  {
    const double s = 1.0 - u;
    double powers[2][10] = { { 1.0 }, { 1.0 } };
    for (std::size_t i = 1; i < 10; ++i)
    {
      powers[0][i] = powers[0][i - 1] * u;
      powers[1][i] = powers[1][i - 1] * s;
    }
    value = powers[0][9] * this->Values[9];
    slope = 0.0;
    for (std::size_t i = 0; i < 9; ++i)
    {
      value += powers[0][i] * powers[1][9 - i] * this->Values[i];
      slope += powers[0][i] * powers[1][8 - i] * this->Slopes[i];
    }
  }

private:
  double Values[10];
  double Slopes[9];
};

/// Leaves the lower half of the interval in the polynomial, and returns the upper half. Both have
/// the very same value in the middle.
inline BernsteinNonic Halve(BernsteinNonic& b)
{
  BernsteinNonic upper;
  const std::size_t last = b.size() - 1;
  upper[last] = b[last];
  for (std::size_t done = 1; done <= last; ++done)
  {
    for (std::size_t i = last; i >= done; --i)
    {
      b[i] = 0.5 * b[i - 1] + 0.5 * b[i];
    }
    upper[last - done] = b[last];
  }
  return upper;
}

inline int CountSignChanges(const BernsteinNonic& b)
{
  int count = 0;
  for (std::size_t i = 1; i < b.size(); ++i)
  {
    count += IsInside(b[i]) != IsInside(b[i - 1]) ? 1 : 0;
  }
  return count;
}

/// The one root of a polynomial whose signs at the ends differ, as a fraction of its interval, to a
/// tolerance.
inline double RefineRoot(const BernsteinNonic& b, double tolerance)
{
  const bool insideAtLo = IsInside(b.front());
  const Sums sums(b);
  double lo = 0.0;
  double hi = 1.0;
  double u = std::min(1.0, b.front() / (b.front() - b.back()));
  for (int i = 0; i < MaximumIterations; ++i)
  {
    double value;
    double slope;
    sums.Evaluate(u, value, slope);
    (IsInside(value) == insideAtLo ? lo : hi) = u;
    double next = u - value / slope;
    if (!(next >= lo && next <= hi) || i >= NewtonIterations)
    {
      next = lo + 0.5 * (hi - lo);
    }
    const bool done = std::abs(next - u) <= tolerance;
    u = next;
    if (done)
    {
      break;
    }
  }
  return u;
}

/// Calls visit(u, entering) for every root in [0, 1], in order, until visit returns true. Entering
/// says whether the ray enters the surface (from below the isovalue to at or above it).
template <typename Visit>
void ForEachRoot(const BernsteinNonic& nonic, const Visit& visit)
{
  struct Interval
  {
    double Begin;
    double Width;
    BernsteinNonic Coefficients;
  };
  // One for each halving, and the current one.
  std::array<Interval, 42> waiting;
  std::size_t count = 0;
  waiting[count++] = { 0.0, 1.0, nonic };
  while (count > 0)
  {
    Interval& interval = waiting[count - 1];
    BernsteinNonic& b = interval.Coefficients;
    const int changes = CountSignChanges(b);
    if (changes > 1 && interval.Width > SmallestInterval)
    {
      const double half = 0.5 * interval.Width;
      const Interval upper = { interval.Begin + half, half, Halve(b) };
      waiting[count] = { interval.Begin, half, b };
      interval = upper;
      ++count;
      continue;
    }
    --count;
    if (IsInside(b.front()) != IsInside(b.back()))
    {
      const double u = interval.Begin + interval.Width * RefineRoot(b, Tolerance / interval.Width);
      if (visit(u, IsInside(b.back())))
      {
        return;
      }
    }
  }
}

}
}

#endif
