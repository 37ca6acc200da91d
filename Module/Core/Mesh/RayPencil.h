// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayPencil_h
#define RayPencil_h

#include "Kernels/BeamPieces.h"
#include "Math/Bounds.h"

namespace vtkIsosurfaceRayTracing
{

/// Rays that go one way along an axis, and are between four planes across it. They need not meet,
/// or be parallel, as those of a beam.
class RayPencil
{
public:
  /// Finds the planes around the rays in some consecutive places, which go through a box. Their
  /// frames must have the same axis and sign.
  RayPencil(const LoneRays& rays, int firstPlace, int count, const Bounds& box);

  /// The extent across the axis at a depth.
  double GetWidth(int across, double depth) const
  {
    return this->Ends[across][1].GetPlace(depth) - this->Ends[across][0].GetPlace(depth);
  }

  /// How the pencil comes to boxes.
  PencilThroughBoxes GetBounds() const;

  /// Bounds the groups of the rays in some consecutive places, of which the first begins a group.
  /// Their ends must be set.
  static void BoundGroups(LoneRays& rays, int firstPlace, int count, const Bounds& box);

  /// The same for one ray.
  static PencilThroughBoxes GetBounds(const RayThroughBoxes& ray);

private:
  /// A coordinate that changes with the depth.
  struct Edge
  {
    double AtPlane;
    double Rate;

    double GetPlace(double depth) const { return this->AtPlane + this->Rate * depth; }
  };

  void BoundGroup(LoneRays& rays, int group) const;

  BeamNumbers Frame;
  double Begin;
  /// Of both axes across, the lower and the upper end.
  Edge Ends[2][2];
  Bounds Box;
};

}

#endif
