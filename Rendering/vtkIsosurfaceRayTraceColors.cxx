// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceColors.h"

#include "vtkIsosurfaceRayTraceScene.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkDataArray* vtkIsosurfaceRayTraceColors::FindArray(vtkImageData* image, const std::string& name)
{
  vtkPointData* data = image->GetPointData();
  vtkDataArray* array = name.empty() ? data->GetScalars() : data->GetArray(name.c_str());
  return array && array->GetNumberOfTuples() == image->GetNumberOfPoints() ? array : nullptr;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceColors::vtkIsosurfaceRayTraceColors(vtkImageData* image, vtkDataArray* array,
  const vtkirt::Matrix4& physicalFromIndex, vtkVolumeProperty* property, int component)
  : Image(image)
  , Array(array)
  , PhysicalFromIndex(physicalFromIndex)
  , Property(property)
  , Component(component)
  , IsDirect(array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3)
{
}

//------------------------------------------------------------------------------
double vtkIsosurfaceRayTraceColors::Sample(const double index[3], int component) const
{
  const int* extent = this->Image->GetExtent();
  const int* dimensions = this->Image->GetDimensions();
  vtkIdType corner = 0;
  vtkIdType stride = 1;
  vtkIdType steps[3];
  double weights[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    // Beside the image its border goes on.
    const double place =
      std::clamp(index[axis] - extent[2 * axis], 0.0, static_cast<double>(dimensions[axis] - 1));
    const int first = std::min(static_cast<int>(place), std::max(0, dimensions[axis] - 2));
    weights[axis] = place - first;
    corner += first * stride;
    steps[axis] = dimensions[axis] > 1 ? stride : 0;
    stride *= dimensions[axis];
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
    // What counts for nothing may be no number.
    sum += weight > 0.0 ? weight * this->Array->GetComponent(point, component) : 0.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceColors::Get(const vtkirt::Hit& hit) const
{
  const vtkirt::Vector3 point = vtkirt::TransformPoint(this->PhysicalFromIndex, hit.GetPoint());
  double index[3];
  this->Image->TransformPhysicalPointToContinuousIndex(point.data(), index);
  if (!this->IsDirect)
  {
    return vtkIsosurfaceRayTraceScene::GetColor(
      this->Property, this->Component, this->Sample(index, 0));
  }
  vtkirt::Vector3 color;
  for (int channel = 0; channel < 3; ++channel)
  {
    color[static_cast<std::size_t>(channel)] = this->Sample(index, channel) / 255.0;
  }
  return color;
}

VTK_ABI_NAMESPACE_END
