// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BrickCounters_h
#define BrickCounters_h

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Counters of a store of bricks, shared by all threads.
struct BrickCounters
{
  /// The sum over all threads of the time spent making bricks.
  std::atomic<std::int64_t> Nanoseconds{ 0 };
};

/// Counts the time from its construction to its destruction.
class BrickTimer
{
public:
  explicit BrickTimer(BrickCounters& counters)
    : Counters(counters)
    , Start(std::chrono::steady_clock::now())
  {
  }

  ~BrickTimer()
  {
    const auto time = std::chrono::steady_clock::now() - this->Start;
    this->Counters.Nanoseconds.fetch_add(
      std::chrono::duration_cast<std::chrono::nanoseconds>(time).count(),
      std::memory_order_relaxed);
  }

  BrickTimer(const BrickTimer&) = delete;
  BrickTimer& operator=(const BrickTimer&) = delete;

private:
  BrickCounters& Counters;
  std::chrono::steady_clock::time_point Start;
};

}

#endif
