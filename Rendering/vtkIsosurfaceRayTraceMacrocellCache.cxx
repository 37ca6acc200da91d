// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMacrocellCache.h"

#include "FileMapping.h"

#include "vtkSetGet.h" // for VTK_WORDS_BIGENDIAN

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <random>
#include <sstream>
#include <type_traits>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// To be changed with the ranges: what they are of, or how they are stored.
constexpr int FormatVersion = 1;

#ifdef VTK_WORDS_BIGENDIAN
const char* const ByteOrder = "big-endian";
#else
const char* const ByteOrder = "little-endian";
#endif

//------------------------------------------------------------------------------
std::string DescribeType(vtkirt::ScalarType type)
{
  return vtkirt::DispatchScalarType(type,
    [](auto value)
    {
      using T = decltype(value);
      const char* kind = std::is_floating_point_v<T> ? "float"
        : std::is_signed_v<T>                        ? "int"
                                                     : "uint";
      return kind + std::to_string(8 * sizeof(T));
    });
}

//------------------------------------------------------------------------------
/// A change within eight bytes always changes the sum: each step is invertible.
std::uint64_t AddToChecksum(std::uint64_t sum, const void* data, std::size_t size)
{
  const char* bytes = static_cast<const char*>(data);
  for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t))
  {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min(sizeof(word), size - i));
    sum = (sum ^ word) * 0x9e3779b97f4a7c15; // odd
    sum ^= sum >> 32;
  }
  return sum;
}

std::uint64_t FindChecksum(const std::string& text, const void* ranges, std::size_t size)
{
  return AddToChecksum(AddToChecksum(0, text.data(), text.size()), ranges, size);
}

//------------------------------------------------------------------------------
std::string ToHexadecimal(std::uint64_t number)
{
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(16) << number;
  return text.str();
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMacrocellCache::vtkIsosurfaceRayTraceMacrocellCache(
  const std::string& directory, const ImageFiles::FileMapping& mapping,
  const vtkirt::VolumeView& view)
  : Directory(directory)
  , Mapping(mapping)
  , WasSettled(mapping.GetState().IsSettled())
{
  const auto inMapping =
    static_cast<const char*>(view.Samples) - static_cast<const char*>(mapping.GetBytes());
  std::ostringstream place;
  place << "file " << mapping.GetFileName() << "\nsamples from byte "
        << mapping.GetOffset() + inMapping << ", " << view.Dimensions[0] << " x "
        << view.Dimensions[1] << " x " << view.Dimensions[2] << " of " << DescribeType(view.Type)
        << ", every " << view.Stride << "\n";
  this->Place = place.str();
}

//------------------------------------------------------------------------------
/// What the file begins with.
std::string vtkIsosurfaceRayTraceMacrocellCache::DescribeRanges(int edge) const
{
  const ImageFiles::FileState& state = this->Mapping.GetState();
  std::ostringstream text;
  text << "vtkIsosurfaceRayTracing macrocells, version " << FormatVersion << ", " << ByteOrder
       << "\n"
       << this->Place << "size " << state.Size << ", number " << state.Number << ", modified "
       << state.Modified << ", changed " << state.Changed << "\nmacrocells of " << edge
       << " cells\n";
  return text.str();
}

//------------------------------------------------------------------------------
/// The same for a file that has been changed: the ranges of what it was are replaced.
std::filesystem::path vtkIsosurfaceRayTraceMacrocellCache::FindPath(int edge) const
{
  const std::string place = this->Place + std::to_string(edge);
  return this->Directory /
    (ToHexadecimal(AddToChecksum(0, place.data(), place.size())) + ".macrocells");
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceMacrocellCache::Read(int edge, void* ranges, std::size_t size)
{
  const std::string expected = this->DescribeRanges(edge);
  const std::filesystem::path path = this->FindPath(edge);
  std::uint64_t checksum = 0;
  std::error_code error;
  const std::uintmax_t length = std::filesystem::file_size(path, error);
  if (error || length != expected.size() + sizeof(checksum) + size)
  {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  std::string text(expected.size(), ' ');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  file.read(reinterpret_cast<char*>(&checksum), sizeof(checksum));
  if (!file || text != expected)
  {
    return false;
  }
  file.read(static_cast<char*>(ranges), static_cast<std::streamsize>(size));
  return file && FindChecksum(text, ranges, size) == checksum && this->Mapping.IsUnchanged();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMacrocellCache::Write(int edge, const void* ranges, std::size_t size)
{
  if (!this->WasSettled || !this->Mapping.IsUnchanged())
  {
    return;
  }
  std::error_code error;
  std::filesystem::create_directories(this->Directory, error);
  if (!error)
  {
    error = this->WriteFile(this->FindPath(edge), this->DescribeRanges(edge), ranges, size);
  }
  if (error)
  {
    this->Problem = "Macrocells cannot be kept in " + this->Directory.string() + ": " +
      error.message() +
      ". They are built again the next time. Give a directory that can be written "
      "to and has " +
      std::to_string((size >> 20) + 1) + " MiB left (SetCacheDirectory), or none.";
  }
}

//------------------------------------------------------------------------------
/// By another name, until it is complete: whoever reads the file meanwhile has that from before,
/// and of several who write it, each writes its own.
std::error_code vtkIsosurfaceRayTraceMacrocellCache::WriteFile(const std::filesystem::path& path,
  const std::string& text, const void* ranges, std::size_t size) const
{
  std::random_device random;
  std::filesystem::path part = path;
  part += "." + ToHexadecimal((std::uint64_t{ random() } << 32) | random());
  const std::uint64_t checksum = FindChecksum(text, ranges, size);
  errno = 0;
  std::ofstream file(part, std::ios::binary);
  file.write(text.data(), static_cast<std::streamsize>(text.size()));
  file.write(reinterpret_cast<const char*>(&checksum), sizeof(checksum));
  file.write(static_cast<const char*>(ranges), static_cast<std::streamsize>(size));
  file.close();
  std::error_code error(file ? 0 : errno, std::generic_category());
  if (file)
  {
    std::filesystem::rename(part, path, error);
  }
  if (!file || error)
  {
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
  }
  return error;
}

VTK_ABI_NAMESPACE_END
