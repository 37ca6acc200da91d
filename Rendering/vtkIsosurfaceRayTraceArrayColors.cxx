// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceArrayColors.h"

#include "vtkIsosurfaceRayTraceGeometry.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceLatticeSampling.h"
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceArrayColors::Sample(
  const vtkirt::Hit& hit, int components, double* values) const
{
  const vtkIsosurfaceRayTracePart& part = this->Input.GetPart(hit);
  if (!this->AreOfCells)
  {
    part.SampleColors(hit, components, values);
    return;
  }
  const vtkIsosurfaceRayTraceLeaf& leaf = part.FindLeaf(hit);
  vtkirt::Vector3 parametric;
  const vtkIdType cell = part.FindCell(hit, parametric) - leaf.FirstCell;
  for (int component = 0; component < components; ++component)
  {
    values[component] = leaf.CellColors->GetComponent(cell, component);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageColors::Sample(
  const vtkirt::Hit& hit, int components, double* values) const
{
  const vtkirt::Vector3 point =
    vtkirt::TransformPoint(this->PhysicalFromObject, this->Field.GetPoint(hit));
  vtkirt::Vector3 index;
  this->Image->TransformPhysicalPointToContinuousIndex(point.data(), index.data());
  const int* extent = this->Image->GetExtent();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    index[axis] -= extent[2 * axis];
  }
  const vtkirt::Index3 dimensions = vtkIsosurfaceRayTraceGeometry::GetDimensions(this->Image);
  for (int component = 0; component < components; ++component)
  {
    values[component] =
      vtkIsosurfaceRayTraceSampleLattice(this->Array, dimensions, index, component);
  }
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceBlockColors::Get(const vtkirt::Hit& hit) const
{
  const vtkIsosurfaceRayTraceBlockDisplay& display = this->Input.GetPart(hit).FindLeaf(hit).Display;
  if (display.Color)
  {
    return *display.Color;
  }
  if (this->OfArray)
  {
    return this->OfArray->Get(hit);
  }
  const bool isCap = hit.Plane != vtkirt::Hit::NoPlane;
  return this->OfValues.GetColor(isCap ? hit.Value : this->Input.GetField()->GetValue(hit));
}

VTK_ABI_NAMESPACE_END
