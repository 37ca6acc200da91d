// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Ray_h
#define Ray_h

#include "Math/Vector.h"
#include "Rays/RayPacket.h"
#include "Rays/UnevenPlanes.h"

#include <optional>

namespace vtkIsosurfaceRayTracing
{

/// A ray in index space, where samples stand at whole numbers, cut to a volume. Where samples are
/// not evenly spaced, they stand in the UnevenPlanes instead, and the same is said of these.
///
/// The origin of the ray may be far away (1e9 cells), where a double resolves no small fraction of
/// a cell. So the ray is given a new origin near its entry into the volume, and all arithmetic is
/// done with the distance from there.
struct Ray
{
  Vector3 Origin;
  /// In cells (uneven: cells of mean size) per unit of t.
  Vector3 Direction;
  /// One over the direction. Where the ray is parallel to the planes of an axis there is no such
  /// number; there it is the place of the cells along the axis that the ray stays in. (In a face
  /// between cells it stays in those above; at the border of the volume, in the last ones.)
  Vector3 Inverse;
  /// The sign of the direction; 0 where the ray is parallel to the lattice planes of that axis.
  Index3 Step;
  /// The part of the ray inside the volume, in t counted from Origin.
  double Begin;
  double End;
  /// The t of Origin on the ray as the caller gave it.
  double Base;
  /// Where the lattice planes stand; null if plane k stands at k.
  const UnevenPlanes* Planes = nullptr;

  /// The t at which the ray crosses the lattice plane k of an axis it is not parallel to. Every t
  /// of a crossing comes from here, and never from a running sum: neighbouring cells agree on it to
  /// the last bit, and nothing drifts. Rounding is monotone, so it never falls as k moves with
  /// Step.
  double CrossingT(std::size_t axis, int k) const
  {
    return this->CrossingTAt(axis, this->Planes ? this->Planes->Get(axis, k) : k);
  }

  /// The same for the plane at a place.
  double CrossingTAt(std::size_t axis, double place) const
  {
    return (place - this->Origin[axis]) * this->Inverse[axis];
  }

  /// The same for the plane in the middle between the lattice planes k and k + 1.
  double MiddleCrossingT(std::size_t axis, int k) const
  {
    const double place =
      this->Planes ? this->Planes->Get(axis, k) + 0.5 * this->Planes->GetWidth(axis, k) : k + 0.5;
    return (place - this->Origin[axis]) * this->Inverse[axis];
  }

  double Coordinate(std::size_t axis, double t) const
  {
    return this->Origin[axis] + t * this->Direction[axis];
  }
};

/// A place on a ray: every plane whose crossing comes before it, or is it, has been crossed.
///
/// Planes crossed at the same t (the ray meets an edge or a vertex) are crossed in the order x, y,
/// z. So every ray has one sequence of cells, in which neighbours share a face, and every cell of
/// it can be recognised without knowing the others.
struct Crossing
{
  double T;
  /// The axis of the plane crossed; StartAxis where the place is no crossing but a mere t.
  int Axis;

  static constexpr int StartAxis = 3;

  bool operator<(const Crossing& other) const
  {
    return this->T < other.T || (this->T == other.T && this->Axis < other.Axis);
  }
};

/// Cuts a ray (index space, tBegin <= t <= tEnd) to the box of a volume's samples. Nothing is
/// returned if it misses, or if the ray is no ray: not finite, or without direction. The planes, if
/// any, must outlive the ray.
std::optional<Ray> ClipToVolume(const Vector3& origin, const Vector3& direction, double tBegin,
  double tEnd, const Index3& dimensions, const UnevenPlanes* planes = nullptr);

/// Puts a ray at the end of a packet that has room for it.
inline void AddRay(const std::optional<Ray>& ray, RayPacket& packet)
{
  const int place = packet.Count++;
  if (!ray)
  {
    return;
  }
  Add(place, packet.Exists);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    packet.Origin[axis][place] = ray->Origin[axis];
    packet.Direction[axis][place] = ray->Direction[axis];
    packet.Inverse[axis][place] = ray->Inverse[axis];
  }
  packet.Begin[place] = ray->Begin;
  packet.End[place] = ray->End;
  packet.Base[place] = ray->Base;
}

/// A ray of a packet that exists.
inline Ray GetRay(const RayPacket& packet, int place)
{
  Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = packet.Origin[axis][place];
    ray.Direction[axis] = packet.Direction[axis][place];
    ray.Inverse[axis] = packet.Inverse[axis][place];
    ray.Step[axis] = ray.Direction[axis] > 0.0 ? 1 : (ray.Direction[axis] < 0.0 ? -1 : 0);
  }
  ray.Begin = packet.Begin[place];
  ray.End = packet.End[place];
  ray.Base = packet.Base[place];
  return ray;
}

}

#endif
