// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Hits of rays in trilinear cells, in double precision. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Loads parts of the cells of pairs; see TrilinearSearch.
struct PartsOfPairs
{
  const FramedRays& Rays;
  const TrilinearPairs& Pairs;

  /// The pairs of some parts.
  struct Lanes
  {
    int Count;
    int Ray[DoubleWidth];
    int Cell[DoubleWidth];
    const double (*Corners)[PassedCellRecords::Corners][4];
  };

  SIMD_INLINE void Load(
    const TrilinearPart* parts, int count, bool areWhole, TrilinearHits<Doubles>& hits) const
  {
    Lanes lanes;
    lanes.Count = count;
    lanes.Corners = this->Pairs.Corners;
    for (int lane = 0; lane < count; ++lane)
    {
      const int pair = parts[lane].Pair;
      lanes.Ray[lane] = this->Pairs.Ray[pair];
      lanes.Cell[lane] = this->Pairs.Cell[pair];
    }
    const RaysOfPairs raysOfPairs(this->Rays, lanes, 0);
    for (int i = 0; i < 8; ++i)
    {
      Doubles difference;
      const FramePointOf<Doubles> point = raysOfPairs.GetCorner(i, difference);
      hits.SetCorner(i, point, difference);
    }
    LoadBoxes(parts, count, areWhole, hits);
  }

  SIMD_INLINE static void LoadBoxes(
    const TrilinearPart* parts, int count, bool areWhole, TrilinearHits<Doubles>& hits)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      double middle[DoubleWidth];
      double half[DoubleWidth];
      for (int lane = 0; lane < DoubleWidth && !areWhole; ++lane)
      {
        const TrilinearPart& part = parts[SmallerOf(lane, count - 1)];
        middle[lane] = part.Middle[axis];
        half[lane] = part.Half[axis];
      }
      hits.Middle[axis] = areWhole ? Doubles(0.0) : vtkIsosurfaceRayTracing::Load(middle);
      hits.Half[axis] = areWhole ? Doubles(1.0) : vtkIsosurfaceRayTracing::Load(half);
    }
  }
};

void SolveTrilinear(const FramedRays& rays, TrilinearPairs& pairs)
{
  const PartsOfPairs source = { rays, pairs };
  TrilinearSearch<Doubles, DoubleWidth, TrilinearPairs::Capacity, PartsOfPairs>(
    source, pairs.Solutions)
    .Solve(pairs.Count);
}

}
}
