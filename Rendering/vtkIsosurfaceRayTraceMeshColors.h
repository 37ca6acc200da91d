// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by arrays of the points of the meshes that are traced.

#ifndef vtkIsosurfaceRayTraceMeshColors_h
#define vtkIsosurfaceRayTraceMeshColors_h

#include "vtkIsosurfaceRayTraceColors.h"   // for base class
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceMesh;

class vtkIsosurfaceRayTraceMeshColors final : public vtkIsosurfaceRayTraceColors
{
public:
  /// A mesh, which must outlive this, and its array.
  struct Part
  {
    const vtkIsosurfaceRayTraceMesh* Mesh;
    vtkDataArray* Array;
  };

  /// One for each field. The arrays have the same number of components.
  vtkIsosurfaceRayTraceMeshColors(
    const std::vector<Part>& parts, const vtkIsosurfaceRayTraceValueColors& colorsOfValues);

private:
  void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;

  std::vector<Part> Parts;
};

VTK_ABI_NAMESPACE_END

#endif
