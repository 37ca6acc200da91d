// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearCell_h
#define TrilinearCell_h

#include "Math/Arithmetic.h"
#include "Math/BernsteinCubic.h"
#include "Math/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// The values at the corners of a cell: corner (x, y, z) in {0, 1}^3 is number x + 2 y + 4 z.
using CellCorners = std::array<double, 8>;

/// Corners smaller than this, and not zero, could vanish in three interpolations in turn, and their
/// sign with them.
constexpr double SmallestDifference = 0x1p-900;

/// The power of two by which values in a range are multiplied before the isovalue is subtracted: 1,
/// unless the values are so large or small that products of differences overflow or vanish.
inline double GetValueScale(double low, double high, double isovalue)
{
  const double size = std::max({ std::abs(low), std::abs(high), std::abs(isovalue) });
  const bool isExtreme = size < 0x1p-400 || size > 0x1p400;
  return isExtreme && std::isfinite(size) && size > 0.0
    ? std::ldexp(1.0, std::clamp(-std::ilogb(size), -1000, 1000))
    : 1.0;
}

/// A difference between a value and the isovalue that keeps its sign in interpolations.
template <typename Number>
SIMD_INLINE Number KeepSign(Number difference, Number value, double isovalue)
{
  const Number sign = Select(value < isovalue, -SmallestDifference,
    Select(isovalue < value, SmallestDifference, Number(0.0)));
  return Select(SmallestDifference <= Abs(difference), difference, sign);
}

/// The difference between a value and the isovalue, both multiplied by a power of two. Its sign is
/// exact.
inline double Difference(double value, double isovalue, double scale)
{
  return KeepSign(value * scale - isovalue * scale, value, isovalue);
}

/// The differences between the corners of cells and an isovalue, finite ones, as Difference has
/// them.
template <typename Number>
SIMD_INLINE void FindDifferences(
  const Number corners[8], double isovalue, double scale, Number differences[8])
{
  const Number scaled = isovalue * scale;
  Number least = SmallestDifference;
  for (int i = 0; i < 8; ++i)
  {
    differences[i] = (scale == 1.0 ? corners[i] : corners[i] * scale) - scaled;
    least = Min(least, Abs(differences[i]));
  }
  if (!Any(least < SmallestDifference))
  {
    return;
  }
  for (int i = 0; i < 8; ++i)
  {
    differences[i] = KeepSign(differences[i], corners[i], isovalue);
  }
}

/// The trilinear interpolant of the corners v at a point of the cell.
template <typename Number>
SIMD_INLINE Number Interpolate(const Number v[8], const Number p[3])
{
  const Number y0z0 = Lerp(v[0], v[1], p[0]);
  const Number y1z0 = Lerp(v[2], v[3], p[0]);
  const Number y0z1 = Lerp(v[4], v[5], p[0]);
  const Number y1z1 = Lerp(v[6], v[7], p[0]);
  return Lerp(Lerp(y0z0, y1z0, p[1]), Lerp(y0z1, y1z1, p[1]), p[2]);
}

inline double Interpolate(const CellCorners& v, const Vector3& p)
{
  return Interpolate(v.data(), p.data());
}

/// The gradient of the trilinear interpolant, per cell edge along each axis.
template <typename Number>
SIMD_INLINE void FindInterpolantGradient(const Number v[8], const Number p[3], Number gradient[3])
{
  // The ends of the four edges along each axis.
  constexpr int ends[3][4][2] = { { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 } },
    { { 0, 2 }, { 1, 3 }, { 4, 6 }, { 5, 7 } }, { { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } } };
  for (int axis = 0; axis < 3; ++axis)
  {
    Number changes[4];
    for (int i = 0; i < 4; ++i)
    {
      changes[i] = v[ends[axis][i][1]] - v[ends[axis][i][0]];
    }
    const Number s = p[axis == 0 ? 1 : 0];
    const Number t = p[axis == 2 ? 1 : 2];
    gradient[axis] = Lerp(Lerp(changes[0], changes[1], s), Lerp(changes[2], changes[3], s), t);
  }
}

inline Vector3 InterpolantGradient(const CellCorners& v, const Vector3& p)
{
  Vector3 gradient;
  FindInterpolantGradient(v.data(), p.data(), gradient.data());
  return gradient;
}

/// The trilinear interpolant of the corners v along the straight line from p to q, as a cubic of
/// the fraction of the way, by its Bernstein coefficients.
///
/// A trilinear function is its own blossom: with each coordinate taken from p or from q, the values
/// at the eight corners of the box [p, q] give the Bernstein coefficients as means over the corners
/// that take 0, 1, 2 or 3 coordinates from q. These are convex combinations only; the usual
/// coefficients of powers cancel. The ends are Interpolate(p) and Interpolate(q) to the last bit.
/// (L. Ramshaw: Blossoms are polar forms. Computer Aided Geometric Design 6(4), 1989.)
template <typename Number>
SIMD_INLINE void FindCubicAlongSegment(
  const Number v[8], const Number p[3], const Number q[3], Number b[4])
{
  Number x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    x[0][i] = Lerp(v[2 * i], v[2 * i + 1], p[0]);
    x[1][i] = Lerp(v[2 * i], v[2 * i + 1], q[0]);
  }
  // Which coordinates come from q, from x on.
  Number blossom[2][2][2];
  for (int i = 0; i < 2; ++i)
  {
    for (int j = 0; j < 2; ++j)
    {
      const Number y = j == 0 ? p[1] : q[1];
      const Number z0 = Lerp(x[i][0], x[i][1], y);
      const Number z1 = Lerp(x[i][2], x[i][3], y);
      blossom[i][j][0] = Lerp(z0, z1, p[2]);
      blossom[i][j][1] = Lerp(z0, z1, q[2]);
    }
  }
  const Number once = blossom[1][0][0] + blossom[0][1][0] + blossom[0][0][1];
  const Number twice = blossom[1][1][0] + blossom[1][0][1] + blossom[0][1][1];
  const Number third = 1.0 / 3.0;
  b[0] = blossom[0][0][0];
  b[1] = once * third;
  b[2] = twice * third;
  b[3] = blossom[1][1][1];
}

inline BernsteinCubic CubicAlongSegment(const CellCorners& v, const Vector3& p, const Vector3& q)
{
  BernsteinCubic b;
  FindCubicAlongSegment(v.data(), p.data(), q.data(), b.data());
  return b;
}

}

#endif
