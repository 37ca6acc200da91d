// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MonotonePieces_h
#define MonotonePieces_h

#include "Math/BernsteinCubic.h"

namespace vtkIsosurfaceRayTracing
{

/// Where functions with a quadratic derivative may turn in (0, 1), in order.
template <typename Number>
struct TurningPoints
{
  using Mask = decltype(Number() < Number());

  Number At[2] = { 0.0, 0.0 };
  Mask Exists[2] = {};

  /// Finds the roots of a derivative, except where functions are known to be monotone.
  SIMD_INLINE void Find(const CubicDerivative<Number>& derivative, Mask isMonotone)
  {
    const Number discriminant = derivative.GetDiscriminant();
    const Mask hasRoots = AndNot(Number(0.0) < discriminant, isMonotone);
    if (!Any(hasRoots))
    {
      return;
    }
    derivative.FindRoots(Select(hasRoots, discriminant, Number(0.0)), this->At);
    for (int i = 0; i < 2; ++i)
    {
      // Infinite values and NaN fail the comparisons.
      this->Exists[i] = hasRoots & (Number(0.0) < this->At[i]) & (this->At[i] < Number(1.0));
    }
  }

  /// Finds those of a cubic.
  SIMD_INLINE void Find(const Number b[4]) { this->Find(GetDerivative(b), IsMonotone(b)); }
};

/// A piece of [0, 1] on which functions are monotone, and their values at its ends.
template <typename Number>
struct MonotonePiece
{
  Number Low;
  Number High;
  Number AtLow;
  Number AtHigh;
};

/// Visits the pieces of [0, 1] between the turning points of functions, in order. Where the signs
/// at the two ends of a piece differ, there is one root: visit(changes, piece) is called with where
/// they do, if they do anywhere, until it returns true.
template <typename Number, typename Evaluate, typename Visit>
SIMD_INLINE void ForEachSignChange(const TurningPoints<Number>& turns, Number atBegin, Number atEnd,
  const Evaluate& evaluate, const Visit& visit)
{
  Number low = 0.0;
  Number atLow = atBegin;
  for (int i = 0; i < 2; ++i)
  {
    const auto exists = turns.Exists[i];
    if (!Any(exists))
    {
      continue;
    }
    const Number high = turns.At[i];
    const Number atHigh = evaluate(high);
    const auto changes = exists & (IsInside(atLow) ^ IsInside(atHigh));
    if (Any(changes) && visit(changes, MonotonePiece<Number>{ low, high, atLow, atHigh }))
    {
      return;
    }
    low = Select(exists, high, low);
    atLow = Select(exists, atHigh, atLow);
  }
  const auto changes = IsInside(atLow) ^ IsInside(atEnd);
  if (Any(changes))
  {
    visit(changes, MonotonePiece<Number>{ low, 1.0, atLow, atEnd });
  }
}

}

#endif
