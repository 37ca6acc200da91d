// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Schedule_h
#define Schedule_h

#include <string>
#include <vector>

namespace Benchmark
{

/// Reports progress.
void Log(const std::string& what);

/// A number as people write it: whole ones with all digits.
std::string ToText(double number);

/// How often a benchmark measures, and with what.
struct Schedule
{
  /// The edge of the pictures, in pixels.
  int Size;
  /// The number of views of the orbit.
  int Views;
  /// In ascending order.
  std::vector<int> Threads;
  int Repeats;

  int GetMostThreads() const { return this->Threads.back(); }
  std::string GetPictureSize() const;
  void LogTurn(const std::string& what, int repeat) const;
};

/// Numbers of threads in ascending order, of a text such as 1,2; of none, 1 and all that the
/// machine has. Throws std::runtime_error.
std::vector<int> ParseThreads(const std::string& text);

}

#endif
