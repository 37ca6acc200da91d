// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Lattice/Ray.h"

#include "Rays/ClippedRays.h"

#include <cmath>

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
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = clipped.Origin[axis];
    ray.Direction[axis] = clipped.Direction[axis];
    ray.Inverse[axis] = clipped.Inverse[axis];
    ray.Step[axis] = clipped.Parallel[axis] ? 0 : (clipped.Up[axis] ? 1 : -1);
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
