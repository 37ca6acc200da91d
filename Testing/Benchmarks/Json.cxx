// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Json.h"

#include "Support/OutputFile.h"

#include <cmath>
#include <sstream>

namespace Benchmark
{

//------------------------------------------------------------------------------
Json::Value ToJson(double value)
{
  return std::isfinite(value) ? Json::Value(value) : Json::Value();
}

//------------------------------------------------------------------------------
Json::Value ToJson(const Samples& samples)
{
  Json::Value value;
  if (!samples.IsEmpty())
  {
    value["median"] = samples.GetMedian();
    value["minimum"] = samples.GetMinimum();
    value["maximum"] = samples.GetMaximum();
    value["count"] = samples.GetCount();
  }
  return value;
}

//------------------------------------------------------------------------------
void WriteJson(const Json::Value& value, const std::string& fileName)
{
  std::ostringstream text;
  text << value << "\n";
  Programs::WriteFile(text.str(), fileName);
}

}
