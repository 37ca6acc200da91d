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
    const void* first[DoubleWidth];
    TakeRows(candidates.First, i, candidates.Count, first);
    for (int row = 0; row < 4; ++row)
    {
      Doubles pair[2];
      LoadRow<T, 2>(first, row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
      Store(pair[0], &candidates.Corners[2 * row][i]);
      Store(pair[1], &candidates.Corners[2 * row + 1][i]);
    }
  }
}

//------------------------------------------------------------------------------
/// The rays of a vector of candidates, with their cells.
template <bool Even>
SIMD_INLINE RaysInCells<Doubles> LoadRaysInCells(
  const RayPacket& packet, const Candidates& candidates, int first, const LatticePlanes* planes)
{
  const int* numbers = &candidates.Ray[first];
  RaysInCells<Doubles> rays;
  for (int axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = Gather(packet.Origin[axis], numbers);
    rays.Direction[axis] = Gather(packet.Direction[axis], numbers);
    rays.Inverse[axis] = Gather(packet.Inverse[axis], numbers);
    rays.Cell[axis] = LoadIntegers(&candidates.Cell[axis][first]);
    if constexpr (Even)
    {
      rays.Lower[axis] = rays.Cell[axis];
      rays.Upper[axis] = rays.Cell[axis] + 1.0;
    }
    else
    {
      const int* cells = &candidates.Cell[axis][first];
      rays.Lower[axis] = Gather(planes->Coordinates[axis], cells);
      rays.Upper[axis] = Gather(planes->Coordinates[axis] + 1, cells);
    }
  }
  rays.Begin = Gather(packet.Begin, numbers);
  rays.End = Gather(packet.End, numbers);
  rays.Even = Even;
  return rays;
}

/// The first piece of each cubic in which its sign changes, and whether it does in further ones.
/// Returns where there is one.
SIMD_INLINE Mask FindFirstSignChange(
  const Doubles b[4], MonotonePiece<Doubles>& first, Mask& further)
{
  TurningPoints<Doubles> turns;
  turns.Find(b);
  Mask exists = {};
  further = Mask();
  first = { 0.0, 1.0, b[0], b[3] };
  ForEachSignChange(
    turns, b[0], b[3], [b](Doubles u) { return EvaluateBernstein(b, u); },
    [&exists, &first, &further](Mask changes, const MonotonePiece<Doubles>& piece)
    {
      const Mask isFirst = AndNot(changes, exists);
      first.Low = Select(isFirst, piece.Low, first.Low);
      first.High = Select(isFirst, piece.High, first.High);
      first.AtLow = Select(isFirst, piece.AtLow, first.AtLow);
      first.AtHigh = Select(isFirst, piece.AtHigh, first.AtHigh);
      further = further | (changes & exists);
      exists = exists | changes;
      return false;
    });
  return exists;
}

SIMD_INLINE void SetBits(unsigned int bits, int first, std::uint64_t* words)
{
  words[first >> 6] |= static_cast<std::uint64_t>(bits) << (first & 63);
}

SIMD_INLINE void ClearSolutions(Solutions& solutions)
{
  for (int i = 0; i < Solutions::Words; ++i)
  {
    solutions.Found[i] = solutions.Further[i] = solutions.Extreme[i] = solutions.Entering[i] = 0;
  }
}

/// A vector of candidates that are being solved.
struct CellCubics
{
  CellSegments<Doubles> Segment;
  /// Bernstein coefficients along the segment.
  Doubles B[4];
  /// Whether there is a root, and the piece with the first.
  Mask Exists;
  MonotonePiece<Doubles> Piece;
  /// Whether there are further roots.
  Mask HasFurther;
};

template <bool Even>
SIMD_INLINE void FindCubics(const RayPacket& packet, const Candidates& candidates, int first,
  const LatticePlanes* planes, const ScaledIsovalue& isovalue, CellCubics& cubics,
  Solutions& solutions)
{
  const Mask exists = cubics.Segment.Find(LoadRaysInCells<Even>(packet, candidates, first, planes));
  Doubles corners[8];
  for (int i = 0; i < 8; ++i)
  {
    corners[i] = Load(&candidates.Corners[i][first]);
  }
  Doubles values[8];
  FindDifferences(corners, isovalue.Isovalue, isovalue.Scale, values);
  const Doubles* b = cubics.B;
  FindCubicAlongSegment(values, cubics.Segment.Entry, cubics.Segment.Exit, cubics.B);
  const int lanes = SmallerOf(LargerOf(candidates.Count - first, 0), DoubleWidth);
  const Mask mayHaveRoot = exists & FirstLanes(lanes) & MayHaveRoot(b);
  const Mask ordinary = IsOrdinarySize(GetSize(b));
  const Mask changesSign = FindFirstSignChange(b, cubics.Piece, cubics.HasFurther);
  cubics.Exists = changesSign & mayHaveRoot & ordinary;
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
    const MonotonePiece<Doubles>& piece = cubics[j].Piece;
    refinements[j] = Refinement(cubics[j].B, piece.Low, piece.High, piece.AtLow, piece.AtHigh);
    going[j] = cubics[j].Exists;
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
  const CellSegments<Doubles>& segment = cubics.Segment;
  SetBits(ToBits(cubics.Exists), first, solutions.Found);
  SetBits(ToBits(cubics.Exists & cubics.HasFurther), first, solutions.Further);
  SetBits(ToBits(IsInside(cubics.Piece.AtHigh)), first, solutions.Entering);
  Store(segment.Begin, &solutions.Begin[first]);
  Store(segment.BeginAxis, &solutions.BeginAxis[first]);
  const Doubles t = GetTAt(segment.Begin, segment.End, u);
  Store(Gather(packet.Base, &candidates.Ray[first]) + t, &solutions.T[first]);
  Store(u, &solutions.Fraction[first]);
  for (int axis = 0; axis < 3; ++axis)
  {
    Store(Lerp(segment.Entry[axis], segment.Exit[axis], u), &solutions.Parametric[axis][first]);
  }
}

template <bool Even>
SIMD_INLINE void SolveBetween(const LatticePlanes* planes, const RayPacket& packet,
  const Candidates& candidates, const ScaledIsovalue& isovalue, Solutions& solutions)
{
  // Two vectors at a time; see RefineRoots.
  for (int i = 0; i < candidates.Count; i += 2 * DoubleWidth)
  {
    CellCubics cubics[2];
    for (int j = 0; j < 2; ++j)
    {
      FindCubics<Even>(
        packet, candidates, i + j * DoubleWidth, planes, isovalue, cubics[j], solutions);
    }
    Doubles u[2];
    RefineRoots(cubics, u);
    for (int j = 0; j < 2; ++j)
    {
      StoreSolutions(packet, candidates, i + j * DoubleWidth, cubics[j], u[j], solutions);
    }
  }
}

void Solve(const RayPacket& packet, const Candidates& candidates, const LatticePlanes* planes,
  const ScaledIsovalue& isovalue, Solutions& solutions)
{
  ClearSolutions(solutions);
  if (planes)
  {
    SolveBetween<false>(planes, packet, candidates, isovalue, solutions);
  }
  else
  {
    SolveBetween<true>(planes, packet, candidates, isovalue, solutions);
  }
}

}
}
