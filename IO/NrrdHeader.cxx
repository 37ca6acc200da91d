// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "NrrdHeader.h"

#include "HeaderText.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace ImageFiles
{
namespace
{

using vtksys::SystemTools;

// The format's own limit.
constexpr std::size_t MostDimensions = 16;

//------------------------------------------------------------------------------
/// The lines "name: value", and the number of bytes up to the samples if they follow.
struct Header
{
  std::string FileName;
  std::map<std::string, std::string> Fields;
  std::int64_t Size = 0;

  [[noreturn]] void Throw(const std::string& problem) const
  {
    throw std::runtime_error(this->FileName + " cannot be read: its header " + problem);
  }

  /// Two names of a field: the format knows some with a space and without. Empty if it is not
  /// there.
  std::string Get(const std::string& name, const std::string& otherName = {}) const
  {
    auto found = this->Fields.find(name);
    found = found == this->Fields.end() ? this->Fields.find(otherName) : found;
    return found == this->Fields.end() ? "" : found->second;
  }
};

/// As VTK's reader takes it: segmentations have some lines for each of hundreds of segments.
constexpr std::size_t LongestNrrdHeader = 1 << 22;

//------------------------------------------------------------------------------
/// Whether a text has lines up to an empty one, or nothing but lines. VTK's reader never comes to
/// an end of others.
bool HasEnd(const std::string& text)
{
  const std::size_t end = std::min(text.find("\n\n"), text.find("\n\r\n"));
  const std::string header = text.substr(0, end);
  return header.find('\0') == std::string::npos &&
    (end != std::string::npos ||
      (text.size() < LongestNrrdHeader && !text.empty() && text.back() == '\n'));
}

//------------------------------------------------------------------------------
Header ReadHeader(const std::string& fileName)
{
  Header header{ fileName, {} };
  const std::string text = ReadBeginning(fileName, LongestNrrdHeader);
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line.compare(0, 4, "NRRD") != 0)
  {
    header.Throw("does not begin with NRRD");
  }
  if (!HasEnd(text))
  {
    header.Throw("has no end: an empty line, or a last line that ends");
  }
  // Up to an empty line, or the end of a file of its own.
  while (std::getline(lines, line) && !Trim(line).empty())
  {
    const std::size_t separator = line.find(": ");
    if (line[0] == '#' || separator == std::string::npos)
    {
      continue;
    }
    const std::string name = line.substr(0, separator);
    if (name == "sizes" && header.Fields.count("dimension") == 0)
    {
      header.Throw("has no dimension before its sizes");
    }
    if (!header.Fields.emplace(name, Trim(line.substr(separator + 2))).second)
    {
      header.Throw("has " + name + " twice");
    }
  }
  const std::streamoff end = lines.tellg();
  header.Size = end < 0 ? static_cast<std::int64_t>(text.size()) : std::int64_t{ end };
  return header;
}

//------------------------------------------------------------------------------
std::vector<double> GetNumbers(const Header& header, const std::string& name)
{
  const std::vector<double> numbers = ParseNumbers<double>(header.Get(name));
  if (numbers.empty())
  {
    header.Throw("has " + name + ": " + header.Get(name));
  }
  return numbers;
}

//------------------------------------------------------------------------------
std::vector<std::string> SplitWords(const std::string& text)
{
  std::istringstream words(text);
  return { std::istream_iterator<std::string>(words), {} };
}

//------------------------------------------------------------------------------
/// How many samples there are.
double GetCount(const Header& header)
{
  const std::vector<double> dimension = GetNumbers(header, "dimension");
  const std::vector<double> sizes = GetNumbers(header, "sizes");
  const auto isSize = [](double size)
  { return size >= 1.0 && size < std::numeric_limits<int>::max() && size == std::int64_t(size); };
  if (dimension.size() != 1 || sizes.size() > MostDimensions ||
    dimension[0] != static_cast<double>(sizes.size()) ||
    !std::all_of(sizes.begin(), sizes.end(), isSize))
  {
    header.Throw(
      "has dimension: " + header.Get("dimension") + " and sizes: " + header.Get("sizes"));
  }
  double count = 1.0;
  for (const double size : sizes)
  {
    count *= size;
  }
  return count;
}

//------------------------------------------------------------------------------
/// Empty if the samples are in the file of the header.
std::string GetDataFile(const Header& header)
{
  return header.Get("data file", "datafile");
}

/// Whether a data file is a pattern with numbers, or a list.
bool IsSeveralFiles(const std::string& dataFile)
{
  return SystemTools::SplitString(dataFile, ' ').size() >= 4 ||
    SystemTools::StringStartsWith(dataFile, "LIST");
}

//------------------------------------------------------------------------------
bool IsZero(const std::string& number)
{
  return number.empty() || number == "0";
}

//------------------------------------------------------------------------------
/// The numbers of a vector such as (1,0,0).
std::array<double, 3> ParseVector(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c == '(' || c == ',' || c == ')'; }, ' ');
  return ParseArray<3>(text);
}

