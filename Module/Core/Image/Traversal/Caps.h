// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Caps_h
#define Caps_h

#include "Image/Traversal/CellTraversal.h"
#include "Rays/Visibility.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

// A cap closes the inside of a surface where a half-space cuts it open. A ray meets one where it
// is cut: at its begin, its end, or both. Whether it is inside there is asked in the cell where its
// cut part begins (or ends), of the very value that the solvers start from (or come to). So the
// signs chain from the cap to the hits: a ray that begins with a cap leaves the surface next, one
// that does not enters it. There is no crack between cap and surface.

namespace vtkIsosurfaceRayTracing
{

enum class RayEnd
{
  Begin,
  End
};

/// In cells. Planes that are so near to each other coincide: what is seen in them is not left to
/// rounding.
constexpr double PlaneThickness = 1e-6;

/// Whether a ray begins where it enters the box of all cells, or ends where it leaves it.
inline bool IsAtBorder(const Ray& ray, RayEnd end, const Index3& cells)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool isAtFirst = (ray.Step[axis] > 0) == (end == RayEnd::Begin);
    if (ray.Step[axis] != 0 &&
      ray.CrossingT(axis, isAtFirst ? 0 : cells[axis]) ==
        (end == RayEnd::Begin ? ray.Begin : ray.End))
    {
      return true;
    }
  }
  return false;
}

/// The half-space with caps in whose plane a ray begins or ends that is cut to all of them;
/// Hit::NoPlane if there is none. A plane may coincide with a face of the volume, as those of a box
/// around it do.
inline int FindCappedPlane(
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

/// The first or the last of the cells that a ray passes, and the place of the ray's end in it.
struct EndCell
{
  Index3 Cell;
  Crossing At;
};

inline EndCell FindEndCell(const Ray& ray, RayEnd end, const Index3& cells)
{
  // Of planes that are crossed right there, those at the begin are behind the ray, and those at the
  // end before it.
  constexpr int beforeAllAxes = -1;
  const Crossing start = end == RayEnd::Begin ? Crossing{ ray.Begin, Crossing::StartAxis }
                                              : Crossing{ ray.End, beforeAllAxes };
  const LatticeTraversal walk(ray, 1, { 0, 0, 0 }, cells, start);
  const Crossing last = std::min(Crossing{ ray.End, Crossing::StartAxis }, walk.GetExit());
  return { walk.GetBlock(), end == RayEnd::Begin ? start : last };
}

/// Moves the end of a ray, in the plane of a half-space, over planes between cells, or between
/// boxes of samples (see BoxFaces.h), that coincide with it: the cells and the boxes seen there are
/// those that the half-space leaves.
inline void StepOverPlanes(Ray& ray, RayEnd end, const Index3& cells, bool areBoxes)
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

#endif
