// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HitAccuracy_h
#define HitAccuracy_h

#include "BenchmarkInputs.h"

#include <vector>

namespace Benchmark
{

/// The t of the first hit of every line, NaN where there is none, by the oracle: every cell, 113
/// bits.
std::vector<double> FindReference(const Input& input, const std::vector<Oracle::Line>& lines);

/// The error of a hit of which it is known that it is there, but not where.
constexpr double UnknownError = -1.0;

/// How far what was found is from the reference, in cells. NaN where there is nothing and nothing
/// was found, infinite where one of both is nothing.
double GetError(double found, double reference);

/// What was found, beside the reference.
struct HitAccuracy
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

HitAccuracy MeasureAccuracy(const std::vector<double>& found, const std::vector<double>& reference);

}

#endif
