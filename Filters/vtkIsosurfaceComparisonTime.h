// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Measures time and memory.

#ifndef vtkIsosurfaceComparisonTime_h
#define vtkIsosurfaceComparisonTime_h

#include "Field/Stopwatch.h"

#include <vector>

namespace vtkIsosurfaceComparison
{

using vtkIsosurfaceRayTracing::Stopwatch;

/// NaN if there are no values.
double Median(std::vector<double> values);

/// The peak growth of the resident memory of the process since construction.
class MemoryPeak
{
public:
  MemoryPeak();

  /// In bytes; NaN on systems other than Linux.
  double GetBytes() const;

private:
  double Before;
};

}

#endif
