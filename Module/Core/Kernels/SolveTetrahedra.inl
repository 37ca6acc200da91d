// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits of rays in tetrahedra, in double precision. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The rays of a vector of pairs. Behind the last pair it is repeated.
struct RaysOfPairs
{
  FrameNumbers<Doubles> Frames;
  LongestAxes Axes;
  const double (*Corners[DoubleWidth])[4];

  template <typename Pairs>
  SIMD_INLINE RaysOfPairs(const FramedRays& rays, const Pairs& pairs, int first)
  {
    const double* rows[2][DoubleWidth];
    unsigned int axes[3] = {};
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      const int pair = SmallerOf(first + lane, pairs.Count - 1);
      const int ray = pairs.Ray[pair];
      rows[0][lane] = rays.Frame[ray];
      rows[1][lane] = rays.Frame[ray] + 4;
      axes[rays.Axis[ray]] |= 1U << lane;
      this->Corners[lane] = pairs.Corners[pairs.Cell[pair]];
    }
    this->Axes.AreFirst = ToMask(axes[0]);
    this->Axes.AreSecond = ToMask(axes[1]);
    Doubles numbers[2][4];
    LoadFours(rows[0], numbers[0]);
    LoadFours(rows[1], numbers[1]);
    this->Frames = { { numbers[0][0], numbers[0][1], numbers[0][2] }, numbers[0][3], numbers[1][0],
      numbers[1][1] };
  }

  /// A corner of each cell, in the frame of its ray, and the difference there.
  SIMD_INLINE FramePointOf<Doubles> GetCorner(int corner, Doubles& difference) const
  {
    const double* rows[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      rows[lane] = this->Corners[lane][corner];
    }
    Doubles numbers[4];
    LoadFours(rows, numbers);
    difference = numbers[3];
    Doubles turned[3];
    this->Axes.Turn(numbers, turned);
    return this->Frames.Get(turned[0], turned[1], turned[2]);
  }
};

void SolveTetrahedra(const FramedRays& rays, TetrahedronPairs& pairs)
{
  pairs.Found = 0;
  pairs.Entering = 0;
  pairs.Extreme = 0;
  for (int first = 0; first < pairs.Count; first += DoubleWidth)
  {
    const RaysOfPairs raysOfPairs(rays, pairs, first);
    TetrahedronHits<Doubles> hits;
    Doubles largest = 0.0;
    for (int i = 0; i < 4; ++i)
    {
      hits.Points[i] = raysOfPairs.GetCorner(i, hits.Differences[i]);
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