/// Three vectors; zeros if there are others. Axes that are not in space, as that of the components,
/// have "none".
std::array<std::array<double, 3>, 3> ParseVectors(const std::string& text)
{
  std::array<std::array<double, 3>, 3> vectors{};
  std::size_t count = 0;
  std::size_t begin = text.find('(');
  while (begin != std::string::npos)
  {
    const std::size_t end = text.find(')', begin);
    if (end == std::string::npos || count == vectors.size())
    {
      return {};
    }
    vectors[count++] = ParseVector(text.substr(begin, end - begin));
    begin = text.find('(', end);
  }
  return vectors;
}

//------------------------------------------------------------------------------
/// Whether components, or volumes, are along each axis, by the vectors of the axes.
std::vector<bool> FindParts(const std::string& vectors)
{
  std::vector<bool> areParts;
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    const bool isNone = vectors.compare(i, 4, "none") == 0;
    if (isNone || vectors[i] == '(')
    {
      areParts.push_back(isNone);
    }
  }
  return areParts;
}

/// Whether components, or volumes, are along the first axis, if there are any.
bool ArePartsFirst(const Header& header)
{
  const std::vector<std::string> sizes = SplitWords(header.Get("sizes"));
  std::vector<bool> areParts = FindParts(header.Get("space directions"));
  if (areParts.empty() && sizes.size() > 3)
  {
    for (const std::string& kind : SplitWords(header.Get("kinds")))
    {
      areParts.push_back(kind != "space" && kind != "domain");
    }
  }
  // Where the header does not tell, fewer than ten are components, as VTK's reader has it.
  const bool isFirst =
    areParts.empty() ? !sizes.empty() && sizes.front().size() == 1 : areParts.front();
  const bool isOther =
    areParts.size() > 1 && std::find(areParts.begin() + 1, areParts.end(), true) != areParts.end();
  return !isOther && (sizes.size() < 4 || (sizes.size() == 4 && isFirst));
}

//------------------------------------------------------------------------------
bool IsRaw(const Header& header)
{
  return SystemTools::LowerCase(header.Get("encoding")) == "raw";
}

//------------------------------------------------------------------------------
double GetBytesOfSample(const Header& header)
{
  const std::string type = SystemTools::LowerCase(header.Get("type"));
  const auto has = [&type](const char* word) { return type.find(word) != std::string::npos; };
  if (has("char") || has("int8"))
  {
    return 1.0;
  }
  if (has("short") || has("int16"))
  {
    return 2.0;
  }
  return has("double") || has("int64") || has("long long") || has("longlong") ? 8.0 : 4.0;
}

//------------------------------------------------------------------------------
/// What VTK's reader takes compressed samples for that are others; empty if it reads them.
std::string FindProblemOfCompressed(const Header& header, const std::string& fileName)
{
  const std::vector<std::string> sizes = SplitWords(header.Get("sizes"));
  if (sizes.size() > 3 && sizes.front() != "1")
  {
    return "has compressed samples of several components, of which VTK's reader takes a part";
  }
  if (GetBytesOfSample(header) > 1.0 && SystemTools::LowerCase(header.Get("endian")) == "big")
  {
    return "has compressed big-endian samples, whose bytes VTK's reader does not swap";
  }
  const std::string dataFile = GetDataFile(header);
  if (IsSeveralFiles(dataFile))
  {
    return "has compressed samples in several files, of which VTK's reader takes the first";
  }
  const double bytes = GetCount(header) * GetBytesOfSample(header);
  if (!dataFile.empty() &&
    static_cast<double>(SystemTools::FileLength(FindNamedFile(fileName, dataFile))) > bytes)
  {
    return "has compressed samples in a file that is longer than they are without compression, of "
           "which VTK's reader takes the beginning for a header";
  }
  return "";
}

}

