// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceColors.h"

#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

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
  bool isDirect, const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
  : AreDirect(isDirect)
  , ColorsOfValues(colorsOfValues)
{
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceColors::Get(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 values;
  this->Sample(hit, this->AreDirect ? 3 : 1, values.data());
  return this->AreDirect
    ? vtkirt::Vector3{ values[0] / 255.0, values[1] / 255.0, values[2] / 255.0 }
    : this->ColorsOfValues.GetColor(values[0]);
}

VTK_ABI_NAMESPACE_END
