// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits of rays in tetrahedra, in double precision. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE FrameNumbers<Doubles> GatherFrames(const FramedRays& rays, const int* numbers)
{
  return { { Gather(rays.Origin[0], numbers), Gather(rays.Origin[1], numbers),
             Gather(rays.Origin[2], numbers) },
    Gather(rays.ShearX, numbers), Gather(rays.ShearY, numbers), Gather(rays.Inverse, numbers) };
}

void SolveTetrahedra(const FramedRays& rays, const double* records, TetrahedronPairs& pairs)
{
  // From one coordinate of a corner to the next, and from corner to corner.
  constexpr int axis = PassedCellRecords::Capacity;
  constexpr int corner = 4 * axis;
  pairs.Found = 0;
  pairs.Entering = 0;
  pairs.Extreme = 0;
  for (int first = 0; first < pairs.Count; first += DoubleWidth)
  {
    int ofRays[DoubleWidth];
    int ofCells[DoubleWidth];
    int ofPoints[3][DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const int pair = SmallerOf(first + lane, pairs.Count - 1);
      ofRays[lane] = pairs.Ray[pair];
      ofCells[lane] = pairs.Record[pair];
      for (int i = 0; i < 3; ++i)
      {
        ofPoints[i][lane] = pairs.Record[pair] + axis * rays.Axis[i][pairs.Ray[pair]];
      }
    }
    const FrameNumbers<Doubles> frames = GatherFrames(rays, ofRays);
    TetrahedronHits<Doubles> hits;
    Doubles largest = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      const double* numbers = records + corner * i;
      hits.Points[i] = frames.Get(
        Gather(numbers, ofPoints[0]), Gather(numbers, ofPoints[1]), Gather(numbers, ofPoints[2]));
      hits.Differences[i] = Gather(numbers + 3 * axis, ofCells);
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
