// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "XmlFiles.h"

#include "HeaderText.h"
#include "InputFiles.h"

#include <vtksys/RegularExpression.hxx>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace Programs
{
namespace
{

/// What the first parentheses of an expression match in a text, each time.
std::vector<std::string> FindAll(const std::string& text, const char* expression)
{
  vtksys::RegularExpression search(expression);
  std::vector<std::string> found;
  for (const char* rest = text.c_str(); search.find(rest); rest += search.end())
  {
    found.push_back(search.match(1));
  }
  return found;
}

//------------------------------------------------------------------------------
/// Numbers of four or eight bytes, from a place of a file.
class Numbers
{
public:
  Numbers(const std::string& fileName, const std::string& header, std::uint64_t place)
    : File(fileName, std::ios::binary)
    , Size(header.substr(0, header.find('>')).find("\"UInt64\"") != std::string::npos ? 8 : 4)
    , AreBigEndian(header.find("\"BigEndian\"") != std::string::npos)
  {
    this->File.seekg(0, std::ios::end);
    this->FileSize = static_cast<std::uint64_t>(this->File.tellg());
    this->File.seekg(static_cast<std::streamoff>(place));
  }

  /// Too large for any file if it is cut off.
  std::uint64_t Read()
  {
    std::uint64_t number = 0;
    for (int i = 0; i < this->Size; ++i)
    {
      const auto byte = static_cast<std::uint64_t>(this->File.get() & 0xff);
      number |= byte << 8 * (this->AreBigEndian ? this->Size - 1 - i : i);
    }
    return this->File ? number : this->FileSize + 1;
  }

  /// The bytes after the last number.
  std::uint64_t GetRest()
  {
    return this->File ? this->FileSize - static_cast<std::uint64_t>(this->File.tellg()) : 0;
  }

private:
  std::ifstream File;
  int Size;
  bool AreBigEndian;
  std::uint64_t FileSize = 0;
};

//------------------------------------------------------------------------------
/// Whether an array is not cut off: the number of its bytes is before it; of a compressed one those
/// of its blocks, the size of whole ones and of the last one, and the bytes of each.
bool IsWhole(Numbers numbers, bool isCompressed)
{
  const std::uint64_t count = numbers.Read();
  if (!isCompressed || count == 0)
  {
    return count <= numbers.GetRest();
  }
  numbers.Read();
  numbers.Read();
  std::uint64_t bytes = 0;
  for (std::uint64_t i = 0; i < count && bytes <= numbers.GetRest(); ++i)
  {
    bytes += numbers.Read();
  }
  return bytes <= numbers.GetRest();
}

//------------------------------------------------------------------------------
/// Those of an image or a grid of an extent, such as "0 9 0 9 0 9": at least one along an axis with
/// a point.
double CountCells(const std::string& extent)
{
  constexpr std::size_t ends = 6;
  const auto numbers = ImageFiles::ParseArray<ends>(extent);
  double count = 1.0;
  for (std::size_t i = 0; i < ends; i += 2)
  {
    const double cells = numbers[i + 1] - numbers[i];
    count *= cells < 0.0 ? 0.0 : std::max(cells, 1.0);
  }
  return count;
}

/// Whether pieces have as many cells as the whole.
bool AreFilled(const std::string& header)
{
  double left = 0.0;
  for (const std::string& extent : FindAll(header, "[ \t\r\n]WholeExtent *= *\"([^\"]*)\""))
  {
    left += CountCells(extent);
  }
  for (const std::string& extent : FindAll(header, "[ \t\r\n]Extent *= *\"([^\"]*)\""))
  {
    left -= CountCells(extent);
  }
  return left <= 0.0;
}

//------------------------------------------------------------------------------
bool HasEnd(const std::string& fileName)
{
  constexpr std::streamoff most = 1 << 16;
  std::ifstream file(fileName, std::ios::binary | std::ios::ate);
  file.seekg(std::max<std::streamoff>(0, std::streamoff{ file.tellg() } - most));
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  return text.empty() || text.find("</VTKFile>") != std::string::npos;
}

//------------------------------------------------------------------------------
/// Throws if the file ends too early, or if its pieces do not fill it. (A file that is no piece of
/// others may lack its end: VTK's readers report what that leaves out.) Returns the files that it
/// names.
std::vector<std::string> CheckFile(const std::string& fileName, bool isPiece)
{
  constexpr std::size_t most = 1 << 22;
  const std::string text = ImageFiles::ReadBeginning(fileName, most);
  vtksys::RegularExpression data("<AppendedData[^>]*\"raw\"[^>]*>[ \t\r\n]*_");
  const bool hasData = data.find(text);
  const std::string header = hasData ? text.substr(0, data.start()) : text;
  std::uint64_t last = 0;
  for (const std::string& offset : FindAll(header, "[ \t\r\n]offset *= *\"([0-9]+)\""))
  {
    last = std::max<std::uint64_t>(last, std::strtoull(offset.c_str(), nullptr, 10));
  }
  if (hasData &&
    !IsWhole(
      { fileName, header, data.end() + last }, header.find(" compressor=") != std::string::npos))
  {
    throw std::runtime_error(fileName + " cannot be read: it ends before its last samples");
  }
  if (isPiece && !hasData && !HasEnd(fileName))
  {
    throw std::runtime_error(fileName + " cannot be read: it has no end (</VTKFile>)");
  }
  if ((hasData || text.size() < most) && !AreFilled(header))
  {
    throw std::runtime_error(fileName + " cannot be read: its pieces do not fill its WholeExtent");
  }
  std::vector<std::string> files = FindAll(header, "[ \t\r\n]file *= *\"([^\"]+)\"");
  const std::vector<std::string> pieces = FindAll(header, "[ \t\r\n]Source *= *\"([^\"]+)\"");
  files.insert(files.end(), pieces.begin(), pieces.end());
  return files;
}

}

//------------------------------------------------------------------------------
void CheckXmlFile(const std::string& fileName)
{
  for (const std::string& name : CheckFile(fileName, false))
  {
    const std::string file = ImageFiles::FindNamedFile(fileName, name);
    if (IsFile(file))
    {
      CheckFile(file, true);
    }
  }
}

}
