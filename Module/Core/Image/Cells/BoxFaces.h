// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxFaces_h
#define BoxFaces_h

#include "Image/Cells/CellSegment.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "Image/TracedVolume.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

// Interpolant::Nearest: every sample is a box of one value, which ends half way to the next sample,
// and surfaces are the faces between boxes. A face lies in the middle of four cells, so the cells
// that a ray passes are those where it may cross faces, and a cell that it crosses one in has
// corners on both sides.

namespace vtkIsosurfaceRayTracing
{

/// Whether a ray is in a cell where it crosses a plane between boxes across an axis, in the middle
/// of the cell. By the order of Crossing, so it is in one cell only.
inline bool IsInCell(const Ray& ray, const Index3& cell, const Crossing& crossing)
{
  if (!(crossing.T > ray.Begin && crossing.T <= ray.End))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    if (ray.Step[i] == 0 || axis == crossing.Axis)
    {
      continue;
    }
    const bool up = ray.Step[i] > 0;
    const Crossing in{ ray.CrossingT(i, cell[i] + (up ? 0 : 1)), axis };
    const Crossing out{ ray.CrossingT(i, cell[i] + (up ? 1 : 0)), axis };
    if (crossing < in || !(crossing < out))
    {
      return false;
    }
  }
  return true;
}

/// The corner of a cell in whose box a ray is at a place, which is in the cell or before it. A ray
/// that lies in a plane between boxes stays in those above.
inline int FindBox(const Ray& ray, const Index3& cell, const Crossing& place)
{
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    const bool isUpper = ray.Step[i] == 0
      ? PointInCell(ray, GetBox(cell, ray.Planes), { 0.0, Crossing::StartAxis })[i] >= 0.5
      : (Crossing{ ray.MiddleCrossingT(i, cell[i]), axis } < place) == (ray.Step[i] > 0);
    corner |= isUpper ? 1 << axis : 0;
  }
  return corner;
}

/// Calls visit(crossing, from, to) for the up to three faces between boxes that a ray crosses in a
/// cell, in order, until visit returns true; the boxes are those of the corners from and to.
/// Returns whether it did.
template <typename Visit>
bool VisitFaces(const Ray& ray, const Index3& cell, const Visit& visit)
{
  Crossing crossings[3];
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    if (ray.Step[i] != 0)
    {
      crossings[count++] = { ray.MiddleCrossingT(i, cell[i]), axis };
    }
  }
  std::sort(crossings, crossings + count);
  int corner = FindBox(ray, cell, { -std::numeric_limits<double>::infinity(), 0 });
  for (int i = 0; i < count; ++i)
  {
    const int next = corner ^ (1 << crossings[i].Axis);
    if (IsInCell(ray, cell, crossings[i]) && visit(crossings[i], corner, next))
    {
      return true;
    }
    corner = next;
  }
  return false;
}

/// Calls visit(hit) for the hits of a ray in a cell with those of the faces between boxes that are
/// surfaces, in order, until visit returns true. Returns whether it did. Where a face is several
/// surfaces, a ray that goes in meets the smaller isovalue first, and a ray that goes out the
/// larger one. Beside a box of no finite value there is no surface.
template <typename Value, typename Visit>
bool VisitFaceHits(const Ray& ray, const Index3& cell, const Value corners[8],
  const std::vector<Isosurface>& surfaces, const Visit& visit)
{
  ValueRange<Value> range;
  for (int corner = 0; corner < 8; ++corner)
  {
    range.Include(corners[corner], corners[corner]);
  }
  if (std::none_of(surfaces.begin(), surfaces.end(),
        [&range](const Isosurface& surface) { return range.Straddles(surface.Isovalue); }))
  {
    return false;
  }
  return VisitFaces(ray, cell,
    [&](const Crossing& crossing, int from, int to)
    {
      const auto before = static_cast<double>(corners[from]);
      const auto behind = static_cast<double>(corners[to]);
      if (!std::isfinite(before) || !std::isfinite(behind))
      {
        return false;
      }
      const auto axis = static_cast<std::size_t>(crossing.Axis);
      Hit hit{ ray.Base + crossing.T, cell, 0, PointInCell(ray, GetBox(cell, ray.Planes), crossing),
        before < behind };
      hit.Parametric[axis] = 0.5;
      hit.Jump = hit.Entering == (ray.Step[axis] > 0) ? crossing.Axis + 1 : -crossing.Axis - 1;
      const auto count = static_cast<int>(surfaces.size());
      for (int i = 0; i < count; ++i)
      {
        hit.Surface = hit.Entering ? i : count - 1 - i;
        const double isovalue = surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
        const bool isSurface = (before < isovalue) != (behind < isovalue);
        if (isSurface && visit(hit))
        {
          return true;
        }
      }
      return false;
    });
}

/// The direction in which values rise at a hit with a face, of length one.
inline Vector3 GetJumpDirection(const Hit& hit)
{
  Vector3 direction = { 0.0, 0.0, 0.0 };
  direction[static_cast<std::size_t>(std::abs(hit.Jump) - 1)] = hit.Jump > 0 ? 1.0 : -1.0;
  return direction;
}

}

#endif
