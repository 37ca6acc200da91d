// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicCell_h
#define TricubicCell_h

#include "Image/Lattice/UnevenPlanes.h"
#include "Math/Arithmetic.h"
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

/// The weights of the differences to the samples at both ends of a cell along an axis, and between
/// them, in a third of the slopes there, per width of the cell: at the lower end that of the
/// difference before the cell and of that in it; at the upper end that of the difference in the
/// cell and of that behind it.
using CubicEdge = std::array<double, 4>;

/// The edges of the cells of a volume, for each axis.
class CubicEdges
{
public:
  CubicEdges() = default;

  /// For cells that have a number of samples before the first, along each axis. The planes are null
  /// where samples stand at whole numbers.
  CubicEdges(const Index3& dimensions, int before, const UnevenPlanes* planes)
  {
    double product = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = dimensions[axis] - 1;
      double largest = 1.0;
      for (int cell = 0; cell < last; ++cell)
      {
        const CubicEdge edge =
          planes ? UnevenEdge(*planes, axis, cell) : EvenEdge(cell + before > 0, cell + 1 < last);
        largest =
          std::max({ largest, SumOfWeights(edge[0], edge[1]), SumOfWeights(edge[3], edge[2]) });
        this->Edges[axis].push_back(edge);
      }
      product *= largest;
    }
    // A little more than exact, for rounding.
    this->Overshoot = 0.5 * (product - 1.0) + 1e-9;
  }

  /// Those of a cell, as kernels take them.
  const double* Get(std::size_t axis, int cell) const
  {
    return this->Edges[axis][static_cast<std::size_t>(cell)].data();
  }
  std::array<const double*, 3> Get(const Index3& cell) const
  {
    return { this->Get(0, cell[0]), this->Get(1, cell[1]), this->Get(2, cell[2]) };
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

/// The value at a point of a cell: exactly the one with which polynomials along rays begin or end
/// there (see Kernels).
inline double GetTricubicValue(const TricubicCell& cell, const Vector3& p)
{
  TricubicCell values = cell;
  std::size_t count = 64;
  for (const double t : p)
  {
    count /= 4;
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* c = &values[4 * i];
      const double middle = Lerp(c[1], c[2], t);
      values[i] =
        Lerp(Lerp(Lerp(c[0], c[1], t), middle, t), Lerp(middle, Lerp(c[2], c[3], t), t), t);
    }
  }
  return values[0];
}

}

#endif
