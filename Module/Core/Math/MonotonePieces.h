// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MonotonePieces_h
#define MonotonePieces_h

#include "Math/BernsteinCubic.h"

namespace vtkIsosurfaceRayTracing
{

/// The roots in (0, 1) of the derivative of a cubic, in order: there it may turn. Returns how many
/// there are, 0 to 2.
inline int TurningPoints(const CubicDerivative<double>& derivative, double turns[2])
{
  const double discriminant = derivative.GetDiscriminant();
  if (!(discriminant > 0.0))
  {
    return 0;
  }
  double roots[2];
  derivative.FindRoots(discriminant, roots);
  int count = 0;
  for (const double u : roots)
  {
    // Infinite values and NaN fail the comparisons.
    if (u > 0.0 && u < 1.0)
    {
      turns[count++] = u;
    }
  }
  return count;
}

/// Visits the pieces of [0, 1] between the turning points of a function. Where its signs at the two
/// ends of a piece differ, there is one root: refine(lo, hi, atLo, atHi) finds it, and visit(root,
/// entering) is called, until it returns true. Entering says whether the function rises from below
/// zero to zero or above.
template <typename Evaluate, typename Refine, typename Visit>
void ForEachSignChange(const double turns[2], int count, double atBegin, double atEnd,
  const Evaluate& evaluate, const Refine& refine, Visit&& visit)
{
  double lo = 0.0;
  double atLo = atBegin;
  for (int piece = 0; piece <= count; ++piece)
  {
    const bool isLast = piece == count;
    const double hi = isLast ? 1.0 : turns[piece];
    const double atHi = isLast ? atEnd : evaluate(hi);
    if (IsInside(atLo) != IsInside(atHi) && visit(refine(lo, hi, atLo, atHi), IsInside(atHi)))
    {
      return;
    }
    lo = hi;
    atLo = atHi;
  }
}

}

#endif
