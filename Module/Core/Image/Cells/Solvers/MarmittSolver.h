// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MarmittSolver_h
#define MarmittSolver_h

#include "Image/Cells/Solvers/PowerCubic.h"
#include "Math/MonotonePieces.h"

namespace vtkIsosurfaceRayTracing
{

/// The interval is cut at the extrema of the cubic, and in the first piece whose ends differ in
/// sign the root is approached by linear interpolation, a fixed number of times: G. Marmitt, A.
/// Kleer, I. Wald, H. Friedrich, P. Slusallek: Fast and Accurate Ray-Voxel Intersection Techniques
/// for Iso-Surface Ray Tracing, VMV 2004. In double, and with one change: the values at the ends of
/// the segment are interpolated on the faces of the cell, where both cells agree on them, instead
/// of coming from the coefficients. So it loses no hit between cells; it is only less accurate.
namespace Marmitt
{

/// The last of so many linear interpolations in a bracket whose ends differ in sign.
inline double InterpolateRepeatedly(
  const PowerCubic& c, MonotonePiece<double> piece, int interpolations)
{
  double u = piece.Low;
  for (int i = 0; i < interpolations; ++i)
  {
    u = piece.Low + (piece.High - piece.Low) * (piece.AtLow / (piece.AtLow - piece.AtHigh));
    const double f = Evaluate(c, u);
    if (IsInside(f) == IsInside(piece.AtLow))
    {
      piece.Low = u;
      piece.AtLow = f;
    }
    else
    {
      piece.High = u;
      piece.AtHigh = f;
    }
  }
  return u;
}

/// Calls visit(u, entering) for every root in [0, 1], in order, until visit returns true.
template <typename Visit>
void ForEachRoot(
  const CellCorners& difference, const CellSegment& segment, int interpolations, Visit&& visit)
{
  const PowerCubic c = PowerCubicAlongSegment(difference, segment);
  TurningPoints<double> turns;
  turns.Find({ 3.0 * c[3], c[2], c[1] }, false);
  ForEachSignChange(
    turns, Interpolate(difference, segment.Entry), Interpolate(difference, segment.Exit),
    [&c](double u) { return Evaluate(c, u); },
    [&c, interpolations, &visit](bool /*changes*/, const MonotonePiece<double>& piece)
    { return visit(InterpolateRepeatedly(c, piece, interpolations), IsInside(piece.AtHigh)); });
}

}
}

#endif
