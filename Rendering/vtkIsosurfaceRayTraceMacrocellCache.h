// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The ranges of the finest macrocells of samples in a file, kept in a file of a directory.

#ifndef vtkIsosurfaceRayTraceMacrocellCache_h
#define vtkIsosurfaceRayTraceMacrocellCache_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Image/Macrocells/RangeStore.h"
#include "Image/Samples/VolumeView.h"

#include <filesystem>   // for std::filesystem::path
#include <string>       // for std::string
#include <system_error> // for std::error_code

namespace ImageFiles
{
class FileMapping;
}

VTK_ABI_NAMESPACE_BEGIN

/// The file has a text that says of which samples it is, a checksum of all, and the ranges. It is
/// believed if the text is the one expected, to the last byte, the length and the checksum are
/// right, and nobody has changed the samples in memory.
class vtkIsosurfaceRayTraceMacrocellCache final : public vtkIsosurfaceRayTracing::RangeStore
{
public:
  /// Of samples that are mapped. The mapping must outlive the cache.
  vtkIsosurfaceRayTraceMacrocellCache(const std::string& directory,
    const ImageFiles::FileMapping& mapping, const vtkIsosurfaceRayTracing::VolumeView& view);

  bool Read(int edge, void* ranges, std::size_t size) override;
  void Write(int edge, const void* ranges, std::size_t size) override;

  /// Why the ranges could not be kept, and what to do; empty if they could be.
  const std::string& GetProblem() const { return this->Problem; }

private:
  std::string DescribeRanges(int edge) const;
  std::filesystem::path FindPath(int edge) const;
  std::error_code WriteFile(const std::filesystem::path& path, const std::string& text,
    const void* ranges, std::size_t size) const;

  std::filesystem::path Directory;
  const ImageFiles::FileMapping& Mapping;
  /// Where the samples are, and of what kind.
  std::string Place;
  /// Whether the file had not been changed just before the samples were read.
  bool WasSettled;
  std::string Problem;
};

VTK_ABI_NAMESPACE_END

#endif
