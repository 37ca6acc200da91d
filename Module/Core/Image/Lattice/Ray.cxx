// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Lattice/Ray.h"

#include "Rays/ClippedRays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Moves the ends of a ray out of flat cells at the border, if it comes from before them and goes
/// on behind them.
void LeaveFlatBorders(const Index3& dimensions, double tBegin, double tEnd, Ray& ray)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (ray.Step[axis] == 0)
    {
      continue;
    }
    const bool isUp = ray.Step[axis] > 0;
    const int last = dimensions[axis] - 2;
    const auto isFlat = [&ray, axis](int cell)
    { return !(ray.Planes->GetWidth(axis, cell) > 0.0); };
    const double in = ray.CrossingT(axis, isUp ? 0 : last + 1);
    if (isFlat(isUp ? 0 : last) && in == ray.Begin && tBegin - ray.Base < in)
    {
      ray.Begin = std::nextafter(in, -Infinity);
    }
    const double out = ray.CrossingT(axis, isUp ? last + 1 : 0);
    if (isFlat(isUp ? last : 0) && out == ray.End && out < tEnd - ray.Base)
    {
      ray.End = std::nextafter(out, Infinity);
    }
  }
}

}

//------------------------------------------------------------------------------
void SnapToPlanes(const UnevenPlanes& planes, Vector3& origin, Vector3& direction)
{
  const double length = std::abs(direction[0]) + std::abs(direction[1]) + std::abs(direction[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (std::abs(direction[axis]) <= NegligibleOffPlane * length)
    {
      const int cell = planes.FindCell(axis, origin[axis]);
      const double lower = planes.Get(axis, cell);
      const double upper = planes.Get(axis, cell + 1);
      const double plane = origin[axis] - lower < upper - origin[axis] ? lower : upper;
      // Planes stand between 0 and the number of the last one, which is not far below this.
      const double reach = 3.0 * planes.Get(axis, std::numeric_limits<int>::max());
      if (std::abs(origin[axis] - plane) <= NegligibleOffPlane * reach)
      {
        origin[axis] = plane;
        direction[axis] = 0.0;
      }
    }
  }
}

//------------------------------------------------------------------------------
std::optional<Ray> ClipToVolume(const Vector3& origin, const Vector3& direction, double tBegin,
  double tEnd, const Index3& dimensions, const UnevenPlanes* planes)
{
  ClippedRays<double> clipped;
  double lastPlanes[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    clipped.Origin[axis] = origin[axis];
    clipped.Direction[axis] = direction[axis];
    const int last = dimensions[axis] - 1;
    lastPlanes[axis] = planes ? planes->Get(axis, last) : last;
  }
  clipped.Begin = tBegin;
  clipped.End = tEnd;
  if (!ClipToVolume(dimensions.data(), lastPlanes, clipped))
  {
    return std::nullopt;
  }
  Ray ray;
  std::copy_n(clipped.Origin, 3, ray.Origin.begin());
  std::copy_n(clipped.Direction, 3, ray.Direction.begin());
  if (planes)
  {
    SnapToPlanes(*planes, ray.Origin, ray.Direction);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Inverse[axis] = clipped.Inverse[axis];
    ray.Step[axis] = ray.Direction[axis] == 0.0 ? 0 : (clipped.Up[axis] ? 1 : -1);
    if (planes && ray.Step[axis] == 0)
    {
      ray.Inverse[axis] = planes->FindCell(axis, ray.Origin[axis]);
    }
  }
  ray.Begin = clipped.Begin;
  ray.End = clipped.End;
  ray.Base = clipped.Base;
  ray.Planes = planes;
  if (planes)
  {
    LeaveFlatBorders(dimensions, tBegin, tEnd, ray);
  }
  return ray;
}

}
