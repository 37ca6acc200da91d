// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Classifies rays in cells in single precision: sure misses, sure hits, and the candidates that are
// left. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Passed cells, each with the segment of the ray: as in Passages::Segment, but counted from the
/// corner of the cell across the axis.
struct RoughCells
{
  /// The lower plane of the cell, from the plane that segments are counted from.
  Floats Plane;
  Floats Crossing[2];
  Floats Slope[2];
  Floats Ends[2];
  /// Bounds on the errors, in cells: of planes along the axis, and of positions across it.
  Floats PlaneError;
  Floats CrossingError[2];
};

/// A bound on the error of single precision, in cells: of a position in a block and of a plane.
constexpr float PlaceError = 0x1p-18F;

SIMD_INLINE void LoadLines(const Passages& passages, const unsigned int* codes, Floats line[4])
{
  const float* lines[FloatWidth];
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    lines[lane] = passages.Segments[codes[lane] & 0xFFFFU].Line;
  }
  LoadFours(lines, line);
}

SIMD_INLINE void LoadEnds(const Passages& passages, const unsigned int* codes, Floats ends[2])
{
  float all[2][FloatWidth];
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    const Passages::Segment& segment = passages.Segments[codes[lane] & 0xFFFFU];
    all[0][lane] = segment.Ends[0];
    all[1][lane] = segment.Ends[1];
  }
  ends[0] = LoadFloats(all[0]);
  ends[1] = LoadFloats(all[1]);
}

SIMD_INLINE RoughCells LoadRoughCells(const Passages& passages, const unsigned int* codes)
{
  Floats line[4];
  LoadLines(passages, codes, line);
  RoughCells cells;
  cells.Plane = GetBits(codes, 16, 7U) - 4.0F;
  cells.Crossing[0] = line[0] - GetBits(codes, 24, 7U);
  cells.Crossing[1] = line[1] - GetBits(codes, 27, 7U);
  cells.Slope[0] = line[2];
  cells.Slope[1] = line[3];
  cells.Ends[0] = NoEnd[0];
  cells.Ends[1] = NoEnd[1];
  if (passages.HasEnds)
  {
    LoadEnds(passages, codes, cells.Ends);
  }
  cells.PlaneError = PlaceError;
  cells.CrossingError[0] = PlaceError;
  cells.CrossingError[1] = PlaceError;
  return cells;
}

/// Where cells stand along one axis: the members of CellSpan.
struct RoughSpans
{
  Floats Lower;
  Floats Width;
  Floats InverseWidth;
  Floats Extent;
};

/// The cells have the given bits of their codes as numbers along the axis, in blocks.
SIMD_INLINE RoughSpans LoadSpans(
  const Passages& passages, const unsigned int* codes, int shift, int axis)
{
  const float* spans[FloatWidth];
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    const unsigned int code = codes[lane];
    const int block = passages.Segments[code & 0xFFFFU].Block;
    spans[lane] = &passages.Planes[block][axis]->Cells[code >> shift & 7U].Lower;
  }
  Floats all[4];
  LoadFours(spans, all);
  return { all[0], all[1], all[2], all[3] };
}

/// The same between uneven planes: cells are taken for those of a lattice, whose size along each
/// axis is 1. The axis and those across are given.
SIMD_INLINE RoughCells LoadUnevenCells(
  const Passages& passages, const unsigned int* codes, const int order[3])
{
  Floats line[4];
  LoadLines(passages, codes, line);
  const RoughSpans along = LoadSpans(passages, codes, 16, order[0]);
  RoughCells cells;
  cells.Plane = 0.0F;
  // Less than 2^-24 of the block's size in each of the up to eight steps; and what double precision
  // may be off, which counts in the smallest of cells.
  const Floats rounding = 0x1p-21F;
  const Floats least = 0x1p-28F;
  cells.PlaneError =
    MultiplyAdd(MultiplyAdd(rounding, along.Extent, least), along.InverseWidth, PlaceError);
  for (int j = 0; j < 2; ++j)
  {
    const RoughSpans across = LoadSpans(passages, codes, 24 + 3 * j, order[1 + j]);
    const Floats slope = line[2 + j];
    cells.Crossing[j] =
      (MultiplyAdd(slope, along.Lower, line[j]) - across.Lower) * across.InverseWidth;
    cells.Slope[j] = slope * along.Width * across.InverseWidth;
    // A ray goes at most two across for one along.
    const Floats size = MultiplyAdd(4.0F, along.Extent, across.Extent);
    cells.CrossingError[j] = MultiplyAdd(rounding, size, least) * across.InverseWidth;
  }
  Floats ends[2] = { NoEnd[0], NoEnd[1] };
  if (passages.HasEnds)
  {
    LoadEnds(passages, codes, ends);
  }
  cells.Ends[0] = (ends[0] - along.Lower) * along.InverseWidth;
  cells.Ends[1] = (ends[1] - along.Lower) * along.InverseWidth;
  return cells;
}

