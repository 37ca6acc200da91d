// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RobustSolver_h
#define RobustSolver_h

#include "Image/Cells/CellSegment.h"
#include "Math/MonotonePieces.h"
#include "Math/TrilinearCell.h"

#include <algorithm>
#include <cmath>

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

/// The cubic at a fraction of its interval.
inline double Evaluate(const BernsteinCubic& b, double u)
{
  return EvaluateBernstein(b.data(), u);
}

/// The root in a piece where the cubic is monotone and its signs at the ends differ.
inline double RefineRoot(const BernsteinCubic& b, const MonotonePiece<double>& piece)
{
  using Refinement = RootRefinement<double>;
  Refinement refinement(b.data(), piece.Low, piece.High, piece.AtLow, piece.AtHigh);
  bool isDone = false;
  for (int i = 0; i < Refinement::MaximumIterations && !isDone; ++i)
  {
    isDone = refinement.Step(i, true);
  }
  return refinement.GetRoot();
}

/// Brings coefficients of extreme size near 1, by a power of two, where squares neither overflow
/// nor vanish. The roots stay where they are, and so does the sign of every coefficient.
inline BernsteinCubic Normalize(BernsteinCubic b)
{
  const double size = GetSize(b.data());
  if (IsOrdinarySize(size) || size == 0.0 || !std::isfinite(size))
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
/// true. Entering says whether the ray enters the surface (from below the isovalue to at or above
/// it).
template <typename Visit>
void ForEachRoot(const BernsteinCubic& coefficients, Visit&& visit)
{
  if (!MayHaveRoot(coefficients.data()))
  {
    return;
  }
  const BernsteinCubic b = Normalize(coefficients);
  TurningPoints<double> turns;
  turns.Find(b.data());
  ForEachSignChange(
    turns, b[0], b[3], [&b](double u) { return Evaluate(b, u); },
    [&b, &visit](bool /*changes*/, const MonotonePiece<double>& piece)
    { return visit(RefineRoot(b, piece), IsInside(piece.AtHigh)); });
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
