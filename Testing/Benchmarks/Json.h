// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Json_h
#define Json_h

#include "Samples.h"

#include <vtk_jsoncpp.h>

#include <string>

namespace Benchmark
{

/// Null for numbers that are not finite, which JSON cannot hold.
Json::Value ToJson(double value);

/// Median, minimum, maximum and count; null where there are no samples.
Json::Value ToJson(const Samples& samples);

/// Throws std::runtime_error if the file cannot be written.
void WriteJson(const Json::Value& value, const std::string& fileName);

}

#endif
