// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The first roots of candidates, in double precision. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename T>
void LoadCorners(const std::ptrdiff_t strides[3], Candidates& candidates)
{
  for (int i = 0; i < candidates.Count; i += DoubleWidth)
  {
    for (int row = 0; row < 4; ++row)
    {
      Doubles pair[2];
      LoadRow<T, 2>(&candidates.First[i], SmallerOf(candidates.Count - i, DoubleWidth),
        row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
      Store(pair[0], &candidates.Corners[2 * row][i]);
      Store(pair[1], &candidates.Corners[2 * row + 1][i]);
    }
  }
}

//------------------------------------------------------------------------------
/// The differences between the corners of cells and the isovalue; see Difference.
SIMD_INLINE void FindDifferences(
  const Candidates& candidates, int first, const ScaledIsovalue& isovalue, Doubles values[8])
{
  const Doubles scaled = isovalue.Isovalue * isovalue.Scale;
  Doubles least = Infinity;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Doubles value = Load(&candidates.Corners[corner][first]);
    values[corner] = (isovalue.Scale == 1.0 ? value : value * isovalue.Scale) - scaled;
    least = Min(least, Abs(values[corner]));
  }
  if (!Any(least < SmallestDifference))
  {
    return;
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    values[corner] =
      KeepSign(values[corner], Load(&candidates.Corners[corner][first]), isovalue.Isovalue);
  }
}

/// The part of rays in cells; see CellSegment.
struct Segments
{
  Mask Exists;
  Doubles Begin;
  Doubles BeginAxis;
  Doubles End;
  Doubles Entry[3];
  Doubles Exit[3];
};

SIMD_INLINE Segments FindSegments(const RayPacket& packet, const int* rays, const Doubles cell[3])
{
  const Doubles zero = 0.0;
  const Doubles one = 1.0;
  Doubles origin[3];
  Doubles direction[3];
  Mask up[3];
  CellCrossings<Doubles> crossings;
  Mask staysOutside = FirstLanes(0);
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = Gather(packet.Origin[axis], rays);
    direction[axis] = Gather(packet.Direction[axis], rays);
    const Doubles inverse = Gather(packet.Inverse[axis], rays);
    up[axis] = zero < direction[axis];
    const Mask moves = up[axis] | (direction[axis] < zero);
    const Doubles next = cell[axis] + one;
    const Doubles in = (Select(up[axis], cell[axis], next) - origin[axis]) * inverse;
    const Doubles out = (Select(up[axis], next, cell[axis]) - origin[axis]) * inverse;
    staysOutside = staysOutside | AndNot((inverse < cell[axis]) | (cell[axis] < inverse), moves);
    crossings.Narrow(axis, moves, in, out);
  }
  Segments result;
  result.Exists = AndNot(
    crossings.CutToRay(Gather(packet.Begin, rays), Gather(packet.End, rays), false), staysOutside);
  result.Begin = crossings.Begin;
  result.BeginAxis = crossings.BeginAxis;
  result.End = crossings.End;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles entry = ClampToCell(origin[axis] + result.Begin * direction[axis] - cell[axis]);
    const Doubles exit = ClampToCell(origin[axis] + result.End * direction[axis] - cell[axis]);
    // On the plane it crosses there, the coordinate is exactly 0 or 1.
    result.Entry[axis] = Select(crossings.BeginAxis == axis, Select(up[axis], zero, one), entry);
    result.Exit[axis] = Select(crossings.EndAxis == axis, Select(up[axis], one, zero), exit);
  }
  return result;
}

/// A piece of the interval on which a cubic is monotone and changes its sign.
struct Brackets
{
  Mask Exists;
  Doubles Low;
  Doubles High;
  Doubles AtLow;
  Doubles AtHigh;
};

/// The first of the pieces that ForEachSignChange goes through. (It calls a function for each root;
/// here lanes wait for each other.)
SIMD_INLINE Brackets FindFirstSignChange(const Doubles b[4])
{
  const CubicDerivative<Doubles> derivative = GetDerivative(b);
  const Doubles discriminant = derivative.GetDiscriminant();
  const Mask turns = AndNot(0.0 < discriminant, IsMonotone(b));

  Brackets result = { FirstLanes(0), 0.0, 1.0, b[0], b[3] };
  if (Any(turns))
  {
    Doubles roots[2];
    derivative.FindRoots(Select(turns, discriminant, 0.0), roots);
    for (int i = 0; i < 2; ++i)
    {
      const Doubles turn = roots[i];
      const Mask isTurn = AndNot(turns & (0.0 < turn) & (turn < 1.0), result.Exists);
      const Doubles value = EvaluateBernstein(b, turn);
      const Mask changes = isTurn & (IsInside(value) ^ IsInside(result.AtLow));
      result.High = Select(changes, turn, result.High);
      result.AtHigh = Select(changes, value, result.AtHigh);
      result.Exists = result.Exists | changes;
      const Mask passes = AndNot(isTurn, changes);
      result.Low = Select(passes, turn, result.Low);
      result.AtLow = Select(passes, value, result.AtLow);
    }
  }
  result.Exists = result.Exists | (IsInside(result.AtHigh) ^ IsInside(result.AtLow));
  return result;
}

