// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cropping of a vtkVolumeMapper, in the object space of the field.

#ifndef vtkIsosurfaceRayTraceCropping_h
#define vtkIsosurfaceRayTraceCropping_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Rays/Visibility.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceGeometry;
class vtkVolumeMapper;

namespace vtkIsosurfaceRayTraceCropping
{

/// The problem with the cropping of a mapper; empty if there is none.
std::string FindProblem(vtkVolumeMapper* mapper);

/// Removes what cropping cuts away from the visible parts of a grid, if cropping is on.
void Apply(vtkVolumeMapper* mapper, const vtkIsosurfaceRayTraceGeometry& geometry,
  vtkIsosurfaceRayTracing::Visibility& visibility);

}

VTK_ABI_NAMESPACE_END

#endif
