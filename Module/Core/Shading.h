// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Shading_h
#define Shading_h

#include "Scene.h"

namespace vtkIsosurfaceRayTracing
{

/// The colour of a hit, by the Phong model as VTK's surfaces have it. Direction is that of the ray,
/// in index space.
Vector3 ShadeHit(
  const Scene& scene, const TracedVolume& volume, const Hit& hit, const Vector3& direction);

/// How a gradient in index space turns into a normal in world space: the inverse of the linear part
/// of the matrix, transposed, up to a positive factor (even if the matrix mirrors).
Vector3 GradientToWorld(const Matrix4& worldFromIndex, const Vector3& gradient);

}

#endif
