// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Environment_h
#define Environment_h

#include <vtk_jsoncpp.h>

#include <string>
#include <vector>

namespace Benchmark
{

class OffScreenWindow;

/// What must be known of a measurement, by name: when and where it runs, by which command, and what
/// draws in this window, if there is one.
Json::Value DescribeEnvironment(const std::vector<std::string>& command, OffScreenWindow* window);

/// The memory that the program has now.
double GetResidentMebibytes();

/// Of the baselines named, those that are available; says of the others why not.
std::vector<std::string> SelectAvailable(
  const std::vector<std::string>& baselines, Json::Value& environment);

}

#endif
