// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AnalyticSolver_h
#define AnalyticSolver_h

#include "Image/Cells/Solvers/PowerCubic.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

/// The closed form that Parker et al. 1998 used, with their special cases for a vanishing cubic and
/// quadratic coefficient: J. Schwarze, Cubic and Quartic Roots, Graphics Gems, 1990. In double.
///
/// As published: what is zero is decided by a fixed threshold, so that a cubic coefficient which is
/// but a rounding is divided by, and the roots are lost (on fields without an xyz term, most of
/// them); roots that fall just outside the segment by rounding are lost in both cells of a face;
/// and a double root counts although the ray only touches the surface. For comparison and teaching.
namespace Analytic
{

/// The EQN_EPS of Parker et al.; Schwarze's own 1e-9 is far too large for gentle data.
constexpr double Zero = 1e-30;
constexpr double Pi = 3.14159265358979323846;

inline bool IsZero(double x)
{
  return std::abs(x) < Zero;
}

inline int SolveLinear(const PowerCubic& c, double roots[3])
{
  if (IsZero(c[1]))
  {
    return 0;
  }
  roots[0] = -c[0] / c[1];
  return 1;
}

inline int SolveQuadratic(const PowerCubic& c, double roots[3])
{
  const double halfP = c[1] / (2.0 * c[2]);
  const double discriminant = halfP * halfP - c[0] / c[2];
  if (IsZero(discriminant))
  {
    roots[0] = -halfP;
    return 1;
  }
  if (discriminant < 0.0)
  {
    return 0;
  }
  const double root = std::sqrt(discriminant);
  roots[0] = -root - halfP;
  roots[1] = root - halfP;
  return 2;
}

inline int SolveCubic(const PowerCubic& c, double roots[3])
{
  const double a = c[2] / c[3];
  const double b = c[1] / c[3];
  const double third = a / 3.0;
  const double p = (b - a * third) / 3.0;
  const double q = 0.5 * (2.0 * third * third * third - third * b + c[0] / c[3]);
  const double pCubed = p * p * p;
  const double discriminant = q * q + pCubed;
  int count;
  if (IsZero(discriminant))
  {
    const double u = std::cbrt(-q);
    roots[0] = 2.0 * u;
    roots[1] = -u;
    count = IsZero(q) ? 1 : 2;
  }
  else if (discriminant < 0.0)
  {
    const double angle = std::acos(std::clamp(-q / std::sqrt(-pCubed), -1.0, 1.0)) / 3.0;
    const double t = 2.0 * std::sqrt(-p);
    roots[0] = t * std::cos(angle);
    roots[1] = -t * std::cos(angle + Pi / 3.0);
    roots[2] = -t * std::cos(angle - Pi / 3.0);
    count = 3;
  }
  else
  {
    const double root = std::sqrt(discriminant);
    roots[0] = std::cbrt(root - q) - std::cbrt(root + q);
    count = 1;
  }
  for (int i = 0; i < count; ++i)
  {
    roots[i] -= third;
  }
  return count;
}

/// Calls visit(u, entering) for every root in [0, 1], in order, until visit returns true.
template <typename Visit>
void ForEachRoot(const CellCorners& difference, const CellSegment& segment, Visit&& visit)
{
  const PowerCubic c = PowerCubicAlongSegment(difference, segment);
  double roots[3];
  const int count = !IsZero(c[3]) ? SolveCubic(c, roots)
    : !IsZero(c[2])               ? SolveQuadratic(c, roots)
                                  : SolveLinear(c, roots);
  for (int i = 1; i < count; ++i)
  {
    for (int j = i; j > 0 && roots[j] < roots[j - 1]; --j)
    {
      std::swap(roots[j], roots[j - 1]);
    }
  }
  for (int i = 0; i < count; ++i)
  {
    if (roots[i] >= 0.0 && roots[i] <= 1.0 &&
      visit(roots[i], EvaluateDerivative(c, roots[i]) > 0.0))
    {
      return;
    }
  }
}

}
}

#endif
