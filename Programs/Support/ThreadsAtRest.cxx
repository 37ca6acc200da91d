// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Support/ThreadsAtRest.h"

#ifdef __linux__
#include <cstdlib>

#include <unistd.h> // for execv
#endif

namespace Programs
{

void LetThreadsRest([[maybe_unused]] char* argv[])
{
#ifdef __linux__
  if (!std::getenv("OMP_WAIT_POLICY") && !std::getenv("GOMP_SPINCOUNT"))
  {
    setenv("OMP_WAIT_POLICY", "passive", 1);
    execv("/proc/self/exe", argv); // It returns if it fails: then all goes on as it is.
  }
#endif
}

}
