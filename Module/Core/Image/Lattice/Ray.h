// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Ray_h
#define Ray_h

#include "Image/Lattice/UnevenPlanes.h"
#include "Math/Vector.h"
#include "Rays/CellCrossings.h"
#include "Rays/RayPacket.h"

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
  /// One over the direction. Along an axis whose planes the ray is parallel to, it is instead the
  /// coordinate of the cells that the ray stays in. (In a face between cells it stays in those
  /// above; at the border of the volume, in the last ones.)
  Vector3 Inverse;
  /// The sign of the direction; 0 where the ray is parallel to the lattice planes of that axis.
  Index3 Step;
  /// The part of the ray inside the volume, in t counted from Origin. Where cells at the border are
  /// flat, it is longer by the least, so that the ray crosses all of their planes.
  double Begin;
  double End;
  /// The t of Origin on the ray as the caller gave it.
  double Base;
  /// Where the lattice planes stand; null if plane k stands at k.
  const UnevenPlanes* Planes = nullptr;

  /// Where the lattice plane k of an axis stands.
  double GetPlane(std::size_t axis, int k) const
  {
    return this->Planes ? this->Planes->Get(axis, k) : k;
  }

  /// The t at which the ray crosses the lattice plane k of an axis it is not parallel to. Every t
  /// of a crossing comes from here, and never from a running sum: neighbouring cells agree on it to
  /// the last bit, and nothing drifts. Rounding is monotone, so it never falls as k moves with
  /// Step.
  double CrossingT(std::size_t axis, int k) const
  {
    return (this->GetPlane(axis, k) - this->Origin[axis]) * this->Inverse[axis];
  }

  /// The same for the plane in the middle between the lattice planes k and k + 1.
  double MiddleCrossingT(std::size_t axis, int k) const
  {
    const double coordinate =
      this->Planes ? this->Planes->Get(axis, k) + 0.5 * this->Planes->GetWidth(axis, k) : k + 0.5;
    return (coordinate - this->Origin[axis]) * this->Inverse[axis];
  }

  double Coordinate(std::size_t axis, double t) const
  {
    return this->Origin[axis] + t * this->Direction[axis];
  }
};

/// Cuts a ray (index space, tBegin <= t <= tEnd) to the box of a volume's samples. Nothing is
/// returned if it misses, or if the ray is no ray: not finite, or without direction. The planes, if
/// any, must outlive the ray.
std::optional<Ray> ClipToVolume(const Vector3& origin, const Vector3& direction, double tBegin,
  double tEnd, const Index3& dimensions, const UnevenPlanes* planes = nullptr);

/// Puts a ray that is cut to a volume into planes that are not evenly spaced, as SnapToPlanes of
/// ClippedRays.h does into even ones. Its direction along their axes becomes 0.
void SnapToPlanes(const UnevenPlanes& planes, Vector3& origin, Vector3& direction);

/// Appends a ray to a packet that has room for it.
inline void AppendRay(const std::optional<Ray>& ray, RayPacket& packet)
{
  const int index = packet.Count++;
  if (!ray)
  {
    return;
  }
  Add(index, packet.Exists);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    packet.Origin[axis][index] = ray->Origin[axis];
    packet.Direction[axis][index] = ray->Direction[axis];
    packet.Inverse[axis][index] = ray->Inverse[axis];
  }
  packet.Begin[index] = ray->Begin;
  packet.End[index] = ray->End;
  packet.Base[index] = ray->Base;
}

/// A ray of a packet that exists.
inline Ray GetRay(const RayPacket& packet, int index)
{
  Ray ray;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = packet.Origin[axis][index];
    ray.Direction[axis] = packet.Direction[axis][index];
    ray.Inverse[axis] = packet.Inverse[axis][index];
    ray.Step[axis] = ray.Direction[axis] > 0.0 ? 1 : (ray.Direction[axis] < 0.0 ? -1 : 0);
  }
  ray.Begin = packet.Begin[index];
  ray.End = packet.End[index];
  ray.Base = packet.Base[index];
  return ray;
}

}

#endif
