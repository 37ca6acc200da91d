// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Circumstances_h
#define Circumstances_h

#include <string>
#include <utility>
#include <vector>

namespace Benchmark
{

/// What must be known of a measurement: names and values.
using Circumstances = std::vector<std::pair<std::string, std::string>>;

/// When and where this runs, and by which command.
Circumstances DescribeMachine(const std::vector<std::string>& command);

}

#endif
