// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Samples/FilePages.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#ifndef _WIN32
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace vtkIsosurfaceRayTracing
{

#ifndef _WIN32

namespace
{

void Advise(const void* begin, const void* end, int advice)
{
  const auto pageSize = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto inPage = reinterpret_cast<std::uintptr_t>(begin) % pageSize;
  // The system wants a page that may be changed, and does not change it.
  char* page = const_cast<char*>(static_cast<const char*>(begin)) - inPage;
  posix_madvise(page, static_cast<std::size_t>(static_cast<const char*>(end) - page), advice);
}

}

//------------------------------------------------------------------------------
void ExpectReading(Reading reading, const void* begin, const void* end)
{
  // Normal and not sequential: macrocells read the last rows of those before again.
  Advise(begin, end, reading == Reading::Scattered ? POSIX_MADV_RANDOM : POSIX_MADV_NORMAL);
}

//------------------------------------------------------------------------------
void PagesAhead::Add(const void* begin, const void* end)
{
  // Disks read it in less time than they take to go to another place.
  constexpr std::ptrdiff_t gap = std::ptrdiff_t{ 16 } << 10;
  const char* first = static_cast<const char*>(begin);
  if (!this->Begin || first - this->End > gap)
  {
    this->Ask();
    this->Begin = first;
  }
  this->End = static_cast<const char*>(end);
}

//------------------------------------------------------------------------------
void PagesAhead::Ask()
{
  // Linux reads no more for one request than it reads ahead, which is this by default.
  constexpr std::ptrdiff_t piece = std::ptrdiff_t{ 128 } << 10;
  while (this->Begin != this->End)
  {
    const char* end = this->Begin + std::min(piece, this->End - this->Begin);
    Advise(this->Begin, end, POSIX_MADV_WILLNEED);
    this->Begin = end;
  }
}

#else

//------------------------------------------------------------------------------
void PagesAhead::Add(const void*, const void*) {}

//------------------------------------------------------------------------------
void PagesAhead::Ask() {}

//------------------------------------------------------------------------------
void ExpectReading(Reading, const void*, const void*) {}

#endif

}
