// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What headers that are text have in common.

#ifndef HeaderText_h
#define HeaderText_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace ImageFiles
{

// A header has about a dozen short lines.
constexpr std::size_t LongestHeader = 1 << 16;

/// Whether who opens a file may wait forever.
inline bool IsPipe(const std::string& fileName)
{
  std::error_code error;
  return std::filesystem::is_fifo(fileName, error);
}

/// As much of a file as a header may have. Throws if it cannot be opened, or is a pipe.
inline std::string ReadBeginning(const std::string& fileName, std::size_t most = LongestHeader)
{
  std::ifstream file;
  if (!IsPipe(fileName))
  {
    file.open(fileName, std::ios::binary);
  }
  if (!file.is_open())
  {
    throw std::runtime_error(fileName + ": there is no such file, or it cannot be read");
  }
  std::string text(most, '\0');
  file.read(&text[0], static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

inline std::string Trim(const std::string& text)
{
  const char* const spaces = " \t\r";
  const std::size_t first = text.find_first_not_of(spaces);
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(spaces) + 1 - first);
}

/// A file that a header names is in its folder, unless the name has another.
inline std::string FindNamedFile(const std::string& header, const std::string& name)
{
  return (std::filesystem::path(header).parent_path() / name).string();
}

/// Numbers that are separated by spaces; none if there is anything else.
template <typename Number>
std::vector<Number> ParseNumbers(const std::string& text)
{
  std::istringstream words(text);
  std::vector<Number> numbers;
  Number number;
  while (words >> number)
  {
    numbers.push_back(number);
  }
  return words.eof() ? numbers : std::vector<Number>{};
}

/// So many numbers; zeros if there is anything else.
template <std::size_t Count>
std::array<double, Count> ParseArray(const std::string& text)
{
  const std::vector<double> numbers = ParseNumbers<double>(text);
  std::array<double, Count> values{};
  if (numbers.size() == Count)
  {
    std::copy(numbers.begin(), numbers.end(), values.begin());
  }
  return values;
}

}

#endif
