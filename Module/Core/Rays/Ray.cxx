// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Rays/Ray.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Narrows [Begin, End] to the slabs of the box. An axis the ray is parallel to only asks whether
/// the ray lies within; a ray in a face counts as within.
bool ClipToSlabs(Ray& ray, const Index3& dimensions)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = dimensions[axis] - 1;
    if (ray.Step[axis] == 0)
    {
      if (!(ray.Origin[axis] >= 0.0 && ray.Origin[axis] <= last))
      {
        return false;
      }
      continue;
    }
    ray.Begin = std::max(ray.Begin, ray.CrossingT(axis, ray.Step[axis] > 0 ? 0 : last));
    ray.End = std::min(ray.End, ray.CrossingT(axis, ray.Step[axis] > 0 ? last : 0));
  }
  return ray.Begin <= ray.End;
}

}

std::optional<Ray> ClipToVolume(const Vector3& origin, const Vector3& direction, double tBegin,
  double tEnd, const Index3& dimensions, const UnevenPlanes* planes)
{
  Ray ray;
  ray.Origin = origin;
  ray.Direction = direction;
  ray.Planes = planes;
  bool isRay = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(origin[axis]) || !std::isfinite(direction[axis]))
    {
      return std::nullopt;
    }
    // A component so small that its inverse is infinite does not move the ray across any volume.
    ray.Inverse[axis] = 1.0 / direction[axis];
    const bool parallel = !std::isfinite(ray.Inverse[axis]);
    ray.Step[axis] = parallel ? 0 : direction[axis] > 0.0 ? 1 : -1;
    ray.Direction[axis] = parallel ? 0.0 : direction[axis];
    isRay = isRay || !parallel;
  }
  ray.Begin = tBegin;
  ray.End = tEnd;
  if (!isRay || !ClipToSlabs(ray, dimensions))
  {
    return std::nullopt;
  }

  // The new origin lies on the ray to the last bit of its own, small, coordinates: fma rounds once.
  ray.Base = ray.Begin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    ray.Origin[axis] = std::fma(ray.Base, ray.Direction[axis], origin[axis]);
  }
  ray.Begin = tBegin - ray.Base;
  ray.End = tEnd - ray.Base;
  if (!ClipToSlabs(ray, dimensions))
  {
    return std::nullopt;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (ray.Step[axis] == 0)
    {
      const double last = dimensions[axis] - 2;
      ray.Inverse[axis] = planes ? planes->FindCell(axis, ray.Origin[axis])
                                 : std::min(std::floor(ray.Origin[axis]), last);
    }
  }
  return ray;
}

}
