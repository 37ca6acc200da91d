// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Visibility_h
#define Visibility_h

#include "Math/Vector.h"
#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where Dot(Normal, point) + Offset >= 0.
struct HalfSpace
{
  Vector3 Normal;
  double Offset;
  /// Whether the insides of surfaces are capped at its plane: see Caps.h, and MeshCaps.h.
  bool IsCapped = false;

  bool operator==(const HalfSpace& other) const
  {
    return this->Normal == other.Normal && this->Offset == other.Offset &&
      this->IsCapped == other.IsCapped;
  }
};

enum class RayEnd
{
  Begin,
  End
};

/// How a ray crosses the plane of a half-space.
struct PlaneCrossing
{
  /// Of the crossing; not finite if the ray is parallel to the plane.
  double T;
  /// Dot(Normal, point) + Offset at the origin, and its change with t: positive if the ray enters.
  double Height;
  double Slope;
};

inline PlaneCrossing FindCrossing(
  const HalfSpace& half, const Vector3& origin, const Vector3& direction)
{
  const double height = Dot(half.Normal, origin) + half.Offset;
  const double slope = Dot(half.Normal, direction);
  return { -height / slope, height, slope };
}

/// Two planes across each axis, the lower first, part space into 27 regions.
struct CroppingRegions
{
  std::array<std::array<double, 2>, 3> Planes = {};
  /// Bit i + 3 j + 9 k says whether region (i, j, k) is visible. A border belongs to the region in
  /// the middle.
  unsigned int Visible = All;

  static constexpr unsigned int All = 0x7ffffff;

  bool operator==(const CroppingRegions& other) const
  {
    return this->Planes == other.Planes && this->Visible == other.Visible;
  }

  bool Contain(const Vector3& point) const
  {
    int region = 0;
    int stride = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int interval =
        point[axis] < this->Planes[axis][0] ? 0 : (point[axis] > this->Planes[axis][1] ? 2 : 1);
      region += stride * interval;
      stride *= 3;
    }
    return (this->Visible >> region & 1U) != 0;
  }
};

/// Which parts of a field are visible, in object space. A surface that is cut off hides nothing.
struct Visibility
{
  /// Rays are cut to the intersection of all of them.
  std::vector<HalfSpace> HalfSpaces;
  CroppingRegions Regions;
  /// One for every cell, by its number, not zero where it is not visible; null if all are. They
  /// must not change while they are selected.
  const unsigned char* HiddenCells = nullptr;

  bool operator==(const Visibility& other) const
  {
    return this->HalfSpaces == other.HalfSpaces && this->Regions == other.Regions &&
      this->HiddenCells == other.HiddenCells;
  }

  bool HasCaps() const
  {
    return std::any_of(this->HalfSpaces.begin(), this->HalfSpaces.end(),
      [](const HalfSpace& half) { return half.IsCapped; });
  }

  /// Whether every hit of a ray that is cut is visible.
  bool IsConvex() const
  {
    return this->Regions.Visible == CroppingRegions::All && !this->HiddenCells;
  }

  bool IsHidden(std::int64_t cell) const
  {
    return this->HiddenCells && this->HiddenCells[cell] != 0;
  }

  /// Whether a hit of a ray that is cut is visible, at its point.
  bool Shows(const Hit& hit, const Vector3& point) const
  {
    return this->Regions.Contain(point) && !this->IsHidden(hit.Cell);
  }
};

/// Cuts rays to a half-space. Those that are entirely outside no longer exist.
inline void CutRays(const HalfSpace& half, RayPacket& rays)
{
  for (int i = 0; i < rays.Count; ++i)
  {
    if (!Has(rays.Exists, i))
    {
      continue;
    }
    const PlaneCrossing crossing = FindCrossing(half, rays.GetOrigin(i), rays.GetDirection(i));
    if (crossing.Slope > 0.0)
    {
      rays.Begin[i] = std::max(rays.Begin[i], crossing.T);
    }
    else if (crossing.Slope < 0.0)
    {
      rays.End[i] = std::min(rays.End[i], crossing.T);
    }
    const bool isOutside = crossing.Slope == 0.0 && crossing.Height < 0.0;
    if (isOutside || !(rays.Begin[i] <= rays.End[i]))
    {
      Remove(i, rays.Exists);
    }
  }
}

/// Cuts them to the intersection of half-spaces.
inline void CutRays(const std::vector<HalfSpace>& halves, RayPacket& rays)
{
  for (const HalfSpace& half : halves)
  {
    CutRays(half, rays);
  }
}

}

#endif
