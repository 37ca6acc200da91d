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

inline RaysInCells<double> GetRayInCell(const Ray& ray, const Index3& cell)
{
  RaysInCells<double> rays;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = ray.Origin[axis];
    rays.Direction[axis] = ray.Direction[axis];
    rays.Inverse[axis] = ray.Inverse[axis];
    rays.Cell[axis] = cell[axis];
    rays.Lower[axis] = ray.GetPlane(axis, cell[axis]);
    rays.Upper[axis] = ray.GetPlane(axis, cell[axis] + 1);
  }
  rays.Begin = ray.Begin;
  rays.End = ray.End;
  rays.Even = !ray.Planes;
  return rays;
}

/// The point of a ray at t, in the coordinates of a cell.
inline Vector3 PointInCell(const Ray& ray, const Index3& cell, double t)
{
  const RaysInCells<double> rays = GetRayInCell(ray, cell);
  return { rays.GetParametric(0, t), rays.GetParametric(1, t), rays.GetParametric(2, t) };
}

/// The segment of a ray in a cell; see CellSegments. Returns false if the ray does not pass the
/// cell.
inline bool SegmentInCell(const Ray& ray, const Index3& cell, CellSegment& segment)
{
  CellSegments<double> found;
  if (!found.Find(GetRayInCell(ray, cell)))
  {
    return false;
  }
  segment = { found.Begin, found.End, static_cast<int>(found.BeginAxis),
    { found.Entry[0], found.Entry[1], found.Entry[2] },
    { found.Exit[0], found.Exit[1], found.Exit[2] } };
  return true;
}

/// Whether a ray comes to a cell before another one, which it enters elsewhere, given where it
/// enters them. Flat cells are entered where the cells behind them are.
inline bool IsEnteredBefore(const Index3& cell, const Crossing& begin, const Index3& other,
  const Crossing& beginOfOther, const Vector3& direction)
{
  if (begin < beginOfOther || beginOfOther < begin || begin.Axis == Crossing::StartAxis)
  {
    return begin < beginOfOther;
  }
  const auto axis = static_cast<std::size_t>(begin.Axis);
  return direction[axis] > 0.0 ? cell[axis] < other[axis] : cell[axis] > other[axis];
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
