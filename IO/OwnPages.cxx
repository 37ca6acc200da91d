// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OwnPages.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace ImageFiles
{
namespace
{

/// Whether a line says that some of the memory of a mapping belongs to the process, in memory or
/// swapped out.
bool IsOfOwnMemory(const std::string& line)
{
  std::uint64_t kibibytes = 0;
  return (std::sscanf(line.c_str(), "Anonymous: %" SCNu64, &kibibytes) == 1 ||
           std::sscanf(line.c_str(), "Swap: %" SCNu64, &kibibytes) == 1) &&
    kibibytes > 0;
}

}

//------------------------------------------------------------------------------
/// A mapping is in several parts, one after the other, if parts of it are used in different ways.
bool AreAllOfFile(const void* pages, std::size_t size)
{
  const auto begin = reinterpret_cast<std::uintptr_t>(pages);
  std::ifstream mappings("/proc/self/smaps");
  bool isKnown = false;
  bool isInside = false;
  for (std::string line; std::getline(mappings, line);)
  {
    std::uintptr_t first = 0;
    std::uintptr_t end = 0;
    if (std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR, &first, &end) == 2)
    {
      isInside = first < begin + size && end > begin;
      isKnown = isKnown || isInside;
    }
    else if (isInside && IsOfOwnMemory(line))
    {
      return false;
    }
  }
  return isKnown;
}

}