/// What single precision knows of the segments of rays in cells.
struct Classification
{
  FloatMask Misses;
  FloatMask Hits;
  /// Of those that hit, where values rise along the axis.
  FloatMask Rise;
};

template <bool Even>
SIMD_INLINE RoughCells LoadCells(
  const Passages& passages, const unsigned int* codes, const int order[3])
{
  if constexpr (Even)
  {
    return LoadRoughCells(passages, codes);
  }
  else
  {
    return LoadUnevenCells(passages, codes, order);
  }
}

/// The planes between which rays are in cells, taken a little too wide; by how much the ends may
/// be off, and whether there is surely something between them.
struct RoughSegments
{
  Floats Low;
  Floats High;
  Floats Error;
  FloatMask Exist;
};

template <bool Even>
SIMD_INLINE RoughSegments FindRoughSegments(const RoughCells& cells)
{
  const Floats one = 1.0F;
  const Floats error = cells.PlaneError;
  Floats low = cells.Plane;
  Floats surelyLow = cells.Plane;
  Floats high = cells.Plane + one;
  Floats surelyHigh = cells.Plane + one;
  // Whole numbers are exact.
  if constexpr (!Even)
  {
    low = low - error;
    surelyLow = surelyLow + error;
    high = high + error;
    surelyHigh = surelyHigh - error;
  }
  low = Max(low, cells.Ends[0] - error);
  surelyLow = Max(surelyLow, cells.Ends[0] + error);
  high = Min(high, cells.Ends[1] + error);
  surelyHigh = Min(surelyHigh, cells.Ends[1] - error);
  for (int j = 0; j < 2; ++j)
  {
    // For a slope that is nearly or exactly zero, a large reciprocal will do.
    const Floats inverse =
      ApproximateReciprocal(CopySign(Max(Abs(cells.Slope[j]), 0x1p-60F), cells.Slope[j]));
    const Floats first = (0.0F - cells.Crossing[j]) * inverse;
    const Floats second = (one - cells.Crossing[j]) * inverse;
    const Floats off = MultiplyAdd(cells.CrossingError[j], Abs(inverse), error);
    const Floats in = Min(first, second);
    const Floats out = Max(first, second);
    low = Max(low, in - off);
    surelyLow = Max(surelyLow, in + off);
    high = Min(high, out + off);
    surelyHigh = Min(surelyHigh, out - off);
  }
  RoughSegments result;
  result.Low = low;
  result.High = high;
  result.Error = Max(surelyLow - low, high - surelyHigh);
  result.Exist = surelyLow + error < surelyHigh;
  return result;
}

/// How well the points on rays in cells are known.
struct RoughPlaces
{
  /// A bound on how far points may be off, and on how far outside their cells.
  Floats Error;
  /// A bound on how far a point moves in its cell, along all axes together, for one along the axis.
  Floats Reach;

  SIMD_INLINE FloatMask AreKnown() const { return this->Error < 0x1p-6F; }
};

template <bool Even>
SIMD_INLINE RoughPlaces FindPlaces(const RoughCells& cells)
{
  if constexpr (Even)
  {
    // A ray goes at most two cells across for one along. The error counts as that of arithmetic.
    return { 0.0F, 5.0F };
  }
  else
  {
    const Floats reach = Floats(1.0F) + Abs(cells.Slope[0]) + Abs(cells.Slope[1]);
    return { MultiplyAdd(cells.PlaneError, reach, cells.CrossingError[0] + cells.CrossingError[1]),
      reach * 1.25F };
  }
}

/// The cubics along rays in cells: the values at both ends, and three times the Bernstein
/// coefficients between them.
struct RoughCubics
{
  Floats Begin;
  Floats Once;
  Floats Twice;
  Floats End;
};

