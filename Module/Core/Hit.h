// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Hit_h
#define Hit_h

#include "UnevenPlanes.h"
#include "Vector.h"

namespace vtkIsosurfaceRayTracing
{

/// Where a ray meets an isosurface, or has its extreme value. Everything that is ever said about a
/// hit is derived from this.
struct Hit
{
  /// On the ray as it was given.
  double T;
  Index3 Cell;
  /// Which of the wanted isosurfaces; NoSurface where there is no hit.
  int Surface;
  /// The point in the cell's own coordinates, [0, 1]^3.
  Vector3 Parametric;
  /// Whether the ray goes in there: from below the isovalue to at or above it.
  bool Rising;
  /// The value there, where no surface but an extreme value is looked for.
  double Value = 0.0;

  static constexpr int NoSurface = -1;

  /// Where it is in the space that rays go through: see Ray::Planes.
  Vector3 GetPoint(const UnevenPlanes* planes) const
  {
    if (planes)
    {
      return planes->GetPoint(this->Cell, this->Parametric);
    }
    return { this->Cell[0] + this->Parametric[0], this->Cell[1] + this->Parametric[1],
      this->Cell[2] + this->Parametric[2] };
  }
};

}

#endif
