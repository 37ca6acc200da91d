// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Shader_h
#define Shader_h

#include "Kernels/Kernels.h"
#include "Picture/Compositor.h"
#include "Picture/Scene.h"
#include "Picture/SecondaryRays.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What reaches a hit of the light of a scene.
struct IncomingLight
{
  double Ambient = 1.0;
  /// One for each light of the scene; null where there are no shadows.
  const LightAtHits* Lights = nullptr;
  /// The place of the hit in them.
  int Place = 0;
};

/// Turns the hits with one field of a scene into fragments, lit by the Phong model as VTK lights
/// surfaces. What all hits of a frame share is computed once.
class Shader
{
public:
  /// The scene must outlive the shader. The field is selected.
  Shader(const Scene& scene, std::size_t field, const Kernels* kernels);

  /// The colour of a hit of a ray with a direction in object space.
  Vector3 Shade(const Hit& hit, const Vector3& direction, const IncomingLight& light = {}) const;

  /// The fragments of the hits of a packet.
  void MakeFragments(const RayPacket& packet, const RayHits& hits, Fragments& fragments) const;

  /// Whether every hit is that of a ray with one opaque surface, which MakePixels can turn into
  /// pixels.
  bool CanMakePixels() const;

  /// Turns the hits of a packet into pixels, in their order. The result is that of their fragments,
  /// but faster.
  void MakePixels(const RayPacket& packet, const RayHits& hits, HitPixels& pixels) const;

private:
  bool CanUseKernels() const;
  Vector3 GetColor(const Hit& hit) const;
  Fragment MakeFragment(const Hit& hit, const double (*points)[RayPacket::Capacity], int i,
    const ShadedHits& shaded) const;
  Fragment MakeFragmentOfValue(const Hit& hit) const;
  void Append(const Hit& hit, const RayPacket& packet, int ray, ShadedHits& shaded) const;
  void ShadeSome(const Hit* hits, double (*points)[RayPacket::Capacity], ShadedHits& shaded) const;
  void ShadeByKernels(
    const Hit* hits, double (*points)[RayPacket::Capacity], ShadedHits& shaded) const;
  void ShadeOne(const Hit& hit, int i, ShadedHits& shaded) const;
  double Highlight(double cosine) const;

  const Scene& TheScene;
  const SceneField& Own;
  TracedField& Field;
  const Kernels* TheKernels;
  SecondaryRays Secondary;
  Matrix4 WorldFromGradient;
  /// The specular power, if it is a small whole number; else -1.
  int WholePower;
  /// The lights, if all of them are infinitely far.
  std::vector<DistantLight> DistantLights;
};

/// The shaders of all fields of a scene, which must outlive them.
std::vector<Shader> MakeShaders(const Scene& scene, const Kernels* kernels);

}

#endif
