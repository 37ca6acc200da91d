// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellSegment_h
#define CellSegment_h

#include "Ray.h"

#include <algorithm>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// The part of a ray inside one cell, with its two ends in the cell's own coordinates, [0, 1]^3.
struct CellSegment
{
  double Begin;
  double End;
  /// The axis of the plane crossed at Begin; see Place.
  int BeginAxis;
  Vector3 Entry;
  Vector3 Exit;
};

/// Where the ray is in the cell at t. On the plane it crosses there, the coordinate is exactly 0 or
/// 1: the two cells that share the face then interpolate between the same four samples with the
/// same weights, and agree on the sign of every point of it to the last bit. No ray slips between
/// them.
inline Vector3 PointInCell(const Ray& ray, const Index3& cell, const Place& place)
{
  Vector3 p;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    p[axis] = std::min(1.0, std::max(0.0, ray.CoordinateInCell(axis, cell[axis], place.T)));
  }
  return p;
}

/// The segment of a ray in a cell, computed from the planes of the cell alone. Returns false if the
/// cell is not among those the ray passes. However the cell was found, the answer is the same.
inline bool SegmentInCell(const Ray& ray, const Index3& cell, CellSegment& segment)
{
  Place entry{ -std::numeric_limits<double>::infinity(), 0 };
  Place exit{ std::numeric_limits<double>::infinity(), Place::StartAxis };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (ray.Step[axis] == 0)
    {
      if (ray.Inverse[axis] != cell[axis])
      {
        return false;
      }
      continue;
    }
    const bool up = ray.Step[axis] > 0;
    const Place in{ ray.Crossing(axis, cell[axis] + (up ? 0 : 1)), static_cast<int>(axis) };
    const Place out{ ray.Crossing(axis, cell[axis] + (up ? 1 : 0)), static_cast<int>(axis) };
    entry = std::max(entry, in);
    exit = std::min(exit, out);
  }

  // Where the ray begins or ends within the cell, no plane is crossed there.
  const bool entersThroughFace = entry.T >= ray.Begin;
  const bool leavesThroughFace = exit.T <= ray.End;
  const Place begin = entersThroughFace ? entry : Place{ ray.Begin, Place::StartAxis };
  const Place end = leavesThroughFace ? exit : Place{ ray.End, Place::StartAxis };
  // A flat cell is passed at one place.
  const bool isFlat = ray.Planes && entersThroughFace && leavesThroughFace && entry.T == exit.T &&
    entry.Axis == exit.Axis;
  if (!(begin < end || isFlat) || !(exit.T > ray.Begin) || !(entry.T < ray.End))
  {
    return false;
  }

  segment.Begin = begin.T;
  segment.BeginAxis = begin.Axis;
  segment.End = end.T;
  segment.Entry = PointInCell(ray, cell, begin);
  segment.Exit = PointInCell(ray, cell, end);
  if (entersThroughFace)
  {
    const auto axis = static_cast<std::size_t>(entry.Axis);
    segment.Entry[axis] = ray.Step[axis] > 0 ? 0.0 : 1.0;
  }
  if (leavesThroughFace)
  {
    const auto axis = static_cast<std::size_t>(exit.Axis);
    segment.Exit[axis] = ray.Step[axis] > 0 ? 1.0 : 0.0;
  }
  return true;
}

}

#endif
