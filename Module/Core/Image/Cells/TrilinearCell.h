// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearCell_h
#define TrilinearCell_h

#include "Math/Vector.h"

#include <array>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// The sign rule of the whole ray tracer: what is equal to the isovalue is inside. A root is a
/// place where the sign changes. To touch the isovalue from inside and turn back is none; to touch
/// it from outside is to go in and out again at one place.
inline bool IsInside(double valueMinusIsovalue)
{
  return valueMinusIsovalue >= 0.0;
}

/// The values at the corners of a cell: corner (x, y, z) in {0, 1}^3 is number x + 2 y + 4 z.
using CellCorners = std::array<double, 8>;

/// Corners smaller than this, and not zero, could vanish in three interpolations in turn, and their
/// sign with them.
constexpr double SmallestDifference = 0x1p-900;

/// The difference between a value and the isovalue, both multiplied by a power of two. Its sign is
/// exact.
inline double Difference(double value, double isovalue, double scale)
{
  const double difference = value * scale - isovalue * scale;
  if (std::abs(difference) >= SmallestDifference)
  {
    return difference;
  }
  return value < isovalue ? -SmallestDifference : (value > isovalue ? SmallestDifference : 0.0);
}

/// Linear interpolation that is exact at both ends and never changes the common sign of a and b,
/// unless they all but vanish (see SmallestDifference). (a + t (b - a) is neither.) Written without
/// fma, so that every instruction set gives one result.
inline double Lerp(double a, double b, double t)
{
  return (1.0 - t) * a + t * b;
}

/// The trilinear interpolant at a point of the cell.
inline double Interpolate(const CellCorners& v, const Vector3& p)
{
  const double y0z0 = Lerp(v[0], v[1], p[0]);
  const double y1z0 = Lerp(v[2], v[3], p[0]);
  const double y0z1 = Lerp(v[4], v[5], p[0]);
  const double y1z1 = Lerp(v[6], v[7], p[0]);
  return Lerp(Lerp(y0z0, y1z0, p[1]), Lerp(y0z1, y1z1, p[1]), p[2]);
}

/// The gradient of the trilinear interpolant, per cell edge along each axis.
inline Vector3 InterpolantGradient(const CellCorners& v, const Vector3& p)
{
  const auto bilinear = [](double d00, double d10, double d01, double d11, double s, double t)
  { return Lerp(Lerp(d00, d10, s), Lerp(d01, d11, s), t); };
  return { bilinear(v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6], p[1], p[2]),
    bilinear(v[2] - v[0], v[3] - v[1], v[6] - v[4], v[7] - v[5], p[0], p[2]),
    bilinear(v[4] - v[0], v[5] - v[1], v[6] - v[2], v[7] - v[3], p[0], p[1]) };
}

/// A cubic on [0, 1] by its Bernstein coefficients: it starts at the first, ends at the last, and
/// stays between the smallest and the largest.
using BernsteinCubic = std::array<double, 4>;

/// The trilinear interpolant along the straight line from p to q, as a cubic of the fraction of the
/// way.
///
/// A trilinear function is its own blossom: with each coordinate taken from p or from q, the values
/// at the eight corners of the box [p, q] give the Bernstein coefficients as means over the corners
/// that take 0, 1, 2 or 3 coordinates from q. These are convex combinations only; the usual
/// coefficients of powers cancel. The ends are Interpolate(p) and Interpolate(q) to the last bit.
/// (L. Ramshaw: Blossoms are polar forms. Computer Aided Geometric Design 6(4), 1989.)
inline BernsteinCubic CubicAlongSegment(const CellCorners& v, const Vector3& p, const Vector3& q)
{
  double x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    x[0][i] = Lerp(v[2 * i], v[2 * i + 1], p[0]);
    x[1][i] = Lerp(v[2 * i], v[2 * i + 1], q[0]);
  }
  const auto blossom = [&x](int fromX, double y, double z)
  { return Lerp(Lerp(x[fromX][0], x[fromX][1], y), Lerp(x[fromX][2], x[fromX][3], y), z); };
  const double once = blossom(1, p[1], p[2]) + blossom(0, q[1], p[2]) + blossom(0, p[1], q[2]);
  const double twice = blossom(1, q[1], p[2]) + blossom(1, p[1], q[2]) + blossom(0, q[1], q[2]);
  constexpr double third = 1.0 / 3.0;
  return { blossom(0, p[1], p[2]), once * third, twice * third, blossom(1, q[1], q[2]) };
}

}

#endif
