// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Traversal/Caps.h"

#include "Image/Traversal/CellTraversal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// In cells. Planes that are so near to each other coincide: rounding must not decide what is
/// visible in them.
constexpr double PlaneThickness = 1e-6;

/// Whether a ray begins where it enters the box of all cells, or ends where it leaves it: or just
/// outside of flat cells there.
bool IsAtBorder(const Ray& ray, RayEnd end, const Index3& cells)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (ray.Step[axis] == 0)
    {
      continue;
    }
    const bool isAtFirst = (ray.Step[axis] > 0) == (end == RayEnd::Begin);
    const double border = ray.CrossingT(axis, isAtFirst ? 0 : cells[axis]);
    if (end == RayEnd::Begin ? border >= ray.Begin : border <= ray.End)
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
int FindCappedPlane(
  const Ray& ray, RayEnd end, const std::vector<HalfSpace>& halves, const Index3& cells)
{
  const double t = end == RayEnd::Begin ? ray.Begin : ray.End;
  const bool isAtBorder = IsAtBorder(ray, end, cells);
  for (std::size_t i = 0; i < halves.size(); ++i)
  {
    const PlaneCrossing crossing = FindCrossing(halves[i], ray.Origin, ray.Direction);
    const bool goesThrough = end == RayEnd::Begin ? crossing.Slope > 0.0 : crossing.Slope < 0.0;
    const bool isInBorder = isAtBorder &&
      std::abs(crossing.Height + t * crossing.Slope) <= PlaneThickness * Length(halves[i].Normal);
    if (halves[i].IsCapped && goesThrough && (crossing.T == t || isInBorder))
    {
      return static_cast<int>(i);
    }
  }
  return Hit::NoPlane;
}

//------------------------------------------------------------------------------
EndCell FindEndCell(const Ray& ray, RayEnd end, const Index3& cells)
{
  // Of planes that are crossed at the same t, those at the begin are behind the ray, and those at
  // the end before it.
  constexpr int beforeAllAxes = -1;
  const Crossing start = end == RayEnd::Begin ? Crossing{ ray.Begin, Crossing::StartAxis }
                                              : Crossing{ ray.End, beforeAllAxes };
  const LatticeTraversal traversal(ray, 1, { 0, 0, 0 }, cells, start);
  const Crossing last = std::min(Crossing{ ray.End, Crossing::StartAxis }, traversal.GetExit());
  return { traversal.GetBlock(), end == RayEnd::Begin ? start : last };
}

//------------------------------------------------------------------------------
void StepOverPlanes(Ray& ray, RayEnd end, const Index3& cells, bool areBoxes)
{
  const Index3 cell = FindEndCell(ray, end, cells).Cell;
  const double t = end == RayEnd::Begin ? ray.Begin : ray.End;
  const auto coincides = [t, unit = Length(ray.Direction)](double crossing)
  { return std::abs(crossing - t) * unit <= PlaneThickness; };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (ray.Step[axis] == 0)
    {
      continue;
    }
    const bool isUpper = (ray.Step[axis] > 0) == (end == RayEnd::Begin);
    const double between = ray.CrossingT(axis, cell[axis] + (isUpper ? 1 : 0));
    const double middle = ray.MiddleCrossingT(axis, cell[axis]);
    if (end == RayEnd::Begin)
    {
      ray.Begin = coincides(between) ? std::max(ray.Begin, between) : ray.Begin;
      ray.Begin = areBoxes && coincides(middle) ? std::max(ray.Begin, middle) : ray.Begin;
    }
    else
    {
      // Cells end before what is crossed at the end, boxes do not.
      const double before = std::nextafter(middle, -std::numeric_limits<double>::infinity());
      ray.End = coincides(between) ? std::min(ray.End, between) : ray.End;
      ray.End = areBoxes && coincides(middle) ? std::min(ray.End, before) : ray.End;
    }
  }
}

}
