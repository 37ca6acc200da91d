// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkIsosurfaceRayTraceScene.h"

#include "vtkPiecewiseFunction.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceValueColors::vtkIsosurfaceRayTraceValueColors(
  vtkVolumeProperty* property, int component)
  : Property(property)
  , Component(component)
{
  // A property creates missing functions when they are first used, which must not happen on
  // threads.
  this->Get(0.0);
}

//------------------------------------------------------------------------------
std::array<double, 4> vtkIsosurfaceRayTraceValueColors::Get(double value) const
{
  const vtkirt::Vector3 color =
    vtkIsosurfaceRayTraceScene::GetColor(this->Property, this->Component, value);
  const double opacity = this->Property->GetScalarOpacity(this->Component)->GetValue(value);
  return { color[0], color[1], color[2], std::clamp(opacity, 0.0, 1.0) };
}

VTK_ABI_NAMESPACE_END
