// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "FileState.h"

#include <chrono>

#ifndef _WIN32
#include <sys/stat.h>
#endif

namespace ImageFiles
{
namespace
{

constexpr std::int64_t NanosecondsPerSecond = 1000000000;

}

//------------------------------------------------------------------------------
bool FileState::IsSettled() const
{
  constexpr std::int64_t longestStep = 2 * NanosecondsPerSecond;
  const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
  return this->Modified < now.count() - longestStep && this->Changed < now.count() - longestStep;
}

#ifndef _WIN32

namespace
{

std::int64_t ToNanoseconds(const timespec& time)
{
  return std::int64_t{ time.tv_sec } * NanosecondsPerSecond + time.tv_nsec;
}

std::optional<FileState> StateOf(const struct stat& status)
{
  if (!S_ISREG(status.st_mode))
  {
    return std::nullopt;
  }
#ifdef __APPLE__
  const timespec& modified = status.st_mtimespec;
  const timespec& changed = status.st_ctimespec;
#else
  const timespec& modified = status.st_mtim;
  const timespec& changed = status.st_ctim;
#endif
  return FileState{ status.st_size, static_cast<std::int64_t>(status.st_ino),
    ToNanoseconds(modified), ToNanoseconds(changed) };
}

}

//------------------------------------------------------------------------------
std::optional<FileState> FindFileState(const std::string& fileName)
{
  struct stat status = {};
  return stat(fileName.c_str(), &status) == 0 ? StateOf(status) : std::nullopt;
}

//------------------------------------------------------------------------------
std::optional<FileState> FindFileState(int descriptor)
{
  struct stat status = {};
  return fstat(descriptor, &status) == 0 ? StateOf(status) : std::nullopt;
}

#else

//------------------------------------------------------------------------------
std::optional<FileState> FindFileState(const std::string&)
{
  return std::nullopt;
}

//------------------------------------------------------------------------------
std::optional<FileState> FindFileState(int)
{
  return std::nullopt;
}

#endif

}
