// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/LargestValue.h"

#include "Image/Cells/Solvers/RobustSolver.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The largest value of a cubic on [0, 1]: at one end, or where it turns; the first of equal
/// values. It never exceeds all coefficients.
SegmentValue FindLargest(const BernsteinCubic& cubic)
{
  TurningPoints<double> turns;
  turns.Find(Robust::Normalize(cubic).data());
  SegmentValue best = { 0.0, cubic[0] };
  const auto include = [&best](double fraction, double value)
  {
    if (value > best.Value)
    {
      best = { fraction, value };
    }
  };
  // Rounding may bring an interpolated value above those that it is made of.
  const double largest = *std::max_element(cubic.begin(), cubic.end());
  for (int i = 0; i < 2; ++i)
  {
    if (turns.Exists[i])
    {
      include(turns.At[i], std::min(largest, Robust::Evaluate(cubic, turns.At[i])));
    }
  }
  include(1.0, cubic[3]);
  return best;
}

}

//------------------------------------------------------------------------------
SegmentValue FindLargest(CellCorners corners, double largest, const CellSegment& segment)
{
  // Sums of three values must not overflow.
  const bool isHuge = std::any_of(
    corners.begin(), corners.end(), [](double value) { return std::abs(value) > 0x1p1000; });
  const double scale = isHuge ? 0x1p-4 : 1.0;
  for (double& value : corners)
  {
    value *= scale;
  }
  SegmentValue best = FindLargest(CubicAlongSegment(corners, segment.Entry, segment.Exit));
  best.Value = std::min(largest, best.Value / scale);
  return best;
}

}
