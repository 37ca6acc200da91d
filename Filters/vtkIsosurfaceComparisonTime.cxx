// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonTime.h"

#include "vtkIsosurfaceComparisonRow.h"

#include <algorithm>
#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace vtkIsosurfaceComparison
{
namespace
{

/// A line of /proc/self/status, in bytes: VmRSS is the memory in RAM, VmHWM the most it has been.
double ReadStatus(const std::string& name)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
  {
    double kibibytes = 0.0;
    if (word == name + ":" && status >> kibibytes)
    {
      return 1024.0 * kibibytes;
    }
  }
  return NotMeasured;
}

}

//------------------------------------------------------------------------------
double Median(std::vector<double> values)
{
  if (values.empty())
  {
    return NotMeasured;
  }
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

//------------------------------------------------------------------------------
MemoryPeak::MemoryPeak()
{
#if defined(__GLIBC__)
  // What was freed before must not be there for the taking.
  malloc_trim(0);
#endif
  std::ofstream reset("/proc/self/clear_refs");
  reset << "5" << std::flush; // Resets VmHWM.
  this->Before = reset ? ReadStatus("VmRSS") : NotMeasured;
}

//------------------------------------------------------------------------------
double MemoryPeak::GetBytes() const
{
  return std::max(ReadStatus("VmHWM") - this->Before, 0.0);
}

}