SIMD_INLINE RoughCubics FindRoughCubics(
  const Floats v[8], const int order[3], const RoughCells& cells, const RoughSegments& segments)
{
  // The points in the cell at both ends of the segment.
  Floats p[3];
  Floats q[3];
  p[order[0]] = segments.Low - cells.Plane;
  q[order[0]] = segments.High - cells.Plane;
  for (int j = 0; j < 2; ++j)
  {
    p[order[1 + j]] = MultiplyAdd(segments.Low, cells.Slope[j], cells.Crossing[j]);
    q[order[1 + j]] = MultiplyAdd(segments.High, cells.Slope[j], cells.Crossing[j]);
  }
  Floats x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    const Floats difference = v[2 * i + 1] - v[2 * i];
    x[0][i] = MultiplyAdd(difference, p[0], v[2 * i]);
    x[1][i] = MultiplyAdd(difference, q[0], v[2 * i]);
  }
  Floats b[2][2][2];
  for (int i = 0; i < 2; ++i)
  {
    Floats xy[2][2];
    for (int z = 0; z < 2; ++z)
    {
      const Floats difference = x[i][2 * z + 1] - x[i][2 * z];
      xy[0][z] = MultiplyAdd(difference, p[1], x[i][2 * z]);
      xy[1][z] = MultiplyAdd(difference, q[1], x[i][2 * z]);
    }
    for (int j = 0; j < 2; ++j)
    {
      const Floats difference = xy[j][1] - xy[j][0];
      b[i][j][0] = MultiplyAdd(difference, p[2], xy[j][0]);
      b[i][j][1] = MultiplyAdd(difference, q[2], xy[j][0]);
    }
  }
  return { b[0][0][0], b[1][0][0] + b[0][1][0] + b[0][0][1], b[1][1][0] + b[1][0][1] + b[0][1][1],
    b[1][1][1] };
}

/// A bound on the error of the cubics, where those of points are given: largest is the largest
/// magnitude of each cell's values. The error of single precision is less than 2^-16 of it.
template <bool Even>
SIMD_INLINE Floats FindError(Floats largest, Floats ofValues, const RoughPlaces& places)
{
  // Where values are so large that differences overflow, the square does too, and nothing is known.
  const Floats part = largest * 0x1p-36F;
  const Floats error = MultiplyAdd(part, part, MultiplyAdd(largest, 0x1p-15F, ofValues));
  // A value changes by at most twice the largest size for a cell along each axis.
  return Even ? error : MultiplyAdd(largest * 4.0F, places.Error, error);
}

/// Classifies the cubics along rays in cells, of values less the isovalue; largest is the largest
/// magnitude of each cell's. Nothing is known where points are off by much, as in flat cells.
template <bool Even>
SIMD_INLINE Classification Classify(const Floats v[8], Floats largest, Floats isovalueError,
  const int order[3], const RoughCells& cells, const RoughSegments& segments)
{
  const RoughCubics cubics = FindRoughCubics(v, order, cells, segments);
  const RoughPlaces places = FindPlaces<Even>(cells);
  const Floats error = FindError<Even>(largest, isovalueError, places);
  const Floats errorOfEnds = MultiplyAdd(largest * segments.Error, places.Reach * 2.0F, error);
  const Floats nearer = Min(Abs(cubics.Begin), Abs(cubics.End));
  const Floats third = 1.0F / 3.0F;
  const Floats nearest = Min(nearer, Min(Abs(cubics.Once), Abs(cubics.Twice)) * third);
  const FloatMask changes = HaveDifferentSigns(cubics.Begin, cubics.End);
  const FloatMask mayChange = changes | HaveDifferentSigns(cubics.Begin, cubics.Once) |
    HaveDifferentSigns(cubics.Begin, cubics.Twice);
  Classification result;
  result.Misses = AndNot(error < nearest, mayChange) | (segments.High < segments.Low);
  result.Hits = segments.Exist & changes & (errorOfEnds < nearer);
  result.Rise = cubics.Begin < 0.0F;
  if constexpr (!Even)
  {
    const FloatMask isKnown = places.AreKnown();
    result.Misses = result.Misses & isKnown;
    result.Hits = result.Hits & isKnown;
  }
  return result;
}

