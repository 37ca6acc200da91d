// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/TricubicCell.h"

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Calls visit(first) for the first of the four coefficients of each line along an axis.
template <int Axis, typename Visit>
void ForEachLine(const Visit& visit)
{
  for (std::size_t line = 0; line < 16; ++line)
  {
    visit(Axis == 0 ? 4 * line : (Axis == 1 ? line % 4 + 16 * (line / 4) : line));
  }
}

/// Makes coefficients from samples, along one axis.
template <int Axis>
void InterpolateAlong(const CubicEdge& edge, TricubicCell& c)
{
  constexpr std::size_t next = std::size_t{ 1 } << (2 * Axis);
  ForEachLine<Axis>(
    [&edge, &c](std::size_t i)
    {
      const double before = c[i + next] - c[i];
      const double within = c[i + 2 * next] - c[i + next];
      const double behind = c[i + 3 * next] - c[i + 2 * next];
      const double lower = c[i + next];
      const double upper = c[i + 2 * next];
      c[i] = lower;
      c[i + next] = lower + (edge.LowerBefore * before + edge.LowerWithin * within);
      c[i + 2 * next] = upper - (edge.UpperWithin * within + edge.UpperBehind * behind);
      c[i + 3 * next] = upper;
    });
}

/// The same interpolant on the part [p, q] of the cell along one axis: the values of the blossom of
/// each cubic where p is taken three times, twice, once and not at all. If it falls, it is turned
/// around.
template <int Axis>
void RestrictAlong(double p, double q, TricubicCell& c)
{
  constexpr std::size_t next = std::size_t{ 1 } << (2 * Axis);
  ForEachLine<Axis>(
    [p, q, &c](std::size_t i)
    {
      double once[2][3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        once[0][k] = Lerp(c[i + k * next], c[i + (k + 1) * next], p);
        once[1][k] = Lerp(c[i + k * next], c[i + (k + 1) * next], q);
      }
      const double pp[2] = { Lerp(once[0][0], once[0][1], p), Lerp(once[0][1], once[0][2], p) };
      const double pq[2] = { Lerp(once[0][0], once[0][1], q), Lerp(once[0][1], once[0][2], q) };
      const double qq[2] = { Lerp(once[1][0], once[1][1], q), Lerp(once[1][1], once[1][2], q) };
      c[i] = Lerp(pp[0], pp[1], p);
      c[i + next] = Lerp(pp[0], pp[1], q);
      c[i + 2 * next] = Lerp(pq[0], pq[1], q);
      c[i + 3 * next] = Lerp(qq[0], qq[1], q);
    });
}

}

//------------------------------------------------------------------------------
void InterpolateSamples(const CubicEdges& edges, const Index3& cell, TricubicCell& samples)
{
  InterpolateAlong<0>(edges.Get(0, cell[0]), samples);
  InterpolateAlong<1>(edges.Get(1, cell[1]), samples);
  InterpolateAlong<2>(edges.Get(2, cell[2]), samples);
}

//------------------------------------------------------------------------------
BernsteinNonic NonicAlongSegment(TricubicCell cell, const Vector3& p, const Vector3& q)
{
  RestrictAlong<2>(p[2], q[2], cell);
  RestrictAlong<1>(p[1], q[1], cell);
  RestrictAlong<0>(p[0], q[0], cell);
  constexpr double binomial3[4] = { 1.0, 3.0, 3.0, 1.0 };
  constexpr double binomial9[10] = { 1.0, 9.0, 36.0, 84.0, 126.0, 126.0, 84.0, 36.0, 9.0, 1.0 };
  BernsteinNonic nonic = {};
  for (std::size_t i = 0; i < 64; ++i)
  {
    const std::size_t x = i % 4;
    const std::size_t y = i / 4 % 4;
    const std::size_t z = i / 16;
    nonic[x + y + z] += binomial3[x] * binomial3[y] * binomial3[z] * cell[i];
  }
  for (std::size_t i = 0; i < 10; ++i)
  {
    nonic[i] /= binomial9[i];
  }
  return nonic;
}

//------------------------------------------------------------------------------
Vector3 TricubicGradient(const TricubicCell& cell, const Vector3& p)
{
  Vector3 gradient;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // One axis after the other, each by its weights at the point.
    TricubicCell values = cell;
    std::size_t count = 64;
    for (const std::size_t along : { std::size_t{ 2 }, std::size_t{ 1 }, std::size_t{ 0 } })
    {
      const double t = p[along];
      const double s = 1.0 - t;
      const std::array<double, 4> weights = along == axis
        ? std::array<double, 4>{ -3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t),
            3.0 * t * t }
        : std::array<double, 4>{ s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t };
      count /= 4;
      for (std::size_t i = 0; i < count; ++i)
      {
        values[i] = weights[0] * values[i] + weights[1] * values[i + count] +
          weights[2] * values[i + 2 * count] + weights[3] * values[i + 3 * count];
      }
    }
    gradient[axis] = values[0];
  }
  return gradient;
}

}
