// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FilePrefetch.h"

#ifndef _WIN32
#include <fcntl.h>
#include <unistd.h>
#endif

namespace ImageFiles
{

#ifdef POSIX_FADV_WILLNEED

namespace
{

bool FitsBesideOthers(std::int64_t size)
{
  const std::int64_t memory = std::int64_t{ sysconf(_SC_PHYS_PAGES) } * sysconf(_SC_PAGESIZE);
  return size <= memory / 4;
}

/// Linux reads no more for one request than it reads ahead, which is this by default.
void Ask(const std::string& fileName, std::int64_t offset, std::int64_t size)
{
  constexpr std::int64_t piece = std::int64_t{ 128 } << 10;
  const int file = open(fileName.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0)
  {
    return;
  }
  for (std::int64_t done = 0; done < size; done += piece)
  {
    posix_fadvise(file, offset + done, piece, POSIX_FADV_WILLNEED);
  }
  close(file);
}

}

//------------------------------------------------------------------------------
void FilePrefetch::Start(const std::string& fileName, std::int64_t offset, std::int64_t size)
{
  if (FitsBesideOthers(size))
  {
    this->Asking = std::async(std::launch::async, Ask, fileName, offset, size);
  }
}

#else

//------------------------------------------------------------------------------
void FilePrefetch::Start(const std::string&, std::int64_t, std::int64_t) {}

#endif

}
