// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ThreadsOfLoop_h
#define ThreadsOfLoop_h

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// How many threads of those that there are a loop is worth, given the number of its turns and
/// about how many nanoseconds each takes. To wake a thread that sleeps takes up to 0.1 ms.
inline int GetThreadsOfLoop(std::size_t turns, double nanoseconds, int threads)
{
  constexpr double leastOfThread = 5e4;
  const double worth = static_cast<double>(turns) * nanoseconds / leastOfThread;
  return worth < static_cast<double>(threads) ? std::max(1, static_cast<int>(worth)) : threads;
}

}

#endif
