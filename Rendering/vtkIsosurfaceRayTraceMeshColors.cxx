// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceMeshColors.h"

#include "vtkIsosurfaceRayTraceMesh.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceMeshColors::vtkIsosurfaceRayTraceMeshColors(
  const std::vector<Part>& parts, const vtkIsosurfaceRayTraceValueColors& colorsOfValues)
  : vtkIsosurfaceRayTraceColors(std::all_of(parts.begin(), parts.end(),
                                  [](const Part& part) { return IsDirect(part.Array); }),
      colorsOfValues)
  , Parts(parts)
{
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceMeshColors::Sample(
  const vtkirt::Hit& hit, int components, double* values) const
{
  const Part& part = this->Parts[static_cast<std::size_t>(hit.Field)];
  part.Mesh->Interpolate(hit, part.Array, components, values);
}

VTK_ABI_NAMESPACE_END
