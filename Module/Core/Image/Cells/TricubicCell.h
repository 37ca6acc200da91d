// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicCell_h
#define TricubicCell_h

#include "Image/Samples/UnevenPlanes.h"
#include "Math/NonicRoots.h"
#include "Math/TrilinearCell.h"
#include "Math/Vector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

// Interpolant::Tricubic: along each axis the cubic that meets the samples at both ends of a cell,
// with the slopes of a parabola through each sample and its neighbours (where spacing is even,
// their central difference), so that it goes on smoothly in the next cell. With even spacing this
// is E. Catmull, R. Rom: A class of local interpolating splines (Computer Aided Geometric Design,
// 1974), the cubic of vtkImageInterpolator. At the border of the volume the slope is that of the
// straight line to the next sample, as if samples continued in it.

namespace vtkIsosurfaceRayTracing
{

/// What the rises to the samples at both ends of a cell along an axis, and between them, are
/// multiplied by to make a third of the slopes there, per width of the cell.
struct CubicEdge
{
  /// At the lower end: the rise before the cell and that in it.
  double LowerBefore;
  double LowerWithin;
  /// At the upper end: the rise in the cell and that behind it.
  double UpperWithin;
  double UpperBehind;

  bool operator==(const CubicEdge& other) const
  {
    return this->LowerBefore == other.LowerBefore && this->LowerWithin == other.LowerWithin &&
      this->UpperWithin == other.UpperWithin && this->UpperBehind == other.UpperBehind;
  }
};

/// The edges of the cells of a volume, for each axis.
class CubicEdges
{
public:
  CubicEdges() = default;

  /// The planes are null where samples stand at whole numbers.
  CubicEdges(const Index3& dimensions, const UnevenPlanes* planes)
  {
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = dimensions[axis] - 1;
      double largest = 1.0;
      for (int cell = 0; cell < last; ++cell)
      {
        const CubicEdge edge =
          planes ? UnevenEdge(*planes, axis, cell) : EvenEdge(cell > 0, cell + 1 < last);
        largest = std::max({ largest, SumOfWeights(edge.LowerBefore, edge.LowerWithin),
          SumOfWeights(edge.UpperBehind, edge.UpperWithin) });
        this->Edges[axis].push_back(edge);
      }
      product *= largest;
    }
    // A little more than can be, for rounding.
    this->Overshoot = 0.5 * (product - 1.0) + 1e-9;
  }

  const CubicEdge& Get(std::size_t axis, int cell) const
  {
    return this->Edges[axis][static_cast<std::size_t>(cell)];
  }

  /// How far coefficients of a cell may lie outside the range of the 4^3 samples around it, in
  /// lengths of that range: with weights that add up to 1, and their sizes to 1 + 2 k, it is k.
  /// (With even spacing, each axis has a factor of 4/3, and k is 37/54.)
  double GetOvershoot() const { return this->Overshoot; }

  bool operator==(const CubicEdges& other) const { return this->Edges == other.Edges; }

private:
  static CubicEdge EvenEdge(bool hasBefore, bool hasBehind)
  {
    constexpr double third = 1.0 / 3.0;
    constexpr double sixth = 1.0 / 6.0;
    return { hasBefore ? sixth : 0.0, hasBefore ? sixth : third, hasBehind ? sixth : third,
      hasBehind ? sixth : 0.0 };
  }

  static CubicEdge UnevenEdge(const UnevenPlanes& planes, std::size_t axis, int cell)
  {
    const double third = planes.GetWidth(axis, cell) / 3.0;
    if (!(third > 0.0))
    {
      return EvenEdge(false, false);
    }
    const UnevenPlanes::SlopeWeights& lower = planes.GetSlopeWeights(axis, cell);
    const UnevenPlanes::SlopeWeights& upper = planes.GetSlopeWeights(axis, cell + 1);
    return { third * lower.Below, third * lower.Above, third * upper.Below, third * upper.Above };
  }

  /// The sizes of what three samples are multiplied by to make the coefficient next to an end.
  static double SumOfWeights(double outer, double within)
  {
    return outer + std::abs(1.0 + outer - within) + within;
  }

  std::array<std::vector<CubicEdge>, 3> Edges;
  double Overshoot = 0.0;
};

/// The interpolant of a cell by its Bernstein coefficients, (i, j, k) in {0, ..., 3}^3 at i + 4 j +
/// 16 k. It stays between the smallest and the largest. On a face of the cell it is made of the
/// samples in the plane of the face and of the 16 coefficients there alone: two cells have the
/// same, to the last bit.
using TricubicCell = std::array<double, 64>;

/// Calls visit(first) for the first of the four coefficients of each line along an axis.
template <int Axis, typename Visit>
void ForEachLine(const Visit& visit)
{
  for (std::size_t line = 0; line < 16; ++line)
  {
    visit(Axis == 0 ? 4 * line : (Axis == 1 ? line % 4 + 16 * (line / 4) : line));
  }
}

/// Makes coefficients of samples, along one axis.
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

/// Makes the coefficients of a cell of the 4^3 samples around it, in the same order.
inline void InterpolateSamples(const CubicEdges& edges, const Index3& cell, TricubicCell& samples)
{
  InterpolateAlong<0>(edges.Get(0, cell[0]), samples);
  InterpolateAlong<1>(edges.Get(1, cell[1]), samples);
  InterpolateAlong<2>(edges.Get(2, cell[2]), samples);
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

/// The interpolant along the straight line from p to q, as a polynomial of the fraction of the way:
/// that along the diagonal of the box [p, q]. As for CubicAlongSegment, there are convex
/// combinations only, so that coefficients of one sign make a polynomial of that sign, rounded as
/// it is.
inline BernsteinNonic NonicAlongSegment(TricubicCell cell, const Vector3& p, const Vector3& q)
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

/// The gradient of the interpolant at a point of the cell, per cell edge along each axis.
inline Vector3 TricubicGradient(const TricubicCell& cell, const Vector3& p)
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

#endif
