// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Tetrahedra as a tile of pixels sees them. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A corner of a tetrahedron: its point and the value there.
struct PlacedCorner
{
  Doubles Numbers[4];

  /// Whether it comes before another one: by x, then by y, then by z.
  SIMD_INLINE Mask IsBefore(const PlacedCorner& other) const
  {
    const Doubles* a = this->Numbers;
    const Doubles* b = other.Numbers;
    return (a[0] < b[0]) | ((a[0] == b[0]) & ((a[1] < b[1]) | ((a[1] == b[1]) & (a[2] < b[2]))));
  }

  SIMD_INLINE static void Sort(PlacedCorner& a, PlacedCorner& b)
  {
    const Mask isWrong = b.IsBefore(a);
    for (int i = 0; i < 4; ++i)
    {
      const Doubles first = Select(isWrong, b.Numbers[i], a.Numbers[i]);
      b.Numbers[i] = Select(isWrong, a.Numbers[i], b.Numbers[i]);
      a.Numbers[i] = first;
    }
  }
};

/// The corners of a vector of tetrahedra in the frame of a tile.
struct TileCorners
{
  Doubles X[4];
  Doubles Y[4];
  Doubles W[4];

  /// The area of the edge between two corners, as in ProjectedTetrahedra.
  SIMD_INLINE void FindEdge(
    int one, int other, Doubles& a, Doubles& b, Doubles& c, Doubles& rounding) const
  {
    const Doubles products[6] = { this->Y[one] * this->W[other], this->Y[other] * this->W[one],
      this->X[one] * this->W[other], this->X[other] * this->W[one], this->X[one] * this->Y[other],
      this->X[other] * this->Y[one] };
    a = products[0] - products[1];
    b = products[3] - products[2];
    c = products[4] - products[5];
    // More than these functions, and areas that are found from coordinates about a ray, may lose:
    // so areas that are larger are exact to three digits.
    const double unit = 0x1p-40;
    const Doubles farthest = CloudTile::Middle;
    const Doubles across =
      Abs(products[0]) + Abs(products[1]) + Abs(products[2]) + Abs(products[3]);
    const Doubles weights = Abs(this->W[one] * this->W[other]);
    rounding =
      unit * (Abs(products[4]) + Abs(products[5]) + farthest * (across + farthest * weights));
  }
};

/// Edges that are smaller or larger have sides that nothing is sure of, and so has a margin that is
/// larger.
constexpr double LeastEdgeSize = 0x1p-800;
constexpr double LargestEdgeSize = 0x1p800;
constexpr double LargestMargin = 0x1p20;

/// Which pixels the points of corners are between, along an axis.
SIMD_INLINE void FindPixels(const Doubles labels[4], int count, int* first, int* last)
{
  const Doubles low = Min(Min(labels[0], labels[1]), Min(labels[2], labels[3]));
  const Doubles high = Max(Max(labels[0], labels[1]), Max(labels[2], labels[3]));
  const double margin = 0x1p-10; // more than rounding, which decides nothing here
  const Doubles end = count;
  const Doubles middle = CloudTile::Middle;
  // Infinite and undefined labels become the ends.
  StoreTruncated(Min(end, Max(Doubles(0.0), 0.0 - Floor(margin - (low + middle)))), first);
  StoreTruncated(Max(Doubles(-1.0), Min(end - 1.0, Floor(high + middle + margin))), last);
}

/// Finds where rows of pixels meet the line of an edge of a vector of tetrahedra, from the first
/// on.
SIMD_INLINE void FindLine(
  const Doubles (&area)[3], Doubles rounding, int edge, int first, ProjectedTetrahedra& projected)
{
  const Doubles middle = CloudTile::Middle;
  const Doubles size = Abs(area[2]) + middle * (Abs(area[0]) + Abs(area[1]));
  // A line along rows is turned by less than the margin.
  const Doubles across = CopySign(Max(Abs(area[0]), 0x1p-24 * size), area[0] + 0.0);
  const Doubles inverse = 1.0 / across;
  const Doubles slope = 0.0 - area[1] * inverse;
  const Doubles start = middle - (area[2] * inverse + slope * middle);
  // More than single precision takes off: some 2^-20 of the size.
  const Doubles margin = (0x1p-18 * size + rounding) * Abs(inverse);
  const Mask isKnown = (LeastEdgeSize < size) & (size < LargestEdgeSize) & (margin < LargestMargin);
  StoreRounded(Select(isKnown, slope, Doubles(0.0)), &projected.LineSlope[edge][first]);
  StoreRounded(Select(isKnown, start, Doubles(0.0)), &projected.LineStart[edge][first]);
  StoreRounded(Select(isKnown, margin, Doubles(LargestMargin)), &projected.LineMargin[edge][first]);
}

