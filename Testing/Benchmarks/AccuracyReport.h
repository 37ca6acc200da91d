// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AccuracyReport_h
#define AccuracyReport_h

#include "HitAccuracy.h"
#include "Json.h"

#include <string>
#include <vector>

namespace Benchmark
{

/// What was measured of a method on an input.
struct Result
{
  std::string Family;
  std::string Parameter;
  HitAccuracy Accuracy;
  /// Of rays, on one thread.
  Samples NanosecondsPerRay;
  /// NotMeasured where a method does not solve cells.
  double NanosecondsPerCell;
  /// Of pictures, on all threads: up to the finished frame in the window, and of it, finding what
  /// the rays hit. Empty where it is not known.
  Samples FrameMilliseconds;
  Samples TraceMilliseconds;
};

Json::Value ToJson(const Result& result);

/// The errors of a method in a picture: GetError of each pixel, in rows from the bottom.
struct PictureErrors
{
  std::string Title;
  std::vector<double> Errors;
};

/// Writes a .vti file of pixels x pixels with an array for each of the methods.
void WriteErrorImage(
  const std::vector<PictureErrors>& pictures, int pixels, const std::string& fileName);

}

#endif
