// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Schedule.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace Benchmark
{

//------------------------------------------------------------------------------
void Log(const std::string& what)
{
  std::fprintf(stderr, "%s\n", what.c_str());
}

//------------------------------------------------------------------------------
std::string ToText(double number)
{
  char text[32];
  const bool isWhole = std::abs(number) < 1e15 && number == std::floor(number);
  std::snprintf(text, sizeof(text), isWhole ? "%.0f" : "%g", number);
  return text;
}

//------------------------------------------------------------------------------
std::string Schedule::GetPictureSize() const
{
  return std::to_string(this->Size) + " x " + std::to_string(this->Size) + " pixels";
}

//------------------------------------------------------------------------------
void Schedule::LogTurn(const std::string& what, int repeat) const
{
  Log(what + ", turn " + std::to_string(repeat + 1) + " of " + std::to_string(this->Repeats));
}

//------------------------------------------------------------------------------
std::vector<int> ParseThreads(const std::string& text)
{
  const int all = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> threads;
  for (const std::string& number : vtksys::SystemTools::SplitString(text, ','))
  {
    const int count = std::atoi(number.c_str());
    if (count < 1 || count > 1024)
    {
      throw std::runtime_error("--threads " + text + ": give numbers from 1 to 1024, such as 1,2");
    }
    threads.push_back(count);
  }
  if (text.empty())
  {
    threads = { 1, all };
  }
  std::sort(threads.begin(), threads.end());
  threads.erase(std::unique(threads.begin(), threads.end()), threads.end());
  return threads;
}

}
