// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FilePrefetch_h
#define FilePrefetch_h

#include <cstdint>
#include <future>
#include <string>

namespace ImageFiles
{

/// Has the system read bytes of a file that will be looked at soon, one file after the other, in a
/// thread of its own: to ask for them takes milliseconds for each 10 MB.
class FilePrefetch
{
public:
  FilePrefetch() = default;
  ~FilePrefetch();
  FilePrefetch(const FilePrefetch&) = delete;
  void operator=(const FilePrefetch&) = delete;

  /// Does nothing if there is no such file, or if the bytes are so many that they would drive out
  /// of memory what is looked at now.
  void Start(const std::string& fileName, std::int64_t offset, std::int64_t size);

private:
  void LeaveParent();

  /// When it is replaced or destroyed, the one before has ended.
  std::future<void> Asking;
  /// That it is a thread of.
  std::int64_t Process = 0;
};

}

#endif
