// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Stopwatch_h
#define Stopwatch_h

#include <chrono>

namespace vtkIsosurfaceRayTracing
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

}

#endif
