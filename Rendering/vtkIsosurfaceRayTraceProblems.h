// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is wrong with the numbers of a scene that others set: nothing can be traced with numbers
// that are not finite, or with matrices that have no inverse, and nothing with the perspective of
// a volume's own matrix. The functions Find return the problem and its remedy; empty if there is
// none.

#ifndef vtkIsosurfaceRayTraceProblems_h
#define vtkIsosurfaceRayTraceProblems_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkDataSet;
class vtkLightCollection;
class vtkPlaneCollection;
class vtkVolume;

namespace vtkIsosurfaceRayTraceProblems
{

/// Whether a matrix is finite and has a finite inverse, which VTK finds by the determinant.
bool IsInvertible(const vtkIsosurfaceRayTracing::Matrix4& matrix);

/// Of the matrix of a volume whose data have a matrix of their own, and of the material of
/// a component.
std::string FindInVolume(
  vtkVolume* volume, int component, const vtkIsosurfaceRayTracing::Matrix4& physicalFromObject);

/// Of clipping planes; null for none.
std::string FindInPlanes(vtkPlaneCollection* planes);

/// Of a camera, given its matrix, and of the lights that are on; null for none.
std::string FindInView(
  const vtkIsosurfaceRayTracing::Matrix4& clipFromWorld, vtkLightCollection* lights);

/// Of the arrays that blank points and cells.
std::string FindInGhosts(vtkDataSet* grid);

}

VTK_ABI_NAMESPACE_END

#endif
