// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Circumstances_h
#define Circumstances_h

#include <string>
#include <utility>
#include <vector>

namespace Benchmark
{

class OffScreenWindow;

/// What must be known of a measurement, names and values: when and where it runs, by which command,
/// and what draws in this window, if there is one.
std::vector<std::pair<std::string, std::string>> DescribeMachine(
  const std::vector<std::string>& command, OffScreenWindow* window);

}

#endif
