// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TileSchedule_h
#define TileSchedule_h

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <vector>

namespace Benchmark
{

/// The efficiency of so many threads that take tiles of known cost in order, each the next one as
/// soon as it is done with its last: the work divided by what the threads could have done
/// meanwhile.
inline double GetEfficiency(const std::vector<double>& costs, int threads)
{
  // When the threads are free again, the earliest on top.
  std::priority_queue<double, std::vector<double>, std::greater<double>> free;
  for (int i = 0; i < threads; ++i)
  {
    free.push(0.0);
  }
  double end = 0.0;
  for (const double cost : costs)
  {
    const double done = free.top() + cost;
    free.pop();
    free.push(done);
    end = std::max(end, done);
  }
  return std::accumulate(costs.begin(), costs.end(), 0.0) / (threads * end);
}

}

#endif
