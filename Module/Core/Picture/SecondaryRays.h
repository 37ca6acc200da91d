// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SecondaryRays_h
#define SecondaryRays_h

#include "Kernels/Kernels.h"
#include "Picture/Scene.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The rays from the hits with one field of a scene: towards lights, for shadows, and into the
/// hemisphere above the surface, for ambient occlusion.
class SecondaryRays
{
public:
  /// The scene must outlive the object.
  SecondaryRays(const Scene& scene, std::size_t field);

  /// Finds what reaches hits of each light, for up to as many as a packet has rays.
  void FindLights(const Hit* hits, int count, LightAtHits* lights) const;

  /// Finds what reaches them of the ambient light.
  void FindAmbient(const Hit* hits, int count, LightAtHits& ambient) const;

private:
  /// Where rays leave a hit, in the object space of the field.
  struct Start
  {
    Vector3 Point;
    Vector3 Gradient;
    int Surface;
    int Member;
    std::int64_t Cell;
  };

  struct OutgoingRay
  {
    const Start* From;
    Vector3 Direction;
    double End;
  };

  /// Another field of the scene.
  struct OtherField
  {
    TracedField* Field;
    Matrix4 OtherFromOwn;
    /// Surfaces so near to the start of a ray may coincide with the one it starts on.
    double NearStart;
  };

  void FindStarts(const Hit* hits, int count, Start* starts) const;
  OutgoingRay MakeLightRay(const Light& light, const Start& start) const;
  OutgoingRay MakeOcclusionRay(const Vector3& direction, const Start& start) const;
  static std::vector<std::size_t> SortByDirection(const std::vector<OutgoingRay>& rays);
  void FindTransmittanceOfAll(
    const std::vector<OutgoingRay>& rays, std::vector<double>& transmittance) const;
  void FindTransmittance(const OutgoingRay* rays, int count, double* transmittance) const;
  void FindTransmittanceOfOthers(const OutgoingRay* rays, int count, double* transmittance) const;

  const Scene& TheScene;
  TracedField& Field;
  Matrix4 WorldFromObject;
  Matrix4 WorldFromGradient;
  std::vector<OtherField> Others;
};

}

#endif
