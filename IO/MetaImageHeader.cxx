// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "MetaImageHeader.h"

#include "HeaderText.h"

#include <vtksys/RegularExpression.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace ImageFiles
{
namespace
{

namespace fs = std::filesystem;
using vtksys::SystemTools;

constexpr int MostFiles = 1 << 16;

//------------------------------------------------------------------------------
/// The lines "name = value" up to ElementDataFile, and what follows them.
struct Header
{
  std::string FileName;
  std::map<std::string, std::string> Fields;
  std::string Rest;

  [[noreturn]] void Throw(const std::string& problem) const
  {
    throw std::runtime_error(this->FileName + " cannot be read: " + problem);
  }

  /// Empty if it is not there.
  std::string Get(const std::string& name) const
  {
    const auto found = this->Fields.find(name);
    return found == this->Fields.end() ? "" : found->second;
  }

  bool IsTrue(const std::string& name) const
  {
    const std::string value = this->Get(name);
    return !value.empty() && (value[0] == 'T' || value[0] == 't' || value[0] == '1');
  }

  /// Not text. A header that does not say has an image in binary form.
  bool IsBinary() const { return this->Get("BinaryData").empty() || this->IsTrue("BinaryData"); }
};

//------------------------------------------------------------------------------
Header ReadHeader(const std::string& fileName)
{
  Header header{ fileName, {}, {} };
  const std::string text = ReadBeginning(fileName);
  std::istringstream lines(text);
  std::string line;
  while (std::getline(lines, line))
  {
    if (line.find('\0') != std::string::npos)
    {
      header.Throw("it is another kind of file: a MetaImage begins with lines such as NDims = 3");
    }
    const std::size_t separator = line.find_first_of("=:");
    const std::string name = Trim(line.substr(0, separator));
    const std::string value =
      separator == std::string::npos ? "" : Trim(line.substr(separator + 1));
    if (!name.empty() && !header.Fields.emplace(name, value).second)
    {
      header.Throw("its header has " + name + " twice");
    }
    if (name == "ElementDataFile")
    {
      const std::streamoff end = lines.tellg();
      header.Rest = end < 0 ? "" : text.substr(static_cast<std::size_t>(end));
      return header;
    }
  }
  header.Throw("its header has no ElementDataFile");
}

//------------------------------------------------------------------------------
/// Whole numbers, separated by spaces; throws if there is anything else.
std::vector<int> GetNumbers(const Header& header, const std::string& name)
{
  const std::vector<int> numbers = ParseNumbers<int>(header.Get(name));
  if (numbers.empty())
  {
    header.Throw("its header has " + name + " = " + header.Get(name));
  }
  return numbers;
}

//------------------------------------------------------------------------------
/// A field that has several names; empty if it is not there.
std::string GetFirst(const Header& header, std::initializer_list<const char*> names)
{
  for (const char* name : names)
  {
    if (!header.Get(name).empty())
    {
      return header.Get(name);
    }
  }
  return {};
}

/// Three letters, one for each axis.
bool IsInPatient(const Header& header)
{
  const std::string letters = SystemTools::UpperCase(header.Get("AnatomicalOrientation"));
  const auto hasOneOf = [&letters](const char* pair)
  { return letters.find_first_of(pair) != std::string::npos; };
  return letters.size() == 3 && hasOneOf("RL") && hasOneOf("AP") && hasOneOf("IS");
}

//------------------------------------------------------------------------------
/// What VTK's reader takes as it is.
void CheckFields(const Header& header)
{
  const std::vector<int> dimensionality = GetNumbers(header, "NDims");
  if (dimensionality.size() != 1 || (dimensionality[0] != 2 && dimensionality[0] != 3))
  {
    header.Throw("its header has NDims = " + header.Get("NDims") + ", a volume has 3");
  }
  const std::vector<int> size = GetNumbers(header, "DimSize");
  if (static_cast<int>(size.size()) != dimensionality[0] ||
    *std::min_element(size.begin(), size.end()) < 1)
  {
    header.Throw("its header has DimSize = " + header.Get("DimSize"));
  }
  const std::string channels = "ElementNumberOfChannels";
  if (!header.Get(channels).empty() && GetNumbers(header, channels) < std::vector<int>{ 1 })
  {
    header.Throw("its header has " + channels + " = " + header.Get(channels));
  }
  if (!header.IsBinary() && !header.Get(channels).empty() && header.Get(channels) != "1")
  {
    header.Throw("it has several components as text, of which VTK's reader takes a part. Write "
                 "them in binary form");
  }
  // MET_LONG is of four bytes, which VTK takes for eight.
  const char* const types[] = { "MET_CHAR", "MET_UCHAR", "MET_SHORT", "MET_USHORT", "MET_INT",
    "MET_UINT", "MET_FLOAT", "MET_DOUBLE" };
  if (std::find(std::begin(types), std::end(types), header.Get("ElementType")) == std::end(types))
  {
    header.Throw("VTK reads no samples of ElementType = " + header.Get("ElementType"));
  }
  constexpr std::size_t longest = 254;
  for (const char* name : { "Comment", "Name", "ObjectSubType" })
  {
    if (header.Get(name).size() > longest)
    {
      header.Throw("its header has a " + std::string(name) + " of more than " +
        std::to_string(longest) +
        " characters, by which VTK's reader ends the process. Shorten it");
    }
  }
}

//------------------------------------------------------------------------------
/// The files of "name%03d.raw first last step".
std::vector<std::string> ExpandPattern(const Header& header, const std::string& value)
{
  // It becomes a format of printf.
  vtksys::RegularExpression form(
    "^([^%]*)%(0?[1-9]?)d([^% ]*) +([0-9]+) +([0-9]+)( +([1-9][0-9]*))?$");
  if (!form.find(value))
  {
    header.Throw("its header has ElementDataFile = " + value);
  }
  const auto width = static_cast<std::size_t>(std::atoi(form.match(2).c_str()));
  const char fill = form.match(2)[0] == '0' ? '0' : ' ';
  const long last = std::atol(form.match(5).c_str());
  const long step = std::max(1L, std::atol(form.match(7).c_str()));
  std::vector<std::string> files;
  for (long i = std::atol(form.match(4).c_str()); i <= last; i += step)
  {
    std::string number = std::to_string(i);
    number.insert(0, width > number.size() ? width - number.size() : 0, fill);
    files.push_back(form.match(1) + number + form.match(3));
    if (files.size() > MostFiles)
    {
      header.Throw("it has more than " + std::to_string(MostFiles) + " files");
    }
  }
  return files;
}

//------------------------------------------------------------------------------
/// The files of the samples; none if they are in the file of the header.
std::vector<std::string> FindDataFiles(const Header& header)
{
  const std::string value = header.Get("ElementDataFile");
  if (value == "LOCAL" || value == "Local" || value == "local")
  {
    return {};
  }
  std::vector<std::string> files;
  if (SystemTools::StringStartsWith(value, "LIST"))
  {
    if (value != "LIST" && value != "LIST 2D")
    {
      header.Throw("its header has ElementDataFile = " + value +
        ", which VTK's reader takes for files of slices. Write a slice into each file");
    }
    std::istringstream lines(header.Rest);
    std::string line;
    while (std::getline(lines, line))
    {
      files.push_back(Trim(line));
    }
  }
  else if (value.find('%') != std::string::npos)
  {
    files = ExpandPattern(header, value);
  }
  else
  {
    files.push_back(value);
  }
  if (files.empty())
  {
    header.Throw("its header names no file of samples");
  }
  return files;
}

//------------------------------------------------------------------------------
double GetSize(const Header& header, const fs::path& file)
{
  std::error_code error;
  const std::uintmax_t size = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
  if (error || size == 0)
  {
    header.Throw("there are no samples in the file " + file.string() + " that its header names");
  }
  return static_cast<double>(size);
}

//------------------------------------------------------------------------------
/// The bytes of the lines up to the samples, where they are in the same file.
std::size_t GetSizeOfText(const Header& header)
{
  const double size = GetSize(header, header.FileName);
  return std::min(static_cast<std::size_t>(size), LongestHeader) - header.Rest.size();
}

//------------------------------------------------------------------------------
/// The bytes of samples, compressed or as text if they are.
double GetSizeOfSamples(const Header& header)
{
  const std::vector<std::string> files = FindDataFiles(header);
  if (files.empty())
  {
    return GetSize(header, header.FileName) - static_cast<double>(GetSizeOfText(header));
  }
  // All files have as many samples.
  double smallest = std::numeric_limits<double>::infinity();
  for (const std::string& file : files)
  {
    smallest = std::min(smallest, GetSize(header, FindNamedFile(header.FileName, file)));
  }
  return smallest * static_cast<double>(files.size());
}

}

//------------------------------------------------------------------------------
bool IsMetaImage(const std::string& fileName)
{
  const std::string name = SystemTools::LowerCase(fileName);
  return SystemTools::StringEndsWith(name, ".mhd") || SystemTools::StringEndsWith(name, ".mha");
}

//------------------------------------------------------------------------------
std::vector<std::string> FindDataFiles(const std::string& fileName)
{
  std::vector<std::string> files = FindDataFiles(ReadHeader(fileName));
  for (std::string& file : files)
  {
    file = FindNamedFile(fileName, file);
  }
  return files;
}

//------------------------------------------------------------------------------
double GetCapacityOfMetaImage(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  CheckFields(header);
  double skipped = 0.0;
  if (!header.Get("HeaderSize").empty())
  {
    skipped = std::max(0, GetNumbers(header, "HeaderSize")[0]);
  }
  const double size = GetSizeOfSamples(header) - skipped;
  if (header.IsTrue("CompressedData"))
  {
    // Without it VTK's reader takes the whole file for samples, the header too.
    if (header.Get("CompressedDataSize").empty() && FindDataFiles(header).empty())
    {
      header.Throw("its header has no CompressedDataSize");
    }
    // The reader would leave the samples undefined that the missing bytes have.
    if (size < std::strtod(header.Get("CompressedDataSize").c_str(), nullptr))
    {
      header.Throw("its file of samples is cut off");
    }
    return size * MostInflated;
  }
  // As text, a sample of up to eight bytes is at least a digit and a space.
  return header.IsBinary() ? size : 4.0 * size + 8.0;
}

//------------------------------------------------------------------------------
std::optional<RawSamples> FindRawSamples(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  CheckFields(header);
  const std::vector<std::string> files = FindDataFiles(header);
  const bool isOneFile =
    files.empty() || files == std::vector<std::string>{ header.Get("ElementDataFile") };
  if (!isOneFile || header.IsTrue("CompressedData") || !header.IsBinary())
  {
    return {};
  }
  RawSamples samples;
  samples.FileName = files.empty() ? fileName : FindNamedFile(fileName, files.front());
  samples.Offset = files.empty() ? static_cast<std::int64_t>(GetSizeOfText(header)) : 0;
  // As VTK's reader: 0 stands for no header but that with the text.
  const int skipped = header.Get("HeaderSize").empty() ? 0 : GetNumbers(header, "HeaderSize")[0];
  if (skipped > 0 || skipped == -1)
  {
    samples.Offset = skipped;
  }
  samples.AreBigEndian =
    header.IsTrue("BinaryDataByteOrderMSB") || header.IsTrue("ElementByteOrderMSB");
  return samples;
}

//------------------------------------------------------------------------------
std::optional<ImagePlace> FindPlaceOfMetaImage(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  const std::string matrix = GetFirst(header, { "TransformMatrix", "Rotation", "Orientation" });
  const bool isInPatient = IsInPatient(header);
  if (matrix.empty() && !isInPatient)
  {
    return {};
  }
  const std::string spacing = GetFirst(header, { "ElementSpacing", "ElementSize" });
  const auto directions = ParseArray<9>(matrix.empty() ? "1 0 0 0 1 0 0 0 1" : matrix);
  const auto lengths = ParseArray<3>(spacing.empty() ? "1 1 1" : spacing);
  ImagePlace place{ {}, ParseArray<3>(GetFirst(header, { "Offset", "Position", "Origin" })) };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      place.Steps[axis][i] = directions[3 * axis + i] * std::abs(lengths[axis]);
    }
  }
  if (isInPatient)
  {
    place.Turn(-1.0, -1.0);
  }
  return place;
}

}
