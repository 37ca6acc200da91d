// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What it takes: time and memory.

#ifndef vtkIsosurfaceComparisonTime_h
#define vtkIsosurfaceComparisonTime_h

#include <chrono>
#include <vector>

namespace vtkIsosurfaceComparison
{

/// Seconds of wall-clock time since it was made.
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

/// NaN of no values.
double Median(std::vector<double> values);

/// How far the memory of the process that is in RAM rises above what it was when this was made.
class MemoryPeak
{
public:
  MemoryPeak();

  /// Bytes; NaN where the system does not tell (it is Linux that does).
  double GetBytes() const;

private:
  double Before;
};

}

#endif
