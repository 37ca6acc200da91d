// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BuildTimer_h
#define BuildTimer_h

#include <chrono>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Counts the time from its construction to its destruction as one that its thread spends making
/// what rays come to: bricks, members of sets. No two of a thread may overlap.
///
/// Each thread has a sum of its own, since thousands of fields can be asked for theirs no faster
/// than they are traced.
class BuildTimer
{
public:
  BuildTimer() = default;
  ~BuildTimer()
  {
    const auto time = Clock::now() - this->Start;
    Sum() += std::chrono::duration_cast<std::chrono::nanoseconds>(time).count();
  }

  BuildTimer(const BuildTimer&) = delete;
  BuildTimer& operator=(const BuildTimer&) = delete;

  /// The sum over all timers of the calling thread.
  static std::int64_t GetNanosecondsOfThread() { return Sum(); }

private:
  using Clock = std::chrono::steady_clock;

  static std::int64_t& Sum()
  {
    thread_local std::int64_t sum = 0;
    return sum;
  }

  Clock::time_point Start = Clock::now();
};

}

#endif
