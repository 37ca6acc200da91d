// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Hit_h
#define Hit_h

#include "Math/Vector.h"

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Where a ray meets an isosurface, or has its extreme value. All other properties of a hit are
/// derived from these.
struct Hit
{
  /// On the ray as it was given; the same in every object space.
  double T;
  /// The number of the cell in its field.
  std::int64_t Cell;
  /// Which of the requested isosurfaces; NoSurface where there is no hit.
  int Surface;
  /// The point in the cell's own coordinates, [0, 1]^3.
  Vector3 Parametric;
  /// Whether the ray enters the surface there: goes from below the isovalue to at or above it.
  bool Entering;
  /// Where values jump from the box of one sample to that of the next (see BoxFaces.h): 1, 2, 3 if
  /// they rise along x, y, z, and -1, -2, -3 if they fall. 0 on a surface of the interpolant.
  std::int8_t Jump = 0;
  /// Which of the fields of a scene.
  int Field = 0;
  /// Which of the members of its field, if that is a set of fields.
  int Member = 0;
  /// Of a cap, the half-space that it closes: see Visibility. The surface is the one whose inside
  /// it shows.
  int Plane = NoPlane;
  /// The value of the field, of a projection and of a cap; isosurfaces have their isovalue.
  double Value = 0.0;

  static constexpr int NoSurface = -1;
  static constexpr int NoPlane = -1;

  /// Whether values fall along an axis from the box of one sample to that of the next.
  bool FallsAlong(std::size_t axis) const { return this->Jump == -1 - static_cast<int>(axis); }

  /// Whether the upper of the two samples along an axis of the cell is nearer. Of the boxes on both
  /// sides of a hit, it is the one inside.
  bool IsNearUpper(std::size_t axis) const
  {
    return this->Parametric[axis] >= 0.5 && !this->FallsAlong(axis);
  }
};

}

#endif
