// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BenchmarkReport_h
#define BenchmarkReport_h

#include "Judgement.h"
#include "Samples.h"

#include <string>
#include <utility>
#include <vector>

namespace Benchmark
{

/// What was measured of a method on an input, or of a painter.
struct Result
{
  std::string Input;
  std::string Family;
  std::string Knob;
  Judgement Judged;
  /// Of a method, on one thread.
  Samples NanosecondsPerRay;
  /// 0 where a method does not solve cells.
  double NanosecondsPerCell = 0.0;
  /// Of a painter, on all threads: up to the finished frame in the window, and of it, finding what
  /// the rays hit. Empty where it is not known.
  Samples FrameMilliseconds;
  Samples TraceMilliseconds;
};

/// Results of rays and of pictures, input by input in the same order.
struct Results
{
  std::vector<Result> Rays;
  std::vector<Result> Pictures;
};

/// Writes results.md, results.csv, results.json and, where there is a display, for each input plots
/// as PNG: speed against error and against misjudged rays, of rays and of whole frames, and how
/// many rays have which error. Returns the names of the files.
std::vector<std::string> WriteReport(const Results& results,
  const std::vector<std::pair<std::string, std::string>>& circumstances, const std::string& folder);

/// A part of the picture of errors: GetError of each pixel, in rows from the bottom.
struct HeatPanel
{
  std::string Title;
  std::vector<double> Errors;
};

/// Writes squares of pixels whose colours are errors, with a legend. Needs a display.
void WriteHeatMap(const std::vector<HeatPanel>& panels, int pixels, const std::string& fileName);

/// The name of an input as a part of the names of files.
std::string GetFileName(std::string name);

}

#endif
