// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The colours and opacities of values by a volume property.

#ifndef vtkIsosurfaceRayTraceValueColors_h
#define vtkIsosurfaceRayTraceValueColors_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Scene.h"

#include <array> // for std::array

VTK_ABI_NAMESPACE_BEGIN

class vtkVolumeProperty;

class vtkIsosurfaceRayTraceValueColors final : public vtkIsosurfaceRayTracing::ValueColors
{
public:
  /// The property must outlive this and not change.
  vtkIsosurfaceRayTraceValueColors(vtkVolumeProperty* property, int component);

  std::array<double, 4> Get(double value) const override;

private:
  vtkVolumeProperty* Property;
  int Component;
};

VTK_ABI_NAMESPACE_END

#endif
