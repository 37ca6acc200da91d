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

/// What is wrong with the cropping of a mapper; empty if nothing is.
std::string FindProblem(vtkVolumeMapper* mapper);

/// Takes from what is visible of a grid what cropping does not leave, if it is on.
void Apply(vtkVolumeMapper* mapper, const vtkIsosurfaceRayTraceGeometry& geometry,
  vtkIsosurfaceRayTracing::Visibility& visibility);

}

VTK_ABI_NAMESPACE_END

#endif
