// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FilePrefetch.h"

#include <utility>

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
FilePrefetch::~FilePrefetch()
{
  this->LeaveParent();
}

//------------------------------------------------------------------------------
/// A process that was forked has no thread of its parent to wait for: what would wait is never
/// destroyed.
void FilePrefetch::LeaveParent()
{
  if (this->Asking.valid() && this->Process != getpid())
  {
    new std::future<void>(std::move(this->Asking));
  }
}

//------------------------------------------------------------------------------
void FilePrefetch::Start(const std::string& fileName, std::int64_t offset, std::int64_t size)
{
  this->LeaveParent();
  if (FitsBesideOthers(size))
  {
    this->Process = getpid();
    this->Asking = std::async(std::launch::async, Ask, fileName, offset, size);
  }
}

#else

//------------------------------------------------------------------------------
FilePrefetch::~FilePrefetch() = default;

//------------------------------------------------------------------------------
void FilePrefetch::Start(const std::string&, std::int64_t, std::int64_t) {}

#endif

}
