// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LineFrustum_h
#define LineFrustum_h

#include "Math/Bounds.h"
#include "Rays/BoxGroup.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// What the rays between four lines may meet, of which opposite ones are the first and the last:
/// the space between four planes. The lines pass through one point or are parallel.
class LineFrustum
{
public:
  /// Of the lines only the origins and the directions are needed. All boxes that it is asked about
  /// must lie in the box around them.
  LineFrustum(const RayPacket& lines, const Bounds& around)
  {
    constexpr std::array<std::array<int, 4>, 4> sides = { { { 0, 1, 2, 3 }, { 1, 3, 0, 2 },
      { 3, 2, 1, 0 }, { 2, 0, 3, 1 } } };
    for (const std::array<int, 4>& side : sides)
    {
      this->AddSide(lines, side, around);
    }
    this->FindDepth(lines);
  }

  /// Whether a ray may meet a box. Some boxes outside are taken for met.
  bool MayMeet(const Bounds& box) const
  {
    const double* const ends[2] = { box.Lower.data(), box.Upper.data() };
    for (int i = 0; i < this->SideCount; ++i)
    {
      const FrustumSide& side = this->Sides[i];
      const double highest = side.Normal[0] * ends[side.IsUpperHigher[0]][0] +
        side.Normal[1] * ends[side.IsUpperHigher[1]][1] +
        side.Normal[2] * ends[side.IsUpperHigher[2]][2];
      if (highest + side.Offset < 0.0)
      {
        return false;
      }
    }
    return true;
  }

  /// Its planes: a box is met if it reaches above all.
  const FrustumSide* GetSides() const { return this->Sides; }
  int GetNumberOfSides() const { return this->SideCount; }

  /// A T that no ray comes to a box before.
  double FindNear(const Bounds& box) const
  {
    if (!this->HasDepth)
    {
      return -std::numeric_limits<double>::infinity();
    }
    double near = this->Depth.Offset;
    double size = std::abs(near);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double low = this->Depth.Slope[axis] * box.Lower[axis];
      const double high = this->Depth.Slope[axis] * box.Upper[axis];
      near += std::min(low, high);
      size += std::max(std::abs(low), std::abs(high));
    }
    return near - Slack * size - DepthTolerance * (1.0 + std::abs(near));
  }

private:
  /// More than the rounding of lines and planes.
  static constexpr double Slack = 1e-9;
  /// By how much the T of rays may differ in a plane.
  static constexpr double DepthTolerance = 1e-6;

  /// Adds the plane through two lines that are neighbours. Of lines that coincide there is none.
  void AddSide(const RayPacket& lines, const std::array<int, 4>& side, const Bounds& around)
  {
    const Vector3 origin = lines.GetOrigin(side[0]);
    const Vector3 direction = Normalized(lines.GetDirection(side[0]));
    const Vector3 other = Normalized(lines.GetDirection(side[1]));
    const Vector3 step = Normalized(lines.GetOrigin(side[1]) - origin);
    const Vector3 ofOrigins = Cross(direction + other, step);
    const Vector3 ofDirections = Cross(direction, other);
    Vector3 normal = Length(ofOrigins) >= Length(ofDirections) ? ofOrigins : ofDirections;
    if (!(Length(normal) > Slack))
    {
      return;
    }
    normal = Normalized(normal);
    // Where the lines cross on their way, they have no inside.
    bool isAbove = true;
    bool isBelow = true;
    for (const int opposite : { side[2], side[3] })
    {
      for (const double height : { Dot(normal, lines.GetOrigin(opposite) - origin),
             Dot(normal, lines.GetDirection(opposite)) })
      {
        isAbove = isAbove && height >= 0.0;
        isBelow = isBelow && height <= 0.0;
      }
    }
    if (isAbove == isBelow)
    {
      return;
    }
    normal = isAbove ? normal : normal * -1.0;
    FrustumSide& added = this->Sides[this->SideCount++];
    added.Offset = -Dot(normal, origin);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      added.Normal[axis] = normal[axis];
      added.IsUpperHigher[axis] = normal[axis] >= 0.0;
      added.Offset += Slack * std::abs(normal[axis]) *
        (std::abs(around.Lower[axis] - origin[axis]) + std::abs(around.Upper[axis] - origin[axis]));
    }
  }

  /// The T of points on the rays: those of a camera have a common one in planes across the view.
  void FindDepth(const RayPacket& lines)
  {
    const Vector3 origin = lines.GetOrigin(0);
    const Vector3 normal = Cross(lines.GetOrigin(1) - origin, lines.GetOrigin(2) - origin);
    const double rise = Dot(normal, lines.GetDirection(0));
    this->Depth.Slope = normal * (1.0 / rise);
    this->Depth.Offset = -Dot(this->Depth.Slope, origin);
    this->HasDepth = std::isfinite(Length(this->Depth.Slope));
    for (int i = 0; i < lines.Count; ++i)
    {
      const double atBegin = Dot(this->Depth.Slope, lines.GetOrigin(i) - origin);
      const double change = Dot(this->Depth.Slope, lines.GetDirection(i));
      this->HasDepth = this->HasDepth && std::abs(change - 1.0) <= DepthTolerance &&
        std::abs(atBegin) <= DepthTolerance;
    }
  }

  FrustumSide Sides[4];
  int SideCount = 0;
  /// T is the product with a point, and the offset.
  struct
  {
    Vector3 Slope;
    double Offset;
  } Depth;
  bool HasDepth = false;
};

}

#endif