//------------------------------------------------------------------------------
bool IsNrrd(const std::string& fileName)
{
  const std::string name = SystemTools::LowerCase(fileName);
  return SystemTools::StringEndsWith(name, ".nrrd") || SystemTools::StringEndsWith(name, ".nhdr");
}

//------------------------------------------------------------------------------
std::string FindDataFileOfNrrd(const std::string& fileName)
{
  const std::string name = GetDataFile(ReadHeader(fileName));
  return name.empty() || IsSeveralFiles(name) ? "" : FindNamedFile(fileName, name);
}

//------------------------------------------------------------------------------
void CheckNrrd(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  GetCount(header);
  const std::string encoding = SystemTools::LowerCase(header.Get("encoding"));
  if (encoding == "ascii" || encoding == "text" || encoding == "txt")
  {
    header.Throw(
      "says that its samples are text, of which VTK's reader skips some. Write them with "
      "the encoding raw or gzip.");
  }
  if (!ArePartsFirst(header))
  {
    header.Throw("has components, or several volumes, along an axis that is not the first, which "
                 "VTK's reader takes for them, or does not tell the axis (kinds). Write one "
                 "volume.");
  }
  const std::string problem = IsRaw(header) ? "" : FindProblemOfCompressed(header, fileName);
  if (!problem.empty())
  {
    header.Throw(problem + ". Write them with the encoding raw.");
  }
}

//------------------------------------------------------------------------------
void CheckVolumeOfNrrd(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  const std::vector<std::string> sizes = SplitWords(header.Get("sizes"));
  if (sizes.size() == 3 && sizes.front().size() == 1)
  {
    header.Throw("has three axes, of which VTK's reader takes the first, with fewer than ten "
                 "samples, for components. Write a volume with a longer axis first, or with more "
                 "samples.");
  }
}

//------------------------------------------------------------------------------
std::optional<NrrdSamples> FindRawSamplesOfNrrd(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  const double count = GetCount(header);
  const std::string dataFile = GetDataFile(header);
  if (!IsRaw(header) || IsSeveralFiles(dataFile) || !IsZero(header.Get("byte skip", "byteskip")) ||
    !IsZero(header.Get("line skip", "lineskip")))
  {
    return {};
  }
  NrrdSamples samples;
  samples.Count = count;
  samples.AreBigEndian = header.Get("endian") == "big";
  samples.FileName = fileName;
  samples.Offset = header.Size;
  if (!dataFile.empty())
  {
    samples.FileName = FindNamedFile(fileName, dataFile);
    // As VTK's reader, which takes what there is before them for a header.
    samples.Offset = -1;
  }
  return samples;
}

//------------------------------------------------------------------------------
std::optional<NrrdPlace> FindPlaceOfNrrd(const std::string& fileName)
{
  const Header header = ReadHeader(fileName);
  const std::string directions = header.Get("space directions");
  if (directions.empty())
  {
    return {};
  }
  NrrdPlace place{ { ParseVectors(directions), ParseVector(header.Get("space origin")) }, false };
  const std::string name = header.Get("space");
  place.AreRowsReversed = IsRaw(header) &&
    (name == "left-anterior-superior" || name == "LAS" || name == "3D-left-handed");
  const std::string space = SystemTools::LowerCase(name);
  if (space == "left-posterior-superior" || space == "lps")
  {
    place.Turn(-1.0, -1.0);
  }
  else if (space == "left-anterior-superior" || space == "las")
  {
    place.Turn(-1.0, 1.0);
  }
  return place;
}

}
