// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MonotonePieces_h
#define MonotonePieces_h

#include "Image/Cells/TrilinearCell.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// The roots in (0, 1) of the derivative a u^2 + 2 h u + c of a cubic, in order: there it may turn.
/// Returns how many there are, 0 to 2.
inline int TurningPoints(double a, double h, double c, double turns[2])
{
  const double discriminant = h * h - a * c;
  if (!(discriminant > 0.0))
  {
    return 0;
  }
  // The form that does not cancel; where a or w is zero, a quotient is infinite or NaN and falls
  // out of the comparisons.
  const double w = -(h + std::copysign(std::sqrt(discriminant), h));
  const double first = std::min(w / a, c / w);
  const double second = std::max(w / a, c / w);
  int count = 0;
  for (const double u : { first, second })
  {
    if (u > 0.0 && u < 1.0)
    {
      turns[count++] = u;
    }
  }
  return count;
}

/// Goes through the pieces of [0, 1] between the turning points of a function. Where its signs at
/// the two ends of a piece differ, there is one root: refine(lo, hi, atLo, atHi) finds it, and
/// visit(root, entering) is told, until it returns true. Entering says whether the function goes
/// from below zero to zero or above.
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
