// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Support/ThreadsAtRest.h"

#ifdef __linux__
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <sys/auxv.h> // for getauxval
#include <unistd.h>   // for execv
#endif

namespace Programs
{

#ifdef __linux__
namespace
{

/// Whether a process is of the program alone: the dynamic loader has a place of its own, and
/// Valgrind has loaded nothing.
bool IsProgramAlone()
{
  const char* preloaded = std::getenv("LD_PRELOAD");
  return getauxval(AT_BASE) != 0 && !(preloaded && std::strstr(preloaded, "vgpreload"));
}

}
#endif

void LetThreadsRest([[maybe_unused]] char* argv[])
{
#ifdef __linux__
  if (!std::getenv("OMP_WAIT_POLICY") && !std::getenv("GOMP_SPINCOUNT") && IsProgramAlone())
  {
    setenv("GOMP_SPINCOUNT", "10000", 1);
    // By its own name, or processes would be listed as "exe".
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    execv(program.c_str(), argv); // It returns if it fails: then all goes on as it is.
  }
#endif
}

}
