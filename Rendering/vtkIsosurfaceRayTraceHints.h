// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Why a picture may not show what was meant, though nothing is wrong with its numbers. The
// functions return a sentence with the remedy; empty if there is none.

#ifndef vtkIsosurfaceRayTraceHints_h
#define vtkIsosurfaceRayTraceHints_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkLightCollection;

struct vtkIsosurfaceRayTraceRequest;
struct vtkIsosurfaceRayTraceSettings;

namespace vtkIsosurfaceRayTraceHints
{

/// No isovalue is within the scalars; shadows or occlusion are on, and shading is off; occlusion is
/// on, and there is no ambient light; what would reflect light is shaded, and no light is on. Of
/// data that are a piece of others nothing is said of isovalues: the others may have them. Without
/// lights (null) there is one, as in RenderToImage.
std::string FindInRequest(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTraceSettings& settings, vtkLightCollection* lights);

/// The camera, given its matrix, sees nothing of the boxes of the data.
std::string FindInView(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracing::Matrix4& clipFromWorld);

}

VTK_ABI_NAMESPACE_END

#endif
