// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellCrossings_h
#define CellCrossings_h

#include "Math/Arithmetic.h"

namespace vtkIsosurfaceRayTracing
{

/// A point on a ray: all planes whose crossings come before it or coincide with it have been
/// crossed.
///
/// Planes crossed at the same t (the ray meets an edge or a vertex) are crossed in the order x, y,
/// z. So every ray has one sequence of cells, in which neighbours share a face, and every cell of
/// it can be recognised without knowing the others.
struct Crossing
{
  double T;
  /// The axis of the plane crossed; StartAxis for a t that is no crossing.
  int Axis;

  static constexpr int StartAxis = 3;

  bool operator<(const Crossing& other) const
  {
    return this->T < other.T || (this->T == other.T && this->Axis < other.Axis);
  }
};

/// Where rays enter and leave cells, found from the planes of the cells alone. Points on a ray are
/// ordered as Crossing defines, with axes as numbers.
template <typename Number>
struct CellCrossings
{
  using Mask = decltype(Number() < Number());

  Number Begin = -Infinity;
  Number BeginAxis = 0.0;
  Number End = Infinity;
  Number EndAxis = Crossing::StartAxis;

  /// Narrows the part of rays to what is between the two planes of an axis that they move along.
  /// Axes come in their order: of equal crossings the last one begins a cell, the first one ends
  /// it.
  SIMD_INLINE void Narrow(int axis, Mask moves, Number in, Number out)
  {
    const Number number = axis;
    const Mask isLater = moves & (this->Begin <= in);
    this->Begin = Select(isLater, in, this->Begin);
    this->BeginAxis = Select(isLater, number, this->BeginAxis);
    const Mask isSooner = moves & (out < this->End);
    this->End = Select(isSooner, out, this->End);
    this->EndAxis = Select(isSooner, number, this->EndAxis);
  }

  /// Cuts the part to that of the ray. Where the ray begins or ends within the cell, no plane is
  /// crossed there. Returns which rays pass their cells. A flat cell is passed at one t.
  SIMD_INLINE Mask CutToRay(Number begin, Number end, bool mayBeFlat)
  {
    const Number start = Crossing::StartAxis;
    const Mask isInTime = (begin < this->End) & (this->Begin < end);
    const Mask enters = begin <= this->Begin;
    const Mask leaves = this->End <= end;
    this->Begin = Select(enters, this->Begin, begin);
    this->BeginAxis = Select(enters, this->BeginAxis, start);
    this->End = Select(leaves, this->End, end);
    this->EndAxis = Select(leaves, this->EndAxis, start);
    const Mask isOrdered = mayBeFlat
      ? (this->BeginAxis <= this->EndAxis) & (this->BeginAxis < start)
      : this->BeginAxis < this->EndAxis;
    return ((this->Begin < this->End) | ((this->Begin == this->End) & isOrdered)) & isInTime;
  }
};

/// The part of a coordinate that lies in a cell.
template <typename Number>
SIMD_INLINE Number ClampToCell(Number coordinate)
{
  return Min(Number(1.0), Max(Number(0.0), coordinate));
}

/// Rays, and cells that they may pass.
template <typename Number>
struct RaysInCells
{
  Number Origin[3];
  Number Direction[3];
  /// One over the direction; or, along an axis whose planes a ray is parallel to, the coordinate of
  /// the cells that it stays in.
  Number Inverse[3];
  Number Begin;
  Number End;
  /// The coordinates of the cells, and where their planes stand.
  Number Cell[3];
  Number Lower[3];
  Number Upper[3];
  /// Whether planes stand at whole numbers.
  bool Even;

  /// The points of the rays at t, in the cells' own coordinates.
  SIMD_INLINE Number GetParametric(int axis, Number t) const
  {
    const Number above = this->Origin[axis] + t * this->Direction[axis] - this->Lower[axis];
    return ClampToCell(this->Even ? above : above / (this->Upper[axis] - this->Lower[axis]));
  }
};

/// The parts of rays inside cells, with their two ends in the cells' own coordinates, [0, 1]^3.
template <typename Number>
struct CellSegments
{
  using Mask = decltype(Number() < Number());

  Number Begin;
  /// The axis of the plane crossed at Begin; see Crossing.
  Number BeginAxis;
  Number End;
  Number Entry[3];
  Number Exit[3];

  /// Finds the segments from the planes of the cells alone: they do not depend on how a cell was
  /// found. Returns which rays pass their cells.
  ///
  /// On the plane that a ray crosses, the coordinate is exactly 0 or 1: the two cells that share
  /// the face then interpolate between the same four samples with the same weights, and agree on
  /// the sign of every point of it to the last bit. No ray slips between them.
  SIMD_INLINE Mask Find(const RaysInCells<Number>& rays)
  {
    const Number zero = 0.0;
    const Number one = 1.0;
    Mask up[3];
    CellCrossings<Number> crossings;
    Mask staysOutside = {};
    for (int axis = 0; axis < 3; ++axis)
    {
      const Number lower = rays.Lower[axis];
      const Number upper = rays.Upper[axis];
      const Number origin = rays.Origin[axis];
      const Number inverse = rays.Inverse[axis];
      up[axis] = zero < rays.Direction[axis];
      const Mask moves = up[axis] | (rays.Direction[axis] < zero);
      const Number in = (Select(up[axis], lower, upper) - origin) * inverse;
      const Number out = (Select(up[axis], upper, lower) - origin) * inverse;
      const Mask isOutside = (inverse < rays.Cell[axis]) | (rays.Cell[axis] < inverse);
      staysOutside = staysOutside | AndNot(isOutside, moves);
      crossings.Narrow(axis, moves, in, out);
    }
    const Mask exists = AndNot(crossings.CutToRay(rays.Begin, rays.End, !rays.Even), staysOutside);
    this->Begin = crossings.Begin;
    this->BeginAxis = crossings.BeginAxis;
    this->End = crossings.End;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Entry[axis] = Select(crossings.BeginAxis == axis, Select(up[axis], zero, one),
        rays.GetParametric(axis, this->Begin));
      this->Exit[axis] = Select(crossings.EndAxis == axis, Select(up[axis], one, zero),
        rays.GetParametric(axis, this->End));
    }
    return exists;
  }
};

/// The t at a fraction of a segment. Written so that it never falls as the fraction grows.
template <typename Number>
SIMD_INLINE Number GetTAt(Number begin, Number end, Number fraction)
{
  return Min(begin + (end - begin) * fraction, end);
}

}

#endif
