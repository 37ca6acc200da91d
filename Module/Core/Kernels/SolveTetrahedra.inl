// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits of rays in tetrahedra, in double precision. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Where the records of some pairs begin, and the coordinates of their corners along and across the
/// rays.
struct RecordIndices
{
  int First[3][DoubleWidth];

  SIMD_INLINE RecordIndices(const FramedRays& rays, const TetrahedronPairs& pairs, int first)
  {
    constexpr int size = sizeof(CellRecord) / sizeof(double);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const int pair = SmallerOf(first + lane, pairs.Count - 1);
      for (int i = 0; i < 3; ++i)
      {
        this->First[i][lane] = size * pairs.Piece[pair] + rays.Axis[i][pairs.Ray[pair]];
      }
    }
  }
};

SIMD_INLINE FrameNumbers<Doubles> GatherFrames(const FramedRays& rays, const int* numbers)
{
  return { { Gather(rays.Origin[0], numbers), Gather(rays.Origin[1], numbers),
             Gather(rays.Origin[2], numbers) },
    Gather(rays.ShearX, numbers), Gather(rays.ShearY, numbers), Gather(rays.Inverse, numbers) };
}

void SolveTetrahedra(const FramedRays& rays, const CellRecord* records, TetrahedronPairs& pairs)
{
  pairs.Found = 0;
  pairs.Entering = 0;
  pairs.Extreme = 0;
  const double* numbers = &records[0].Corner[0][0];
  for (int first = 0; first < pairs.Count; first += DoubleWidth)
  {
    int ofRays[DoubleWidth];
    int ofPieces[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const int pair = SmallerOf(first + lane, pairs.Count - 1);
      ofRays[lane] = pairs.Ray[pair];
      ofPieces[lane] = static_cast<int>(sizeof(CellRecord) / sizeof(double)) * pairs.Piece[pair];
    }
    const RecordIndices indices(rays, pairs, first);
    const FrameNumbers<Doubles> frames = GatherFrames(rays, ofRays);
    TetrahedronHits<Doubles> hits;
    Doubles largest = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      const double* corner = numbers + 4 * i;
      hits.Points[i] = frames.Get(Gather(corner, indices.First[0]),
        Gather(corner, indices.First[1]), Gather(corner, indices.First[2]));
      hits.Differences[i] = Gather(corner + 3, ofPieces);
      largest = Max(largest, Max(Abs(hits.Points[i].X), Abs(hits.Points[i].Y)));
    }
    const unsigned int lanes = (1U << SmallerOf(pairs.Count - first, DoubleWidth)) - 1U;
    const unsigned int extreme =
      lanes & ToBits(Doubles(0.0) < largest) & ~ToBits(IsSafeCoordinate(largest));
    const unsigned int found = lanes & ToBits(hits.Find()) & ~extreme;
    pairs.Extreme |= static_cast<std::uint64_t>(extreme) << first;
    if (found == 0)
    {
      continue;
    }
    pairs.Found |= static_cast<std::uint64_t>(found) << first;
    pairs.Entering |= static_cast<std::uint64_t>(ToBits(hits.Entering)) << first;
    Store(hits.T, &pairs.T[first]);
    for (int i = 0; i < 4; ++i)
    {
      Store(hits.Weights[i], &pairs.Weights[i][first]);
    }
  }
}

}
}
