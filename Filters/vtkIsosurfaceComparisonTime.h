// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Measures time and memory.

#ifndef vtkIsosurfaceComparisonTime_h
#define vtkIsosurfaceComparisonTime_h

#include <chrono>
#include <vector>

namespace vtkIsosurfaceComparison
{

/// The wall-clock time since its construction.
class Stopwatch
{
public:
  double GetSeconds() const
  {
    return std::chrono::duration<double>(Clock::now() - this->Start).count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

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