void ProjectTetrahedra(
  const CloudTile& tile, const double (*corners)[4][4], int count, ProjectedTetrahedra& projected)
{
  projected.Count = count;
  for (int first = 0; first < count; first += DoubleWidth)
  {
    PlacedCorner placed[4];
    for (int i = 0; i < 4; ++i)
    {
      LoadCorner(corners, first, count, i, placed[i].Numbers);
    }
    PlacedCorner::Sort(placed[0], placed[1]);
    PlacedCorner::Sort(placed[2], placed[3]);
    PlacedCorner::Sort(placed[0], placed[2]);
    PlacedCorner::Sort(placed[1], placed[3]);
    PlacedCorner::Sort(placed[1], placed[2]);

    TileCorners seen;
    Doubles columns[4];
    Doubles rows[4];
    Mask isInFront = Doubles(0.0) < Doubles(1.0);
    Doubles nearest = Infinity;
    Doubles farthest = -1.0;
    for (int i = 0; i < 4; ++i)
    {
      Doubles numbers[4];
      for (int k = 0; k < 4; ++k)
      {
        const double* row = tile.FromPoint[k];
        numbers[k] = row[0] * placed[i].Numbers[0] + row[1] * placed[i].Numbers[1] +
          row[2] * placed[i].Numbers[2] + row[3];
      }
      seen.X[i] = numbers[0];
      seen.Y[i] = numbers[1];
      seen.W[i] = numbers[2];
      Store(numbers[0], &projected.X[i][first]);
      Store(numbers[1], &projected.Y[i][first]);
      Store(numbers[2], &projected.W[i][first]);
      Store(numbers[3], &projected.Depth[i][first]);
      const Doubles largest = LargestCloudValue;
      Store(Max(0.0 - largest, Min(largest, placed[i].Numbers[3])), &projected.Value[0][i][first]);
      nearest = Min(nearest, numbers[3]);
      farthest = Max(farthest, numbers[3]);
      isInFront = isInFront & (0.0 < numbers[2]);
      const Doubles inverse = 1.0 / numbers[2];
      columns[i] = numbers[0] * inverse;
      rows[i] = numbers[1] * inverse;
    }

    constexpr int ends[ProjectedTetrahedra::Edges][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 },
      { 1, 3 }, { 2, 3 } };
    Doubles largest = 0.0;
    for (int i = 0; i < ProjectedTetrahedra::Edges; ++i)
    {
      Doubles area[3];
      Doubles rounding;
      seen.FindEdge(ends[i][0], ends[i][1], area[0], area[1], area[2], rounding);
      Store(area[0], &projected.A[i][first]);
      Store(area[1], &projected.B[i][first]);
      Store(area[2], &projected.C[i][first]);
      FindLine(area, rounding, i, first, projected);
      Store(rounding, &projected.Rounding[i][first]);
      largest = Max(largest, rounding);
    }
    Store(largest, &projected.LargestRounding[first]);
    // Behind the eye labels are anywhere: all pixels may be covered.
    for (int i = 0; i < 4; ++i)
    {
      columns[i] = Select(isInFront, columns[i], Doubles(i == 0 ? -Infinity : Infinity));
      rows[i] = Select(isInFront, rows[i], Doubles(i == 0 ? -Infinity : Infinity));
    }
    const Doubles margin = 1e-12 * (Abs(nearest) + Abs(farthest));
    Store(nearest - margin, &projected.Nearest[first]);
    Store(farthest + margin, &projected.Farthest[first]);
    // Nothing is seen before the near plane.
    const Mask isSeen = 0.0 < farthest;
    for (int i = 0; i < 4; ++i)
    {
      rows[i] = Select(isSeen, rows[i], Doubles(Infinity));
    }
    FindPixels(columns, tile.Columns, &projected.FirstColumn[first], &projected.LastColumn[first]);
    FindPixels(rows, tile.Rows, &projected.FirstRow[first], &projected.LastRow[first]);
  }
}

}
}
