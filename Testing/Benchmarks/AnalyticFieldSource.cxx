// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "AnalyticFieldSource.h"

#include "AnalyticFields.h"

#include <vtkDataObject.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <cstdint>
#include <map>
#include <stdexcept>

namespace Benchmark
{
namespace
{

using AnalyticFields::Point;
using Function = std::function<double(const Point&)>;

const std::map<std::string, Function>& GetFields()
{
  static const std::map<std::string, Function> fields = {
    { "gyroid",
      // Two and a half periods, as in the other benchmark.
      [](const Point& p) { return AnalyticFields::Gyroid{ 0.8 }(p) / 1.5; } },
    { "marschner-lobb", [](const Point& p) { return AnalyticFields::MarschnerLobb()(p) - 0.5; } },
    { "sphere",
      [](const Point& p) {
        return AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, 0.8 }(p);
      } }
  };
  return fields;
}

}

vtkStandardNewMacro(AnalyticFieldSource);

//------------------------------------------------------------------------------
AnalyticFieldSource::AnalyticFieldSource()
  : Field(GetFields().at("gyroid"))
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
std::vector<std::string> AnalyticFieldSource::GetFieldNames()
{
  std::vector<std::string> names;
  for (const auto& field : GetFields())
  {
    names.push_back(field.first);
  }
  return names;
}

//------------------------------------------------------------------------------
void AnalyticFieldSource::SetField(const std::string& name)
{
  const auto found = GetFields().find(name);
  if (found == GetFields().end())
  {
    std::string message = "there is no field " + name + "; there are:";
    for (const std::string& known : GetFieldNames())
    {
      message += " " + known;
    }
    throw std::runtime_error(message);
  }
  this->Field = found->second;
  this->Modified();
}

//------------------------------------------------------------------------------
void AnalyticFieldSource::SetDimensions(const std::array<int, 3>& dimensions)
{
  this->Dimensions = dimensions;
  this->Modified();
}

//------------------------------------------------------------------------------
int AnalyticFieldSource::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const auto& n = this->Dimensions;
  const int extent[6] = { 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 };
  const double spacing[3] = { 2.0 / extent[1], 2.0 / extent[3], 2.0 / extent[5] };
  const double origin[3] = { -1.0, -1.0, -1.0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_SHORT, 1);
  return 1;
}

//------------------------------------------------------------------------------
void AnalyticFieldSource::ExecuteDataWithInformation(vtkDataObject* output, vtkInformation* info)
{
  constexpr double largest = 32000.0;
  vtkImageData* image = this->AllocateOutputData(output, info);
  const int* extent = image->GetExtent();
  const double* spacing = image->GetSpacing();
#pragma omp parallel for schedule(dynamic)
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      auto* sample = static_cast<std::int16_t*>(image->GetScalarPointer(extent[0], y, z));
      for (int x = extent[0]; x <= extent[1]; ++x, ++sample)
      {
        const double value =
          this->Field({ x * spacing[0] - 1.0, y * spacing[1] - 1.0, z * spacing[2] - 1.0 });
        *sample = AnalyticFields::ToSample<std::int16_t>(largest * value);
      }
    }
  }
}

}
