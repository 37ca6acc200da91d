// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Lattice/Ray.h"

#include "Rays/ClippedRays.h"

namespace vtkIsosurfaceRayTracing
{

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
  return ray;
}

}
