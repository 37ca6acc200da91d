// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ThreadsOfLoop_h
#define ThreadsOfLoop_h

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Whether a loop is worth all threads, or one, given the number of its turns and about how many
/// nanoseconds each takes: to wake threads that sleep takes 0.1 ms. (With some of the threads GNU's
/// OpenMP ends the others, and creates them again for the next loop.)
inline int GetThreadsOfLoop(std::size_t turns, double nanoseconds, int threads)
{
  constexpr double least = 1e5;
  return static_cast<double>(turns) * nanoseconds < least ? 1 : threads;
}

}

#endif
