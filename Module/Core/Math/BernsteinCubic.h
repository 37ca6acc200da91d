// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BernsteinCubic_h
#define BernsteinCubic_h

#include "Math/Arithmetic.h"

#include <array>

namespace vtkIsosurfaceRayTracing
{

/// A cubic on [0, 1] by its Bernstein coefficients: it starts at the first, ends at the last, and
/// stays between the smallest and the largest.
using BernsteinCubic = std::array<double, 4>;

/// Whether some coefficient has another sign than the first. If none has, there is no root: a cubic
/// lies in the hull of its coefficients.
template <typename Number>
SIMD_INLINE auto MayHaveRoot(const Number b[4])
{
  const auto inside = IsInside(b[0]);
  const auto changesAt1 = IsInside(b[1]) ^ inside;
  const auto changesAt2 = IsInside(b[2]) ^ inside;
  const auto changesAt3 = IsInside(b[3]) ^ inside;
  return changesAt1 | changesAt2 | changesAt3;
}

/// The size of the largest coefficient.
template <typename Number>
SIMD_INLINE Number GetSize(const Number b[4])
{
  return Max(Max(Abs(b[0]), Abs(b[1])), Max(Abs(b[2]), Abs(b[3])));
}

/// Whether squares of coefficients of a size neither overflow nor vanish.
template <typename Number>
SIMD_INLINE auto IsOrdinarySize(Number size)
{
  return (1e-100 <= size) & (size <= 1e100);
}

/// The cubic at a fraction of its interval, by convex combinations (de Casteljau).
template <typename Number>
SIMD_INLINE Number EvaluateBernstein(const Number b[4], Number u)
{
  const Number b01 = Lerp(b[0], b[1], u);
  const Number b12 = Lerp(b[1], b[2], u);
  const Number b23 = Lerp(b[2], b[3], u);
  return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
}

/// The derivative a u^2 + 2 h u + c of a cubic, up to a factor.
template <typename Number>
struct CubicDerivative
{
  Number A;
  Number H;
  Number C;

  SIMD_INLINE Number GetDiscriminant() const { return this->H * this->H - this->A * this->C; }

  /// The roots, the smaller one first, where the discriminant is positive. In the form that does
  /// not cancel; where A is zero, a quotient is infinite or NaN.
  SIMD_INLINE void FindRoots(Number discriminant, Number roots[2]) const
  {
    const Number w = 0.0 - (this->H + CopySign(Sqrt(discriminant), this->H));
    const Number first = w / this->A;
    const Number second = this->C / w;
    roots[0] = Min(first, second);
    roots[1] = Max(first, second);
  }
};

template <typename Number>
SIMD_INLINE CubicDerivative<Number> GetDerivative(const Number b[4])
{
  const Number d0 = b[1] - b[0];
  const Number d1 = b[2] - b[1];
  const Number d2 = b[3] - b[2];
  return { (d2 - d1) - (d1 - d0), d1 - d0, d0 };
}

/// Whether the coefficients, and with them the cubic, only rise or only fall.
template <typename Number>
SIMD_INLINE auto IsMonotone(const Number b[4])
{
  const Number d0 = b[1] - b[0];
  const Number d1 = b[2] - b[1];
  const Number d2 = b[3] - b[2];
  return ((0.0 <= d0) & (0.0 <= d1) & (0.0 <= d2)) | ((d0 <= 0.0) & (d1 <= 0.0) & (d2 <= 0.0));
}

//------------------------------------------------------------------------------
/// Refines the root of a cubic in an interval where it is monotone and its signs at the ends
/// differ: Newton's method, kept inside a shrinking bracket by bisection.
template <typename Number>
class RootRefinement
{
public:
  /// The method stops at a step of this size, in fractions of the segment. It has then converged to
  /// the square of it.
  static constexpr double Tolerance = 1e-10;
  /// Where it does not converge soon (near a triple root), bisection ends it.
  static constexpr int NewtonIterations = 40;
  static constexpr int MaximumIterations = NewtonIterations + 36;

  using Mask = decltype(Number() < Number());

  RootRefinement() = default;

  SIMD_INLINE RootRefinement(
    const Number b[4], Number low, Number high, Number atLow, Number atHigh)
    : C0(b[0])
    , C1(3.0 * (b[1] - b[0]))
    , C2(3.0 * ((b[2] - b[1]) - (b[1] - b[0])))
    , C3((b[3] - b[0]) - 3.0 * (b[2] - b[1]))
    , Low(low)
    , High(high)
    , IsInsideAtLow(IsInside(atLow))
    , U(Min(high, low + (high - low) * (atLow / (atLow - atHigh))))
  {
  }

  SIMD_INLINE Number GetRoot() const { return this->U; }

  /// Takes a step where isGoing. Returns where the root has not moved by more than the tolerance.
  SIMD_INLINE Mask Step(int iteration, Mask isGoing)
  {
    const Number u = this->U;
    const Number f = ((this->C3 * u + this->C2) * u + this->C1) * u + this->C0;
    const Mask isBeyond = IsInside(f) ^ this->IsInsideAtLow;
    this->Low = Select(isBeyond, this->Low, u);
    this->High = Select(isBeyond, u, this->High);
    const Number slope = (3.0 * this->C3 * u + 2.0 * this->C2) * u + this->C1;
    Number next = u - f / slope;
    const Mask isBetween = (this->Low <= next) & (next <= this->High);
    const Number half = this->Low + 0.5 * (this->High - this->Low);
    next = iteration < NewtonIterations ? Select(isBetween, next, half) : half;
    this->U = Select(isGoing, next, u);
    return Abs(next - u) <= Tolerance;
  }

private:
  // The cubic in powers of u.
  Number C0;
  Number C1;
  Number C2;
  Number C3;
  Number Low;
  Number High;
  Mask IsInsideAtLow;
  Number U;
};

}

#endif
