// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SecondaryRays_h
#define SecondaryRays_h

#include "Picture/Scene.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The rays that leave the hits with one field of a scene: towards lights, for shadows, and into
/// the hemisphere above the surface, for ambient occlusion.
class SecondaryRays
{
public:
  /// The scene must outlive the object.
  SecondaryRays(const Scene& scene, std::size_t field);

  /// How much of each light comes through to each hit: hit by hit, light by light.
  std::vector<double> FindLightTransmittance(const std::vector<Hit>& hits) const;

  /// How much ambient light comes to each hit: all, 1, where no surface is in the way.
  std::vector<double> FindAmbientTransmittance(const std::vector<Hit>& hits) const;

private:
  /// In the object space of the field.
  struct OutgoingRay
  {
    Vector3 Origin;
    Vector3 Direction;
    double End;
  };

  /// Another field of the scene.
  struct OtherField
  {
    TracedField* Field;
    Matrix4 OtherFromOwn;
  };

  OutgoingRay MakeLightRay(const Light& light, const Hit& hit) const;
  OutgoingRay MakeOcclusionRay(const Vector3& direction, const Hit& hit) const;
  void FindTransmittanceSorted(const std::vector<OutgoingRay>& rays, const std::vector<Hit>& starts,
    std::vector<double>& transmittance) const;
  void FindTransmittance(
    const OutgoingRay* rays, const Hit* starts, int count, double* transmittance) const;
  void FindTransmittanceOfOthers(const OutgoingRay* rays, int count, double* transmittance) const;

  const Scene& TheScene;
  TracedField& Field;
  Matrix4 WorldFromObject;
  Matrix4 WorldFromGradient;
  std::vector<OtherField> Others;
};

}

#endif
