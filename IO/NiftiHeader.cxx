// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "NiftiHeader.h"

#include "MetaImageHeader.h"

#include <vtk_zlib.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace ImageFiles
{
namespace
{

using vtksys::SystemTools;

/// As much of a header as has the type, in version 1 and in version 2 of the format.
using Header = std::array<unsigned char, 72>;

//------------------------------------------------------------------------------
/// Zeros where the file ends; the reader tells that.
Header ReadHeader(const std::string& fileName)
{
  Header header = {};
  // It reads files that are not compressed too.
  if (gzFile file = gzopen(fileName.c_str(), "rb"))
  {
    gzread(file, header.data(), static_cast<unsigned int>(header.size()));
    gzclose(file);
  }
  return header;
}

//------------------------------------------------------------------------------
template <typename IntegerT>
IntegerT GetInteger(const Header& header, std::size_t offset, bool isBigEndian)
{
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(IntegerT); ++i)
  {
    const std::size_t significance = isBigEndian ? sizeof(IntegerT) - 1 - i : i;
    value |= std::uint64_t{ header[offset + i] } << (8 * significance);
  }
  return static_cast<IntegerT>(value);
}

//------------------------------------------------------------------------------
/// As the reader finds the byte order: there are 0 to 7 dimensions.
template <typename IntegerT>
int GetType(const Header& header, std::size_t offsetOfType, std::size_t offsetOfDimensions)
{
  const auto dimensions = GetInteger<IntegerT>(header, offsetOfDimensions, false);
  const bool isBigEndian = dimensions < 0 || dimensions > 7;
  return GetInteger<std::int16_t>(header, offsetOfType, isBigEndian);
}

}

//------------------------------------------------------------------------------
bool IsNifti(const std::string& fileName)
{
  const std::string name = SystemTools::LowerCase(fileName);
  return SystemTools::StringEndsWith(name, ".nii") || SystemTools::StringEndsWith(name, ".nii.gz");
}

//------------------------------------------------------------------------------
bool IsCompressedNifti(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  return file.get() == 0x1f && file.get() == 0x8b;
}

//------------------------------------------------------------------------------
double GetCapacityOfNifti(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  const bool isVersion2 = header[4] == 'n' && header[6] >= '2' && header[6] <= '9';
  const int type =
    isVersion2 ? GetType<std::int64_t>(header, 12, 16) : GetType<std::int16_t>(header, 70, 40);
  constexpr int known[] = { 2, 4, 8, 16, 32, 64, 128, 256, 512, 768, 1024, 1280, 1792, 2304 };
  if (std::find(std::begin(known), std::end(known), type) == std::end(known))
  {
    throw std::runtime_error(fileName + " cannot be read: its header has the type of data " +
      std::to_string(type) + ", which VTK does not know");
  }
  const auto size = static_cast<double>(SystemTools::FileLength(fileName));
  return IsCompressedNifti(fileName) ? size * MostInflated : size;
}

}
