// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Departure_h
#define Departure_h

#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Where a secondary ray starts: on a surface, which must not shadow itself.
struct Departure
{
  /// Hit::NoSurface for a ray that starts on no surface of the field.
  int Surface = Hit::NoSurface;
  /// Whether the ray leaves towards the inside of the surface.
  bool Entering = false;
  /// In a set of fields, the member that has the surface.
  int Member = 0;
  /// The cell that it starts in; negative if it starts on no surface.
  std::int64_t Cell = -1;

  /// Whether a crossing of a surface may be the one that the ray starts on.
  bool Is(int surface, bool entering) const
  {
    return surface == this->Surface && entering == this->Entering;
  }
};

/// Which rays of a packet are stopped by crossings other than those that they start on.
struct StoppedRays
{
  RaySet Stopped = {};
  /// Those with a crossing so near to their start that its rounding matters: only the order of all
  /// crossings decides what it is.
  RaySet Unsure = {};

  /// In cells, or other units that objects have a size of about one in.
  static constexpr double NearStart = 1e-4;

  /// Adds a crossing that is not the one the ray starts on, at a distance from the start in the
  /// unit of NearStart.
  void AddCrossing(int ray, double distance)
  {
    Add(ray, distance < NearStart ? this->Unsure : this->Stopped);
  }
};

}

#endif
