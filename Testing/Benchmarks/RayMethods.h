// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayMethods_h
#define RayMethods_h

#include "BenchmarkInputs.h"
#include "IsosurfaceRenderer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Benchmark
{

/// A way to find where lines meet the surface first.
struct RayMethod
{
  /// Methods of a family differ by a parameter, and are a curve in the plots.
  std::string Family;
  std::string Parameter;
  /// The t of every line, NaN where it meets nothing. On one thread.
  std::function<void(const std::vector<Oracle::Line>&, std::vector<double>&)> Cast;
  /// Nanoseconds to solve one cell of a ray that may hit it, the cell being at hand; NotMeasured
  /// where a method does not solve cells.
  std::function<double()> MeasureCell = []() { return NotMeasured; };
};

/// The parameter of methods that sample at a distance, in cells.
std::string FormatDistance(double distance);

/// All methods, made ready for an input: hierarchies are built and triangles extracted. The input
/// must outlive them.
std::vector<RayMethod> MakeRayMethods(const Input& input, const std::vector<Oracle::Line>& lines);

}

#endif
