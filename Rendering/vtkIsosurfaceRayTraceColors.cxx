// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceColors.h"

#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// As many as a tensor has. An array may have more, which are not looked at.
constexpr int MostComponents = 9;

}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceColors::FindArray(vtkDataSet* grid, const std::string& name)
{
  vtkPointData* data = grid->GetPointData();
  vtkDataArray* array = name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
  const bool hasAll = array && array->GetNumberOfTuples() > 0 &&
    array->GetNumberOfTuples() == grid->GetNumberOfPoints();
  return hasAll ? array : nullptr;
}

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceColors::FindCellArray(vtkDataSet* grid, const std::string& name)
{
  vtkDataArray* array = grid->GetCellData()->GetArray(name.c_str());
  const bool hasAll = array && array->GetNumberOfTuples() > 0 &&
    array->GetNumberOfTuples() == grid->GetNumberOfCells();
  return hasAll ? array : nullptr;
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceColors::DescribeMissing(const std::string& name)
{
  return "There is no array named \"" + name +
    "\" in the input to colour by. Give an array with a tuple for every point, or for every cell, "
    "to SetColorArrayName.";
}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceColors::DescribeMissingInImage(const std::string& name)
{
  return "There are no point data " +
    (name.empty() ? std::string("scalars") : "named \"" + name + "\"") +
    " in the second input to colour by. Give an array with a tuple for every point to "
    "SetColorArrayName.";
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceColors::IsDirect(vtkDataArray* array)
{
  return array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceColors::vtkIsosurfaceRayTraceColors(
  bool isDirect, int components, const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
  : AreDirect(isDirect)
  , Components(std::min(components, MostComponents))
  , AreMagnitudes(components > 1 && colorsOfValues.AreOfMagnitudes())
  , ColorsOfValues(colorsOfValues)
{
  if (!this->AreMagnitudes)
  {
    this->Components = std::min(this->Components, colorsOfValues.GetVectorComponent() + 1);
  }
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceColors::Get(const vtkirt::Hit& hit) const
{
  std::array<double, MostComponents> values;
  if (this->AreDirect)
  {
    this->Sample(hit, 3, values.data());
    return { values[0] / 255.0, values[1] / 255.0, values[2] / 255.0 };
  }
  const int count = this->Components;
  this->Sample(hit, count, values.data());
  const double value = this->AreMagnitudes
    ? std::sqrt(std::inner_product(values.begin(), values.begin() + count, values.begin(), 0.0))
    : values[static_cast<std::size_t>(count) - 1];
  return this->ColorsOfValues.GetColor(value);
}

VTK_ABI_NAMESPACE_END
