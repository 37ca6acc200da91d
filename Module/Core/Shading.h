// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Shading_h
#define Shading_h

#include "Kernels.h"
#include "Scene.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Colours hits by the Phong model as VTK's surfaces have it. What all hits of a frame share is
/// worked out once.
class Shader
{
public:
  /// The scene and the volume must outlive the shader.
  Shader(const Scene& scene, const TracedVolume& volume);

  /// The colour of a hit of a ray with a direction in index space.
  Vector3 Shade(const Hit& hit, const Vector3& direction) const;

  /// The colours of the hits of a group of rays, the same but faster.
  void Shade(const RayGroup& rays, const RayHits& hits, std::vector<Vector3>& colors) const;

private:
  bool CanUseKernels() const;
  void ShadeSome(const Hit* hits, ShadedHits& shaded, Vector3* colors) const;
  double Highlight(double cosine) const;

  const Scene& TheScene;
  const TracedVolume& Volume;
  Matrix4 WorldFromGradient;
  /// The specular power, if it is a small whole number; else -1.
  int WholePower;
  /// The lights, if all of them are infinitely far.
  std::vector<DistantLight> DistantLights;
};

/// How a gradient in index space turns into a normal in world space: the inverse of the linear part
/// of the matrix, transposed, up to a positive factor (even if the matrix mirrors).
Matrix4 GradientMatrix(const Matrix4& worldFromIndex);

/// The gradient transformed by GradientMatrix.
Vector3 GradientToWorld(const Matrix4& worldFromIndex, const Vector3& gradient);

}

#endif
