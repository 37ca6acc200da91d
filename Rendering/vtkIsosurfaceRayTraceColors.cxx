// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceColors.h"

#include "vtkIsosurfaceRayTraceSource.h"
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

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
vtkIsosurfaceRayTraceColors::vtkIsosurfaceRayTraceColors(vtkImageData* image, vtkDataArray* array,
  const vtkIsosurfaceRayTraceSource& source, const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
  : Image(image)
  , Array(array)
  , Source(source)
  , Dimensions(
      image ? vtkIsosurfaceRayTraceGeometry::GetDimensions(image) : source.GetNumberOfPoints())
  , ColorsOfValues(colorsOfValues)
  , IsDirect(array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3)
{
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceColors::GetIndex(const vtkirt::Hit& hit) const
{
  vtkirt::Vector3 index;
  if (!this->Image)
  {
    const vtkirt::Index3 cell = this->Source.FindStructuredCell(hit, index);
    return { cell[0] + index[0], cell[1] + index[1], cell[2] + index[2] };
  }
  const vtkirt::Vector3 point = vtkirt::TransformPoint(
    this->Source.GetGeometry().GetPhysicalFromObject(), this->Source.GetField()->GetPoint(hit));
  this->Image->TransformPhysicalPointToContinuousIndex(point.data(), index.data());
  const int* extent = this->Image->GetExtent();
  return { index[0] - extent[0], index[1] - extent[2], index[2] - extent[4] };
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceColors::Sample(const vtkirt::Vector3& index, int component) const
{
  vtkIdType corner = 0;
  vtkIdType stride = 1;
  vtkIdType steps[3];
  double weights[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // Border values extend beyond the image. (NaN, from numbers that overflow, is at its begin.)
    const int dimension = this->Dimensions[axis];
    const double coordinate =
      std::min(std::max(0.0, index[axis]), static_cast<double>(dimension - 1));
    const int first = std::min(static_cast<int>(coordinate), std::max(0, dimension - 2));
    weights[axis] = coordinate - first;
    corner += first * stride;
    steps[axis] = dimension > 1 ? stride : 0;
    stride *= dimension;
  }
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    double weight = 1.0;
    vtkIdType point = corner;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isUpper = (i >> axis & 1) != 0;
      weight *= isUpper ? weights[axis] : 1.0 - weights[axis];
      point += isUpper ? steps[axis] : 0;
    }
    // Values without weight may be NaN.
    sum += weight > 0.0 ? weight * this->Array->GetComponent(point, component) : 0.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceColors::Get(const vtkirt::Hit& hit) const
{
  const vtkirt::Vector3 index = this->GetIndex(hit);
  if (!this->IsDirect)
  {
    return this->ColorsOfValues.GetColor(this->Sample(index, 0));
  }
  vtkirt::Vector3 color;
  for (int channel = 0; channel < 3; ++channel)
  {
    color[static_cast<std::size_t>(channel)] = this->Sample(index, channel) / 255.0;
  }
  return color;
}

VTK_ABI_NAMESPACE_END
