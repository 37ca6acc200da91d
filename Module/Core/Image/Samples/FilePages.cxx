// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Samples/FilePages.h"

#ifndef _WIN32
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace vtkIsosurfaceRayTracing
{

#ifndef _WIN32

//------------------------------------------------------------------------------
void ExpectReading(Reading reading, const void* begin, const void* end)
{
  // Normal and not sequential: macrocells read the last rows of those before again.
  const int advice = reading == Reading::Scattered ? POSIX_MADV_RANDOM : POSIX_MADV_NORMAL;
  const auto pageSize = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto inPage = reinterpret_cast<std::uintptr_t>(begin) % pageSize;
  // The system wants a page that may be changed, and does not change it.
  char* page = const_cast<char*>(static_cast<const char*>(begin)) - inPage;
  posix_madvise(page, static_cast<std::size_t>(static_cast<const char*>(end) - page), advice);
}

#else

//------------------------------------------------------------------------------
void ExpectReading(Reading, const void*, const void*) {}

#endif

}
