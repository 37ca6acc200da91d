// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellSegment_h
#define CellSegment_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Lattice/Ray.h"
#include "Math/TrilinearCell.h"
#include "Rays/CellCrossings.h"
#include "Rays/Hit.h"

namespace vtkIsosurfaceRayTracing
{

/// The part of a ray inside one cell, with its two ends in the cell's own coordinates, [0, 1]^3.
struct CellSegment
{
  double Begin;
  double End;
  /// The axis of the plane crossed at Begin; see Crossing.
  int BeginAxis;
  Vector3 Entry;
  Vector3 Exit;
};

/// The planes of a cell.
struct CellBox
{
  Vector3 Lower;
  Vector3 Upper;
};

inline CellBox GetBox(const Index3& cell, const UnevenPlanes* planes)
{
  CellBox box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Lower[axis] = planes ? planes->Get(axis, cell[axis]) : cell[axis];
    box.Upper[axis] = planes ? planes->Get(axis, cell[axis] + 1) : cell[axis] + 1;
  }
  return box;
}

/// The point of the ray at t in the cell. On the plane it crosses there, the coordinate is exactly
/// 0 or 1: the two cells that share the face then interpolate between the same four samples with
/// the same weights, and agree on the sign of every point of it to the last bit. No ray slips
/// between them.
inline Vector3 PointInCell(const Ray& ray, const CellBox& box, const Crossing& crossing)
{
  Vector3 p;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double above = ray.Coordinate(axis, crossing.T) - box.Lower[axis];
    const double share = ray.Planes ? above / (box.Upper[axis] - box.Lower[axis]) : above;
    p[axis] = ClampToCell(share);
  }
  return p;
}

/// The segment of a ray in a cell, computed from the planes of the cell alone. Returns false if the
/// ray does not pass the cell. The result does not depend on how the cell was found.
inline bool SegmentInCell(const Ray& ray, const Index3& cell, CellSegment& segment)
{
  const CellBox box = GetBox(cell, ray.Planes);
  CellCrossings<double> crossings;
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
    const double in = ray.CrossingTAt(axis, up ? box.Lower[axis] : box.Upper[axis]);
    const double out = ray.CrossingTAt(axis, up ? box.Upper[axis] : box.Lower[axis]);
    crossings.Narrow(static_cast<int>(axis), true, in, out);
  }
  if (!crossings.CutToRay(ray.Begin, ray.End, ray.Planes != nullptr))
  {
    return false;
  }

  const Crossing begin{ crossings.Begin, static_cast<int>(crossings.BeginAxis) };
  const Crossing end{ crossings.End, static_cast<int>(crossings.EndAxis) };
  segment.Begin = begin.T;
  segment.BeginAxis = begin.Axis;
  segment.End = end.T;
  segment.Entry = PointInCell(ray, box, begin);
  segment.Exit = PointInCell(ray, box, end);
  if (begin.Axis != Crossing::StartAxis)
  {
    const auto axis = static_cast<std::size_t>(begin.Axis);
    segment.Entry[axis] = ray.Step[axis] > 0 ? 0.0 : 1.0;
  }
  if (end.Axis != Crossing::StartAxis)
  {
    const auto axis = static_cast<std::size_t>(end.Axis);
    segment.Exit[axis] = ray.Step[axis] > 0 ? 1.0 : 0.0;
  }
  return true;
}

/// A hit at a fraction of the segment of a ray in a cell.
inline Hit MakeHit(const Ray& ray, const CellLattice& lattice, const Index3& cell,
  const CellSegment& segment, double fraction, int surface, bool entering)
{
  Vector3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = Lerp(segment.Entry[axis], segment.Exit[axis], fraction);
  }
  const double t = GetTAt(segment.Begin, segment.End, fraction);
  return { ray.Base + t, lattice.GetNumber(cell), surface, point, entering };
}

}

#endif
