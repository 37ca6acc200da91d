// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Json.h"

#include <cmath>
#include <fstream>
#include <stdexcept>

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
  std::ofstream out(fileName);
  out << value << "\n";
  if (!out.flush())
  {
    throw std::runtime_error(fileName + " cannot be written");
  }
}

}
