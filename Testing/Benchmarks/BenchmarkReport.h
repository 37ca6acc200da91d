// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BenchmarkReport_h
#define BenchmarkReport_h

#include <string>
#include <vector>

namespace Benchmark
{

/// What a method did on an input.
struct Result
{
  std::string Input;
  std::string Family;
  std::string Knob;
  int Rays;
  int Hits;
  /// Rays that meet the surface, of which the method does not know; and the other way round.
  int Missed;
  int Invented;
  /// Rays whose hit is more than a twentieth of a cell off: another sheet, or another root.
  int Wrong;
  /// The distance along the ray to the exact hit, in cells, over the rays hit by both, in ascending
  /// order.
  std::vector<double> Errors;
  /// The median, and the fastest and slowest of the repeats.
  double NanosecondsPerRay;
  double Fastest;
  double Slowest;
  double NanosecondsPerCell;

  double GetError(double share) const;
};

/// Writes results.md, results.csv, results.json and, for each input, plots as PNG: speed against
/// error, speed against misjudged rays, and how many rays have which error. Returns the names of
/// the files.
std::vector<std::string> WriteReport(
  const std::vector<Result>& results, const std::string& machine, const std::string& folder);

/// Writes the errors of the pixels of a picture as colours, one square for each method, from 1e-16
/// (black) to 1 cell (white); rays misjudged are red.
void WriteHeatMap(
  const std::vector<std::vector<double>>& errors, int pixels, const std::string& fileName);

}

#endif
