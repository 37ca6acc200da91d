// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PowerCubic_h
#define PowerCubic_h

#include "Image/Cells/CellSegment.h"
#include "Math/TrilinearCell.h"

namespace vtkIsosurfaceRayTracing
{

/// c[0] + c[1] u + c[2] u^2 + c[3] u^3
using PowerCubic = std::array<double, 4>;

/// The interpolant along a segment of a cell, by the sums over the corners of Parker et al. 1998,
/// appendix A, about the point where the ray enters the cell (about the origin of a distant ray the
/// sums lose every digit).
inline PowerCubic PowerCubicAlongSegment(const CellCorners& difference, const CellSegment& segment)
{
  PowerCubic sum = { 0.0, 0.0, 0.0, 0.0 };
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    // The weight of a corner is a product of three linear functions of u.
    double weight[3];
    double slope[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool upper = (corner >> axis & 1) != 0;
      const double direction = segment.Exit[axis] - segment.Entry[axis];
      weight[axis] = upper ? segment.Entry[axis] : 1.0 - segment.Entry[axis];
      slope[axis] = upper ? direction : -direction;
    }
    const double value = difference[corner];
    sum[0] += weight[0] * weight[1] * weight[2] * value;
    sum[1] += (slope[0] * weight[1] * weight[2] + weight[0] * slope[1] * weight[2] +
                weight[0] * weight[1] * slope[2]) *
      value;
    sum[2] += (weight[0] * slope[1] * slope[2] + slope[0] * weight[1] * slope[2] +
                slope[0] * slope[1] * weight[2]) *
      value;
    sum[3] += slope[0] * slope[1] * slope[2] * value;
  }
  return sum;
}

inline double Evaluate(const PowerCubic& c, double u)
{
  return ((c[3] * u + c[2]) * u + c[1]) * u + c[0];
}

inline double EvaluateDerivative(const PowerCubic& c, double u)
{
  return (3.0 * c[3] * u + 2.0 * c[2]) * u + c[1];
}

}

#endif
