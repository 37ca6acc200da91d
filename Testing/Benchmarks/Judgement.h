// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Judgement_h
#define Judgement_h

#include "BenchmarkInputs.h"

#include <limits>
#include <vector>

namespace Benchmark
{

/// What is found of a ray is the t of its first hit, NaN where there is none, and this where the
/// surface is seen but not where.
constexpr double SomewhereOnRay = std::numeric_limits<double>::infinity();

/// The t of the first hit of every line, NaN where there is none, by the oracle: every cell, 113
/// bits.
std::vector<double> FindTruth(const Input& input, const std::vector<Oracle::Line>& lines);

/// The distance of what was found from the truth. NaN where nothing is and nothing was found,
/// infinite where misjudged, -1 where the surface is seen but not where.
double GetError(double found, double truth);

/// What was found, beside the truth.
struct Judgement
{
  int Rays = 0;
  int Hits = 0;
  /// Rays that meet the surface, of which the method does not know; and the other way round.
  int Missed = 0;
  int Invented = 0;
  /// Rays whose hit is more than a twentieth of a cell off: another sheet, or another root.
  int Wrong = 0;
  /// The distance along the ray to the exact hit, in cells, over the rays hit by both, in ascending
  /// order. Empty where places are not known.
  std::vector<double> Errors;

  /// What so large a share of the errors does not exceed; NaN where there are none.
  double GetError(double share) const;
};

Judgement Judge(const std::vector<double>& found, const std::vector<double>& truth);

/// The cosine of the angle between a direction and the normal at the hit of a line, as central
/// differences, interpolated, give it: between 0 and 1.
double GetShade(
  const Input& input, const Oracle::Line& line, double hit, const Oracle::Triple& direction);

/// The number at so large a share of numbers in ascending order; NaN where there are none.
double GetQuantile(const std::vector<double>& ascending, double share);

}

#endif