/// The corners of cells in single precision, less the isovalue. Returns the largest size.
template <typename T>
SIMD_INLINE Floats LoadRoughDifferences(
  const void* const* first, const std::ptrdiff_t strides[3], Floats isovalue, Floats values[8])
{
  Floats largest = 0.0F;
  for (int row = 0; row < 4; ++row)
  {
    Floats* pair = &values[2 * row];
    LoadRowOfFloats<T>(first, row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
    for (int x = 0; x < 2; ++x)
    {
      pair[x] = pair[x] - isovalue;
      largest = MaxAbs(largest, pair[x]);
    }
  }
  return largest;
}

template <typename T, bool Even>
SIMD_INLINE void ClassifyBetween(const PassedCells& cells, int axis,
  const std::ptrdiff_t strides[3], const ScaledIsovalue& isovalue, Passages& passages,
  Candidates& candidates, RaySet hits[2])
{
  // For other magnitudes nothing is known.
  const float least = isovalue.Scale == 1.0 ? 0x1p-100F : FloatInfinity;
  const auto rounded = static_cast<float>(isovalue.Isovalue);
  const Floats isovalueError = least + 0x1p-22F * (rounded < 0.0F ? -rounded : rounded);
  // The order of the axis and those across, in that of the corners.
  const int order[3] = { axis, AxisU[axis], AxisV[axis] };
  for (int i = 0; i < cells.Count; i += FloatWidth)
  {
    const RoughCells rough = LoadCells<Even>(passages, &cells.Codes[i], order);
    const RoughSegments segments = FindRoughSegments<Even>(rough);
    Floats values[8];
    const Floats largest = LoadRoughDifferences<T>(&cells.First[i], strides, rounded, values);
    const Classification classification =
      Classify<Even>(values, largest, isovalueError, order, rough, segments);
    const unsigned int lanes = (1U << SmallerOf(cells.Count - i, FloatWidth)) - 1U;
    const unsigned int sure = ToBits(classification.Hits);
    const unsigned int rising = ToBits(classification.Rise);
    for (unsigned int left = lanes & ~ToBits(classification.Misses); left != 0; left &= left - 1)
    {
      const int lane = LowestBit(left);
      const unsigned int code = cells.Codes[i + lane];
      const unsigned int passage = code & 0xFFFFU;
      const unsigned int bit = code >> 24;
      const Passages::Segment& segment = passages.Segments[passage];
      const int* first = passages.First[segment.Block];
      const int index = candidates.Count++;
      candidates.Ray[index] = segment.Ray;
      candidates.Cell[order[0]][index] = first[order[0]] + static_cast<int>(code >> 16 & 0xFFU);
      candidates.Cell[order[1]][index] = first[order[1]] + static_cast<int>(bit & 7U);
      candidates.Cell[order[2]][index] = first[order[2]] + static_cast<int>(bit >> 3);
      candidates.First[index] = cells.First[i + lane];
      const unsigned int isSure = sure >> lane & 1U;
      passages.Hits[passage] = passages.Hits[passage] || isSure != 0;
      RaySet& hitsOfDirection = hits[rising >> lane & 1U];
      hitsOfDirection.Words[segment.Ray >> 6] |= static_cast<std::uint64_t>(isSure)
        << (segment.Ray & 63);
    }
  }
}

template <typename T>
void ClassifyCells(const PassedCells& cells, int axis, const std::ptrdiff_t strides[3],
  const ScaledIsovalue& isovalue, Passages& passages, Candidates& candidates, RaySet hits[2])
{
  if (passages.AreUneven)
  {
    ClassifyBetween<T, false>(cells, axis, strides, isovalue, passages, candidates, hits);
  }
  else
  {
    ClassifyBetween<T, true>(cells, axis, strides, isovalue, passages, candidates, hits);
  }
}

template <typename T>
void FindRanges(
  const PassedCells& cells, const std::ptrdiff_t strides[3], float* lowest, float* highest)
{
  for (int i = 0; i < cells.Count; i += FloatWidth)
  {
    Floats low = FloatInfinity;
    Floats high = -FloatInfinity;
    for (int row = 0; row < 4; ++row)
    {
      Floats pair[2];
      LoadRowOfFloats<T>(
        &cells.First[i], row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
      low = Min(low, Min(pair[0], pair[1]));
      high = Max(high, Max(pair[0], pair[1]));
    }
    StoreFloats(low, &lowest[i]);
    StoreFloats(high, &highest[i]);
  }
}

}
}
