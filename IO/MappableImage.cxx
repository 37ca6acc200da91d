// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MappableImage.h"

#include "FileMapping.h"

#include <vtkSetGet.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace ImageFiles
{
namespace
{

#ifdef VTK_WORDS_BIGENDIAN
constexpr bool IsBigEndian = true;
#else
constexpr bool IsBigEndian = false;
#endif

/// In bytes; 0 of what is not a number, and of bits.
int GetSizeOfType(int scalarType)
{
  switch (scalarType)
  {
    vtkTemplateMacro(return static_cast<int>(sizeof(VTK_TT)));
    default:
      return 0;
  }
}

double GetLength(const MappableImage& image, std::size_t axis)
{
  const double first = image.Extent[2 * axis];
  return std::max(0.0, image.Extent[2 * axis + 1] - first + 1.0);
}

}

//------------------------------------------------------------------------------
double MappableImage::GetNumberOfValues() const
{
  return GetLength(*this, 0) * GetLength(*this, 1) * GetLength(*this, 2) * this->NumberOfComponents;
}

//------------------------------------------------------------------------------
double MappableImage::GetSize() const
{
  return this->GetNumberOfValues() * GetSizeOfType(this->ScalarType);
}

//------------------------------------------------------------------------------
bool MappableImage::IsLike(const MappableImage& other) const
{
  return this->ArrayName == other.ArrayName && this->ScalarType == other.ScalarType &&
    this->NumberOfComponents == other.NumberOfComponents && this->Extent == other.Extent &&
    this->Spacing == other.Spacing && this->Origin == other.Origin &&
    this->Direction == other.Direction;
}

//------------------------------------------------------------------------------
void MappableImage::Reverse(std::size_t axis)
{
  const double first = this->Extent[2 * axis];
  const double ends = first + this->Extent[2 * axis + 1];
  for (std::size_t row = 0; row < 3; ++row)
  {
    double& direction = this->Direction[3 * row + axis];
    this->Origin[row] += direction * this->Spacing[axis] * ends;
    direction = -direction;
  }
}

//------------------------------------------------------------------------------
void MappableImage::Check()
{
  const double size = this->GetSize();
  if (!(size > 0.0))
  {
    this->Throw("its header gives it no samples, or none of a type that arrays of VTK have");
  }
  const std::int64_t sizeOfFile = GetSizeOfFile(this->Samples.FileName);
  const double offset = std::max(0.0, static_cast<double>(this->Samples.Offset));
  if (offset + size > static_cast<double>(sizeOfFile))
  {
    std::ostringstream problem;
    problem.precision(17);
    problem << "its header asks for " << GetLength(*this, 0) << " x " << GetLength(*this, 1)
            << " x " << GetLength(*this, 2) << " samples, " << size << " bytes from byte " << offset
            << " on, but " << this->Samples.FileName << " has " << sizeOfFile
            << " bytes. Complete the file, or correct the header.";
    this->Throw(problem.str());
  }
  if (this->Samples.Offset < 0)
  {
    this->Samples.Offset = sizeOfFile - static_cast<std::int64_t>(size);
  }
  const int sizeOfType = GetSizeOfType(this->ScalarType);
  const std::string otherwise = ", or read it into the memory with " + this->Reader + ".";
  if (sizeOfType > 1 && this->Samples.AreBigEndian != IsBigEndian)
  {
    this->Throw(std::string("its samples are ") + (IsBigEndian ? "little" : "big") +
      "-endian, and this machine is not. Write them in the byte order of the machine" + otherwise);
  }
  if (this->Samples.Offset % sizeOfType != 0)
  {
    this->Throw("its samples begin at byte " + std::to_string(this->Samples.Offset) +
      ", which is no multiple of the size of a number of theirs, " + std::to_string(sizeOfType) +
      ". Write them into a file of their own (.mhd, .nhdr)" + otherwise);
  }
}

//------------------------------------------------------------------------------
void MappableImage::Throw(const std::string& problem) const
{
  throw std::runtime_error(this->Samples.FileName + " cannot be mapped: " + problem);
}

}
