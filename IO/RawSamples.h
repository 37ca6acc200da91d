// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RawSamples_h
#define RawSamples_h

#include <cstdint>
#include <string>

namespace ImageFiles
{

/// Where a file has its samples one after the other, as they are in memory.
struct RawSamples
{
  std::string FileName;
  /// The number of bytes before them; if negative, they are at the end of the file.
  std::int64_t Offset;
  bool AreBigEndian;
};

}

#endif
