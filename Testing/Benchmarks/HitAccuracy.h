// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HitAccuracy_h
#define HitAccuracy_h

#include "BenchmarkInputs.h"

#include <vector>

namespace Benchmark
{

/// The exact t of the first hit of every line, NaN where there is none: the oracle searches every
/// cell in 113 bits.
std::vector<double> FindReference(const Input& input, const std::vector<Oracle::Line>& lines);

/// The error of a hit at an unknown distance.
constexpr double UnknownError = -1.0;

/// The distance between a hit and its reference, in cells. NaN where both are none, infinite where
/// one of them is.
double GetError(double found, double reference);

/// How the hits of a method compare with the reference.
struct HitAccuracy
{
  int Rays = 0;
  int Hits = 0;
  /// Rays that hit the surface without the method's finding it, and the other way round.
  int Missed = 0;
  int Invented = 0;
  /// Rays whose hit is more than a twentieth of a cell off: beside the surface, or on another
  /// sheet.
  int Displaced = 0;
  /// The distance along the ray to the exact hit, in cells, over the rays hit by both, in ascending
  /// order. Empty where positions are not known.
  std::vector<double> Errors;

  /// What so large a share of the errors does not exceed; NaN where there are none.
  double GetError(double share) const;
};

HitAccuracy MeasureAccuracy(const std::vector<double>& found, const std::vector<double>& reference);

}

#endif
