// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The first faces between boxes that rays cross in candidates. Included by Kernels.inl only, behind
// SolveCandidates.inl.

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE Mask SelectMask(Mask condition, Mask yes, Mask no)
{
  return (condition & yes) | AndNot(no, condition);
}

/// Whether the crossing of one axis comes before that of another; of equal ones, that of the lower
/// axis does.
SIMD_INLINE Mask IsBefore(Doubles t, int axis, Doubles other, int otherAxis)
{
  return axis < otherAxis ? t <= other : t < other;
}

/// Where rays cross the planes between boxes, in the middles of cells, and those of the cells.
struct BoxCrossings
{
  Mask Moves[3];
  Mask Up[3];
  Doubles Middle[3];
  Doubles In[3];
  Doubles Out[3];
  /// Whether the ray is in the cell by the axes that it does not move along, and enters it by the
  /// others before it ends.
  Mask Passes;

  template <bool Even>
  SIMD_INLINE void Find(const RaysInCells<Doubles>& rays)
  {
    const Doubles zero = 0.0;
    this->Passes = zero <= zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles origin = rays.Origin[axis];
      const Doubles inverse = rays.Inverse[axis];
      const Doubles lower = rays.Lower[axis];
      const Doubles upper = rays.Upper[axis];
      const Doubles middle =
        Even ? rays.Cell[axis] + Doubles(0.5) : lower + Doubles(0.5) * (upper - lower);
      this->Up[axis] = zero < rays.Direction[axis];
      this->Moves[axis] = this->Up[axis] | (rays.Direction[axis] < zero);
      this->Middle[axis] = (middle - origin) * inverse;
      this->In[axis] = (Select(this->Up[axis], lower, upper) - origin) * inverse;
      this->Out[axis] = (Select(this->Up[axis], upper, lower) - origin) * inverse;
      this->Passes = this->Passes &
        SelectMask(this->Moves[axis], this->In[axis] < rays.End, inverse == rays.Cell[axis]);
    }
  }

  /// Whether rays are in their cells where they cross the middle plane of an axis.
  SIMD_INLINE Mask AreInCells(int axis, const RaysInCells<Doubles>& rays) const
  {
    const Doubles t = this->Middle[axis];
    Mask isIn = this->Passes & this->Moves[axis] & (rays.Begin < t) & (t <= rays.End);
    for (int other = 0; other < 3; ++other)
    {
      if (other != axis)
      {
        const Mask isOutside = IsBefore(t, axis, this->In[other], other);
        const Mask isBetween = AndNot(IsBefore(t, axis, this->Out[other], other), isOutside);
        isIn = isIn & SelectMask(this->Moves[other], isBetween, isIn);
      }
    }
    return isIn;
  }

  /// Whether rays are above the middle plane of another axis where they cross that of an axis. A
  /// ray that is parallel to the plane is as its coordinate in the cell says.
  SIMD_INLINE Mask AreAbove(int axis, int other, const RaysInCells<Doubles>& rays) const
  {
    const Mask isBehind = IsBefore(this->Middle[other], other, this->Middle[axis], axis);
    const Mask staysAbove = Doubles(0.5) <= rays.GetParametric(other, Doubles(0.0));
    const Mask isAbove =
      SelectMask(this->Up[other], isBehind, AndNot(this->Moves[other], isBehind));
    return SelectMask(this->Moves[other], isAbove, staysAbove);
  }
};

/// Which corners of cells are inside, and which are finite.
struct BoxCorners
{
  Mask Inside[8];
  Mask Finite[8];
};

/// The faces that rays cross in the middle plane of an axis, where that is in the cell.
struct BoxFaces
{
  /// Whether it is a surface.
  Mask Exists;
  Mask Entering;
};

SIMD_INLINE BoxFaces FindFaces(int axis, const BoxCrossings& crossings,
  const RaysInCells<Doubles>& rays, const BoxCorners& corners)
{
  const int u = AxisU[axis];
  const int v = AxisV[axis];
  const Mask isAboveU = crossings.AreAbove(axis, u, rays);
  const Mask isAboveV = crossings.AreAbove(axis, v, rays);
  Mask inside[2];
  Mask areFinite = crossings.Passes;
  for (int side = 0; side < 2; ++side)
  {
    const auto take = [&](const Mask all[8])
    {
      const int first = side << axis;
      const int alongU = 1 << u;
      const int alongV = 1 << v;
      return SelectMask(isAboveV,
        SelectMask(isAboveU, all[first + alongV + alongU], all[first + alongV]),
        SelectMask(isAboveU, all[first + alongU], all[first]));
    };
    inside[side] = take(corners.Inside);
    areFinite = areFinite & take(corners.Finite);
  }
  return { (inside[0] ^ inside[1]) & areFinite,
    SelectMask(crossings.Up[axis], inside[1], inside[0]) };
}

template <bool Even>
SIMD_INLINE void SolveBoxesBetween(const LatticePlanes* planes, const RayPacket& packet,
  const Candidates& candidates, double isovalue, Solutions& solutions)
{
  for (int first = 0; first < candidates.Count; first += DoubleWidth)
  {
    const RaysInCells<Doubles> rays = LoadRaysInCells<Even>(packet, candidates, first, planes);
    BoxCrossings crossings;
    crossings.Find<Even>(rays);
    BoxCorners corners;
    for (int i = 0; i < 8; ++i)
    {
      const Doubles corner = Load(&candidates.Corners[i][first]);
      corners.Inside[i] = Doubles(isovalue) <= corner;
      corners.Finite[i] = Abs(corner) < Doubles(Infinity);
    }
    Doubles t = Infinity;
    Doubles axisOfFace = 0.0;
    Mask entering = {};
    Mask found = {};
    const Mask exists = FirstLanes(SmallerOf(candidates.Count - first, DoubleWidth));
    for (int axis = 0; axis < 3; ++axis)
    {
      const BoxFaces faces = FindFaces(axis, crossings, rays, corners);
      const Mask isFirst =
        exists & faces.Exists & crossings.AreInCells(axis, rays) & (crossings.Middle[axis] < t);
      t = Select(isFirst, crossings.Middle[axis], t);
      axisOfFace = Select(isFirst, Doubles(axis), axisOfFace);
      entering = SelectMask(isFirst, faces.Entering, entering);
      found = found | isFirst;
    }
    SetBits(ToBits(found), first, solutions.Found);
    SetBits(ToBits(entering), first, solutions.Entering);
    Store(t, &solutions.Begin[first]);
    Store(axisOfFace, &solutions.BeginAxis[first]);
    Store(Gather(packet.Base, &candidates.Ray[first]) + t, &solutions.T[first]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles parametric =
        Select(axisOfFace == Doubles(axis), 0.5, rays.GetParametric(axis, t));
      Store(parametric, &solutions.Parametric[axis][first]);
    }
  }
}

void SolveBoxes(const RayPacket& packet, const Candidates& candidates, const LatticePlanes* planes,
  const ScaledIsovalue& isovalue, Solutions& solutions)
{
  ClearSolutions(solutions);
  if (planes)
  {
    SolveBoxesBetween<false>(planes, packet, candidates, isovalue.Isovalue, solutions);
  }
  else
  {
    SolveBoxesBetween<true>(planes, packet, candidates, isovalue.Isovalue, solutions);
  }
}

}
}