SIMD_INLINE void SetBits(unsigned int bits, int first, std::uint64_t* words)
{
  words[first >> 6] |= static_cast<std::uint64_t>(bits) << (first & 63);
}

/// A vector of candidates that are being solved.
struct CellCubics
{
  Segments Segment;
  /// Bernstein coefficients along the segment.
  Doubles B[4];
  Brackets Bracket;
};

SIMD_INLINE void FindCubics(const RayPacket& packet, const Candidates& candidates, int first,
  const ScaledIsovalue& isovalue, CellCubics& cubics, Solutions& solutions)
{
  const Doubles cell[3] = { LoadIntegers(&candidates.Cell[0][first]),
    LoadIntegers(&candidates.Cell[1][first]), LoadIntegers(&candidates.Cell[2][first]) };
  cubics.Segment = FindSegments(packet, &candidates.Ray[first], cell);
  Doubles values[8];
  FindDifferences(candidates, first, isovalue, values);
  const Doubles* b = cubics.B;
  FindCubicAlongSegment(values, cubics.Segment.Entry, cubics.Segment.Exit, cubics.B);
  const int lanes = SmallerOf(LargerOf(candidates.Count - first, 0), DoubleWidth);
  const Mask mayHaveRoot = cubics.Segment.Exists & FirstLanes(lanes) & MayHaveRoot(b);
  const Mask ordinary = IsOrdinarySize(GetSize(b));
  cubics.Bracket = FindFirstSignChange(b);
  cubics.Bracket.Exists = cubics.Bracket.Exists & mayHaveRoot & ordinary;
  SetBits(ToBits(AndNot(mayHaveRoot, ordinary)), first, solutions.Extreme);
}

/// Refines the roots of two vectors of cubics at a time: each step depends on the one before, and
/// the steps of the other vector fill its latency.
SIMD_INLINE void RefineRoots(const CellCubics cubics[2], Doubles u[2])
{
  using Refinement = RootRefinement<Doubles>;
  Refinement refinements[2];
  Mask going[2];
  for (int j = 0; j < 2; ++j)
  {
    const Brackets& bracket = cubics[j].Bracket;
    refinements[j] =
      Refinement(cubics[j].B, bracket.Low, bracket.High, bracket.AtLow, bracket.AtHigh);
    going[j] = bracket.Exists;
  }
  for (int i = 0; i < Refinement::MaximumIterations && Any(going[0] | going[1]); ++i)
  {
    for (int j = 0; j < 2; ++j)
    {
      going[j] = AndNot(going[j], refinements[j].Step(i, going[j]));
    }
  }
  u[0] = refinements[0].GetRoot();
  u[1] = refinements[1].GetRoot();
}

SIMD_INLINE void StoreSolutions(const RayPacket& packet, const Candidates& candidates, int first,
  const CellCubics& cubics, Doubles u, Solutions& solutions)
{
  const Segments& segment = cubics.Segment;
  SetBits(ToBits(cubics.Bracket.Exists), first, solutions.Found);
  SetBits(ToBits(IsInside(cubics.Bracket.AtHigh)), first, solutions.Entering);
  Store(segment.Begin, &solutions.Begin[first]);
  Store(segment.BeginAxis, &solutions.BeginAxis[first]);
  const Doubles t = GetTAt(segment.Begin, segment.End, u);
  Store(Gather(packet.Base, &candidates.Ray[first]) + t, &solutions.T[first]);
  for (int axis = 0; axis < 3; ++axis)
  {
    Store(Lerp(segment.Entry[axis], segment.Exit[axis], u), &solutions.Parametric[axis][first]);
  }
}

void Solve(const RayPacket& packet, const Candidates& candidates, const ScaledIsovalue& isovalue,
  Solutions& solutions)
{
  for (int i = 0; i < Solutions::Words; ++i)
  {
    solutions.Found[i] = solutions.Extreme[i] = solutions.Entering[i] = 0;
  }
  // Two vectors at a time; see RefineRoots.
  for (int i = 0; i < candidates.Count; i += 2 * DoubleWidth)
  {
    CellCubics cubics[2];
    for (int j = 0; j < 2; ++j)
    {
      FindCubics(packet, candidates, i + j * DoubleWidth, isovalue, cubics[j], solutions);
    }
    Doubles u[2];
    RefineRoots(cubics, u);
    for (int j = 0; j < 2; ++j)
    {
      StoreSolutions(packet, candidates, i + j * DoubleWidth, cubics[j], u[j], solutions);
    }
  }
}

}
}
