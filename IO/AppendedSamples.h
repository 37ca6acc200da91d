// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AppendedSamples_h
#define AppendedSamples_h

#include "RawSamples.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <cstdint>
#include <optional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkXMLDataParser;
VTK_ABI_NAMESPACE_END

namespace ImageFiles
{

/// The active scalars of the points of a file of VTK (.vti), in its raw appended data.
struct AppendedSamples : RawSamples
{
  std::string ArrayName;
  /// The number of bytes, as it stands before them, in so many bits.
  std::uint64_t Size;
  int BitsOfSize;

  /// Of more than 4 GB, a number of 32 bits has the lower bits.
  bool HaveSize(double size) const;
};

/// None if the samples are not there. Throws std::runtime_error if the file ends before them.
std::optional<AppendedSamples> FindAppendedSamples(
  vtkXMLDataParser* parser, const std::string& fileName);

}

#endif
