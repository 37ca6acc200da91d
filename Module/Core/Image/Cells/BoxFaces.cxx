// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/BoxFaces.h"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a ray is in a cell where it crosses a plane between boxes across an axis, in the middle
/// of the cell. By the order of Crossing, so it is in one cell only; a ray is in no cell that it
/// enters where it ends.
bool IsInCell(const Ray& ray, const Index3& cell, const Crossing& crossing)
{
  if (!(crossing.T > ray.Begin && crossing.T <= ray.End))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    if (ray.Step[i] == 0)
    {
      if (ray.Inverse[i] != cell[i])
      {
        return false;
      }
      continue;
    }
    const bool up = ray.Step[i] > 0;
    const Crossing in{ ray.CrossingT(i, cell[i] + (up ? 0 : 1)), axis };
    const Crossing out{ ray.CrossingT(i, cell[i] + (up ? 1 : 0)), axis };
    if (!(in.T < ray.End) || (axis != crossing.Axis && (crossing < in || !(crossing < out))))
    {
      return false;
    }
  }
  return true;
}

/// Calls visit(crossing, from, to) for the up to three faces between boxes that a ray crosses in a
/// cell, in order; the boxes are those of the corners from and to.
template <typename Visit>
void VisitFaces(const Ray& ray, const Index3& cell, const Visit& visit)
{
  Crossing crossings[3];
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    if (ray.Step[i] == 0)
    {
      continue;
    }
    const Crossing crossing = { ray.MiddleCrossingT(i, cell[i]), axis };
    int position = count++;
    for (; position > 0 && crossing < crossings[position - 1]; --position)
    {
      crossings[position] = crossings[position - 1];
    }
    crossings[position] = crossing;
  }
  int corner = FindBox(ray, cell, { -std::numeric_limits<double>::infinity(), 0 });
  for (int i = 0; i < count; ++i)
  {
    const int next = corner ^ (1 << crossings[i].Axis);
    if (IsInCell(ray, cell, crossings[i]))
    {
      visit(crossings[i], corner, next);
    }
    corner = next;
  }
}

}

//------------------------------------------------------------------------------
int FindBox(const Ray& ray, const Index3& cell, const Crossing& at)
{
  int corner = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto i = static_cast<std::size_t>(axis);
    const bool isUpper = ray.Step[i] == 0
      ? PointInCell(ray, cell, 0.0)[i] >= 0.5
      : (Crossing{ ray.MiddleCrossingT(i, cell[i]), axis } < at) == (ray.Step[i] > 0);
    corner |= isUpper ? 1 << axis : 0;
  }
  return corner;
}

//------------------------------------------------------------------------------
void FindFaceHits(const Ray& ray, const Index3& cell, const CellCorners& corners,
  const CellLattice& lattice, const std::vector<Isosurface>& surfaces, std::vector<FaceHit>& hits)
{
  VisitFaces(ray, cell,
    [&](const Crossing& crossing, int from, int to)
    {
      const double before = corners[static_cast<std::size_t>(from)];
      const double behind = corners[static_cast<std::size_t>(to)];
      if (!std::isfinite(before) || !std::isfinite(behind))
      {
        return;
      }
      const auto axis = static_cast<std::size_t>(crossing.Axis);
      Hit hit{ ray.Base + crossing.T, lattice.GetNumber(cell), 0,
        PointInCell(ray, cell, crossing.T), before < behind };
      hit.Parametric[axis] = 0.5;
      hit.Jump = GetJump(crossing.Axis, hit.Entering, ray.Step[axis] > 0);
      const auto count = static_cast<int>(surfaces.size());
      for (int i = 0; i < count; ++i)
      {
        hit.Surface = hit.Entering ? i : count - 1 - i;
        const double isovalue = surfaces[static_cast<std::size_t>(hit.Surface)].Isovalue;
        if ((before < isovalue) != (behind < isovalue))
        {
          hits.push_back({ crossing, ray.Step[axis] * cell[axis], hit });
        }
      }
    });
}

//------------------------------------------------------------------------------
std::int8_t GetJump(int axis, bool isEntering, bool isUp)
{
  const int jump = axis + 1;
  return static_cast<std::int8_t>(isEntering == isUp ? jump : -jump);
}

//------------------------------------------------------------------------------
int GetAxisOfJump(const Hit& hit)
{
  return std::abs(hit.Jump) - 1;
}

//------------------------------------------------------------------------------
Vector3 GetJumpDirection(const Hit& hit)
{
  Vector3 direction = { 0.0, 0.0, 0.0 };
  direction[static_cast<std::size_t>(GetAxisOfJump(hit))] = hit.Jump > 0 ? 1.0 : -1.0;
  return direction;
}

}
