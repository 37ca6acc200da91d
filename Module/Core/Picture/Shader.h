// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Shader_h
#define Shader_h

#include "Kernels/Kernels.h"
#include "Picture/Scene.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Colours hits by the Phong model as VTK's surfaces have it. What all hits of a frame share is
/// worked out once.
class Shader
{
public:
  /// The scene and the volume must outlive the shader.
  Shader(const Scene& scene, ImageField& volume);

  /// The colour of a hit of a ray with a direction in index space. For each light, shares has how
  /// much of it comes through to the hit; null where there are no shadows. Openness is the same for
  /// ambient light.
  Vector3 Shade(const Hit& hit, const Vector3& direction, const double* shares = nullptr,
    double openness = 1.0) const;

  /// How much ambient light comes to hits: all, 1, from a sky without surfaces.
  std::vector<double> FindOpenness(const std::vector<Hit>& hits) const;

  /// The colours of the hits of a group of rays, the same but faster.
  void Shade(const RayPacket& rays, const RayHits& hits, std::vector<Vector3>& colors) const;

  /// Whether MakePixels may be asked.
  bool CanMakePixels() const;

  /// Turns the hits of a group of rays to pixels, in their order, where one opaque surface is all
  /// there is: at most one hit for each ray. The same as by the colours of the hits, but faster.
  void MakePixels(const RayPacket& rays, const RayHits& hits, HitPixels& pixels) const;

private:
  struct ShadowRay
  {
    Vector3 Origin;
    Vector3 Direction;
    double End;
  };

  bool CanUseKernels() const;
  Vector3 GetColor(const Hit& hit) const;
  void Append(const Hit& hit, const RayPacket& rays, int ray, ShadedHits& shaded) const;
  void ShadeSome(const Hit* hits, ShadedHits& shaded) const;
  std::vector<double> CastShadows(const std::vector<Hit>& hits) const;
  ShadowRay MakeShadowRay(const Light& light, const Hit& hit) const;
  ShadowRay MakeOcclusionRay(const Vector3& direction, const Hit& hit) const;
  void FindSharesSorted(const std::vector<ShadowRay>& rays, const std::vector<Hit>& starts,
    std::vector<double>& shares) const;
  void FindShares(const ShadowRay* shadowRays, const Hit* hits, int count, double* shares) const;
  double GetOpacity(const Hit& hit) const;
  double Highlight(double cosine) const;

  const Scene& TheScene;
  ImageField& Volume;
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
