// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How many threads a mapper uses.

#ifndef vtkIsosurfaceRayTraceThreads_h
#define vtkIsosurfaceRayTraceThreads_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <omp.h>

#include <algorithm>

#ifndef _WIN32
#include <unistd.h> // for getpid
#endif

VTK_ABI_NAMESPACE_BEGIN

struct vtkIsosurfaceRayTraceThreads
{
  /// As many as are set; those of OpenMP if that is 0; and one in a process that was forked from
  /// one that had asked this before, as by multiprocessing of Python: GNU's OpenMP waits there
  /// forever for the threads that the other one had.
  static int Find(int set)
  {
    static const long first = GetProcess();
    if (GetProcess() != first)
    {
      return 1;
    }
    return set > 0 ? set : std::max(1, omp_get_max_threads());
  }

private:
  static long GetProcess()
  {
#ifdef _WIN32
    return 0; // where there are no forks
#else
    return getpid();
#endif
  }
};

VTK_ABI_NAMESPACE_END

#endif
