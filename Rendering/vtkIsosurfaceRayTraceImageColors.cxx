// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceImageColors.h"

#include "vtkIsosurfaceRayTraceSource.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageColors::vtkIsosurfaceRayTraceImageColors(vtkImageData* image,
  vtkDataArray* array, const vtkIsosurfaceRayTraceSource& source,
  const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
  : vtkIsosurfaceRayTraceColors(IsDirect(array), colorsOfValues)
  , Image(image)
  , Array(array)
  , Source(source)
  , Dimensions(
      image ? vtkIsosurfaceRayTraceGeometry::GetDimensions(image) : source.GetNumberOfPoints())
{
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageColors::Sample(
  const vtkirt::Hit& hit, int components, double* values) const
{
  const vtkirt::Vector3 index = this->GetIndex(hit);
  for (int component = 0; component < components; ++component)
  {
    values[component] = this->SampleAt(index, component);
  }
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceImageColors::GetIndex(const vtkirt::Hit& hit) const
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
double vtkIsosurfaceRayTraceImageColors::SampleAt(const vtkirt::Vector3& index, int component) const
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

VTK_ABI_NAMESPACE_END
