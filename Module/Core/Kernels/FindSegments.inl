// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Segments of rays in projected tetrahedra. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The pixels whose rays may pass a tetrahedron; a bit for each lane.
SIMD_INLINE unsigned int FindInOutline(
  const ProjectedTetrahedra& projected, int number, Floats columns, Floats rows)
{
  Floats least = 0.0F;
  for (int i = 0; i < ProjectedTetrahedra::Edges; ++i)
  {
    const Floats a = projected.OutlineA[i][number];
    const Floats b = projected.OutlineB[i][number];
    const Floats c = projected.OutlineC[i][number];
    least = Min(least, MultiplyAdd(columns, a, MultiplyAdd(rows, b, c)));
  }
  return ((1U << FloatWidth) - 1U) & ~ToBits(least < 0.0F);
}

/// The labels of the first pixels of a tile, a vector of them in one row or in several.
struct PixelLabels
{
  alignas(64) float Column[FloatWidth];
  alignas(64) float Row[FloatWidth];

  constexpr explicit PixelLabels(int columns)
    : Column{}
    , Row{}
  {
    for (int i = 0; i < FloatWidth; ++i)
    {
      this->Column[i] = static_cast<float>(i % columns - CloudTile::Middle);
      this->Row[i] = static_cast<float>(i / columns - CloudTile::Middle);
    }
  }
};

/// Finds the pixels whose rays may pass a tetrahedron, of those that are open.
SIMD_INLINE int FindCovered(
  const CloudTile& tile, const ProjectedTetrahedra& projected, int number, int* pixels)
{
  const int firstColumn = projected.FirstColumn[number];
  const int lastColumn = projected.LastColumn[number];
  const int lastRow = projected.LastRow[number];
  const std::uint32_t inRange = (~0U << firstColumn) & (~0U >> (31 - lastColumn));
  // A vector of floats is two of doubles: next to each other in a row, or one in each of two rows.
  const bool isNarrow = lastColumn - firstColumn < DoubleWidth;
  const int columnsAtOnce = isNarrow ? DoubleWidth : FloatWidth;
  const int rowsAtOnce = isNarrow ? 2 : 1;
  static constexpr PixelLabels ofRow(FloatWidth);
  static constexpr PixelLabels ofTwoRows(DoubleWidth);
  const Floats columns = LoadFloats(isNarrow ? ofTwoRows.Column : ofRow.Column);
  const Floats rows = LoadFloats(isNarrow ? ofTwoRows.Row : ofRow.Row);
  constexpr std::uint32_t half = (1U << DoubleWidth) - 1U;
  int count = 0;
  for (int row = projected.FirstRow[number]; row <= lastRow; row += rowsAtOnce)
  {
    const std::uint32_t open = tile.Open[row] & inRange;
    const std::uint32_t openNext = isNarrow && row < lastRow ? tile.Open[row + 1] & inRange : 0;
    for (int first = firstColumn; (open | openNext) != 0 && first <= lastColumn;
         first += columnsAtOnce)
    {
      const std::uint32_t lanes = isNarrow
        ? (open >> first & half) | (openNext >> first & half) << DoubleWidth
        : open >> first;
      const std::uint32_t covered = lanes &
        FindInOutline(
          projected, number, columns + static_cast<float>(first), rows + static_cast<float>(row));
      const int pixel = row * CloudTile::Edge + first;
      count += AppendLanes(pixel, covered & half, pixels + count);
      count += AppendLanes(
        pixel + (isNarrow ? CloudTile::Edge : DoubleWidth), covered >> DoubleWidth, pixels + count);
    }
  }
  return count;
}

/// The crossings of a face by a vector of rays: depths, and some numbers that are linear in
/// tetrahedra.
template <int Numbers>
struct FaceCrossings
{
  Doubles Depth;
  Doubles Number[Numbers];

  /// Given the corners and the areas opposite to them: a function of face and ray alone, which does
  /// not depend on the side that the face is seen from. All are between those of the corners.
  SIMD_INLINE FaceCrossings(
    const Doubles areas[3], const Doubles depths[3], const Doubles (&numbers)[Numbers][3])
  {
    const Doubles sum = areas[0] + areas[1] + areas[2];
    // All have one sign, but for rounding.
    const Doubles sign = CopySign(Doubles(1.0), sum);
    const Doubles weights[3] = { Max(areas[0] * sign, Doubles(0.0)),
      Max(areas[1] * sign, Doubles(0.0)), Max(areas[2] * sign, Doubles(0.0)) };
    const Doubles total = weights[0] + weights[1] + weights[2];
    const Mask hasArea = 0x1p-900 < total;
    const Doubles inverse = 1.0 / total;
    const Doubles second = Select(hasArea, weights[1] * inverse, Doubles(1.0 / 3.0));
    const Doubles third = Select(hasArea, weights[2] * inverse, Doubles(1.0 / 3.0));
    const auto interpolate = [&](const Doubles at[3])
    { return at[0] + (second * (at[1] - at[0]) + third * (at[2] - at[0])); };
    this->Depth = interpolate(depths);
    for (int i = 0; i < Numbers; ++i)
    {
      this->Number[i] = interpolate(numbers[i]);
    }
  }
};

/// The parts of a vector of rays that are in a tetrahedron: the depths at both ends, and the values
/// and gradients there.
template <int Components, int Gradients>
struct RayParts
{
  static constexpr int Numbers = Components + 3 * Gradients;

  Doubles Depth[2];
  Doubles Number[Numbers][2];

  /// Cuts them to where the rays are. Returns which are left.
  SIMD_INLINE Mask CutToRays(const CloudTile& tile, const int* pixels)
  {
    const Doubles begin = Gather(tile.Begin, pixels);
    const Doubles end = Gather(tile.End, pixels);
    const Mask isLeft = (begin < this->Depth[1]) & (this->Depth[0] < end);
    const Mask isBegun = this->Depth[0] < begin;
    const Mask isEnded = end < this->Depth[1];
    if (Any(isLeft & (isBegun | isEnded)))
    {
      const RayParts whole = *this;
      this->Cut(whole, 0, isBegun, begin);
      this->Cut(whole, 1, isEnded, end);
    }
    return isLeft;
  }

  /// Puts some of them behind segments.
  SIMD_INLINE void Append(const int* pixels, unsigned int lanes, CloudSegments& segments) const
  {
    const int count = CopyLanes(pixels, lanes, &segments.Pixel[segments.Count]);
    for (int end = 0; end < 2; ++end)
    {
      StoreLanes(this->Depth[end], lanes, &segments.Depth[end][segments.Count]);
      for (int i = 0; i < Components; ++i)
      {
        StoreLanes(this->Number[i][end], lanes, &segments.Value[i][end][segments.Count]);
      }
      for (int i = Components; i < Numbers; ++i)
      {
        double wide[DoubleWidth];
        StoreLanes(this->Number[i][end], lanes, wide);
        for (int k = 0; k < count; ++k)
        {
          segments.Gradient[i - Components][end][segments.Count + k] = static_cast<float>(wide[k]);
        }
      }
    }
    segments.Count += count;
  }

private:
  /// Moves an end of other parts to a depth, where that is inside.
  SIMD_INLINE void Cut(const RayParts& whole, int end, Mask isCut, Doubles at)
  {
    const Doubles fraction = (at - whole.Depth[0]) / (whole.Depth[1] - whole.Depth[0]);
    this->Depth[end] = Select(isCut, at, whole.Depth[end]);
    for (int i = 0; i < Numbers; ++i)
    {
      const Doubles there = Lerp(whole.Number[i][0], whole.Number[i][1], fraction);
      this->Number[i][end] = Select(isCut, there, whole.Number[i][end]);
    }
  }
};

/// A vector of rays and one tetrahedron.
template <int Components, int Gradients>
class RaysInTetrahedron
{
public:
  using Parts = RayParts<Components, Gradients>;

  SIMD_INLINE RaysInTetrahedron(
    const ProjectedTetrahedra& projected, int number, Doubles column, Doubles row)
  {
    Doubles least = Infinity;
    for (int i = 0; i < ProjectedTetrahedra::Edges; ++i)
    {
      this->Area[i] =
        column * projected.A[i][number] + (row * projected.B[i][number] + projected.C[i][number]);
      this->IsLeft[i] = 0.0 < this->Area[i];
      least = Min(least, Abs(this->Area[i]));
    }
    this->HasExact = Any(least <= projected.LargestRounding[number]);
    if (this->HasExact)
    {
      this->DecideExactly(projected, number, column, row);
    }
  }

  /// Finds the two faces that are crossed. Returns which rays pass the tetrahedron.
  SIMD_INLINE Mask Find(const ProjectedTetrahedra& projected, int number, Parts& parts) const
  {
    const Mask crosses012 = this->Crosses(0, 3, 1);
    const Mask crosses013 = this->Crosses(0, 4, 2);
    const Mask crosses023 = this->Crosses(1, 5, 2);
    const Mask crosses123 = this->Crosses(3, 5, 4);
    // Of the crossed faces, in this order, the first one has corner 0 and the last one corner 3.
    const Mask is023 = AndNot(AndNot(crosses023, crosses013), crosses012);
    const Mask is013 = AndNot(AndNot(crosses013, crosses023), crosses123);
    const Crossings one = this->MakeOne(projected, number, crosses012, is023);
    const Crossings other = this->MakeOther(projected, number, is013, crosses123);
    const Mask isOneFirst = one.Depth < other.Depth;
    parts.Depth[0] = Select(isOneFirst, one.Depth, other.Depth);
    parts.Depth[1] = Select(isOneFirst, other.Depth, one.Depth);
    for (int i = 0; i < Parts::Numbers; ++i)
    {
      parts.Number[i][0] = Select(isOneFirst, one.Number[i], other.Number[i]);
      parts.Number[i][1] = Select(isOneFirst, other.Number[i], one.Number[i]);
    }
    return (crosses012 | crosses013 | crosses023) & (parts.Depth[0] < parts.Depth[1]);
  }

private:
  using Crossings = FaceCrossings<Parts::Numbers>;

  /// Where rounding might decide, the signs are exact, see FrameEdge. All areas are found that are
  /// exact but for their last digit, too.
  void DecideExactly(const ProjectedTetrahedra& projected, int number, Doubles column, Doubles row)
  {
    FramePointOf<Doubles> points[4];
    for (int i = 0; i < 4; ++i)
    {
      points[i].X = projected.X[i][number] - column * projected.W[i][number];
      points[i].Y = projected.Y[i][number] - row * projected.W[i][number];
      points[i].T = 0.0;
    }
    int edge = 0;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = i + 1; k < 4; ++k, ++edge)
      {
        const Mask isUnsure = Abs(this->Area[edge]) <= projected.Rounding[edge][number];
        this->Unsure[edge] = Select(isUnsure, Doubles(1.0), Doubles(0.0));
        const FramePointOf<Doubles>& a = points[i];
        const FramePointOf<Doubles>& b = points[k];
        const Mask isLeft = FrameEdge<Doubles>(a, b).IsLeft;
        this->IsLeft[edge] = (isUnsure & isLeft) | AndNot(this->IsLeft[edge], isUnsure);
        const Doubles one = a.X * b.Y;
        const Doubles other = b.X * a.Y;
        const Doubles rest =
          FusedMultiplyAdd(a.X, b.Y, 0.0 - one) - FusedMultiplyAdd(b.X, a.Y, 0.0 - other);
        this->Exact[edge] = (one - other) + rest;
      }
    }
  }

  /// Whether rays cross the face with the edges ab, bc and ac.
  SIMD_INLINE Mask Crosses(int ab, int bc, int ac) const
  {
    return AndNot(this->IsLeft[ab] ^ this->IsLeft[ac], this->IsLeft[ab] ^ this->IsLeft[bc]);
  }

  /// The areas of a face, given what takes those of its edges. They are exact if one of its edges
  /// is unsure: so the crossings of faces that are seen edge-on are in order, and both cells that
  /// have the face agree.
  template <typename Take>
  SIMD_INLINE void FindAreas(const Take& take, Doubles areas[3]) const
  {
    take(this->Area, areas);
    if (this->HasExact)
    {
      Doubles exact[3];
      Doubles unsure[3];
      take(this->Exact, exact);
      take(this->Unsure, unsure);
      const Mask isExact = 0.0 < Abs(unsure[0]) + Abs(unsure[1]) + Abs(unsure[2]);
      for (int i = 0; i < 3; ++i)
      {
        areas[i] = Select(isExact, exact[i], areas[i]);
      }
    }
  }

  /// The face of the corners 0, 1 or 2, and 2 or 3.
  SIMD_INLINE Crossings MakeOne(
    const ProjectedTetrahedra& projected, int number, Mask is012, Mask is023) const
  {
    Doubles areas[3];
    this->FindAreas(
      [&](const Doubles(&of)[ProjectedTetrahedra::Edges], Doubles taken[3])
      {
        taken[0] = Select(is012, of[3], Select(is023, of[5], of[4]));
        taken[1] = 0.0 - Select(is012, of[1], of[2]);
        taken[2] = Select(is023, of[1], of[0]);
      },
      areas);
    const auto take = [&](const double(*of)[ProjectedTetrahedra::Capacity], Doubles numbers[3])
    {
      numbers[0] = of[0][number];
      numbers[1] = Select(is023, Doubles(of[2][number]), Doubles(of[1][number]));
      numbers[2] = Select(is012, Doubles(of[2][number]), Doubles(of[3][number]));
    };
    return TakeCorners(areas, take, projected);
  }

  /// The face of the corners 0 or 1, 1 or 2, and 3.
  SIMD_INLINE Crossings MakeOther(
    const ProjectedTetrahedra& projected, int number, Mask is013, Mask is123) const
  {
    Doubles areas[3];
    this->FindAreas(
      [&](const Doubles(&of)[ProjectedTetrahedra::Edges], Doubles taken[3])
      {
        taken[0] = Select(is013, of[4], of[5]);
        taken[1] = 0.0 - Select(is123, of[4], of[2]);
        taken[2] = Select(is013, of[0], Select(is123, of[3], of[1]));
      },
      areas);
    const auto take = [&](const double(*of)[ProjectedTetrahedra::Capacity], Doubles numbers[3])
    {
      numbers[0] = Select(is123, Doubles(of[1][number]), Doubles(of[0][number]));
      numbers[1] = Select(is013, Doubles(of[1][number]), Doubles(of[2][number]));
      numbers[2] = of[3][number];
    };
    return TakeCorners(areas, take, projected);
  }

  /// Given what takes the numbers of three corners.
  template <typename Take>
  SIMD_INLINE static Crossings TakeCorners(
    const Doubles areas[3], const Take& take, const ProjectedTetrahedra& projected)
  {
    Doubles depths[3];
    Doubles numbers[Parts::Numbers][3];
    take(projected.Depth, depths);
    for (int i = 0; i < Components; ++i)
    {
      take(projected.Value[i], numbers[i]);
    }
    for (int i = 0; i < 3 * Gradients; ++i)
    {
      take(projected.Gradient[i], numbers[Components + i]);
    }
    return { areas, depths, numbers };
  }

  Doubles Area[ProjectedTetrahedra::Edges];
  /// Where any may be unsure, areas that are exact, and 1 for those that are unsure.
  bool HasExact;
  Doubles Exact[ProjectedTetrahedra::Edges];
  Doubles Unsure[ProjectedTetrahedra::Edges];
  Mask IsLeft[ProjectedTetrahedra::Edges];
};

/// The depths between which all rays of a tile are there.
struct CommonDepths
{
  double Begin;
  double End;

  SIMD_INLINE explicit CommonDepths(const CloudTile& tile)
  {
    Doubles begin = -Infinity;
    Doubles end = Infinity;
    for (int row = 0; row < tile.Rows; ++row)
    {
      for (int column = 0; column < tile.Columns; column += DoubleWidth)
      {
        const int pixel = row * CloudTile::Edge + column;
        begin = Max(begin, Load(&tile.Begin[pixel]));
        end = Min(end, Load(&tile.End[pixel]));
      }
    }
    this->Begin = ReduceMax(begin);
    this->End = ReduceMin(end);
  }

  /// Whether a tetrahedron is between them.
  SIMD_INLINE bool Hold(const ProjectedTetrahedra& projected, int number) const
  {
    return this->Begin < projected.Nearest[number] && projected.Farthest[number] < this->End;
  }
};

template <int Components, int Gradients>
int FindSegments(
  const CloudTile& tile, const ProjectedTetrahedra& projected, int number, CloudSegments& segments)
{
  using Rays = RaysInTetrahedron<Components, Gradients>;
  using Parts = typename Rays::Parts;
  segments.Components = Components;
  segments.Gradients = Gradients;
  const CommonDepths common(tile);
  int pixels[CloudTile::Capacity + DoubleWidth];
  for (; number < projected.Count && segments.Count < segments.Enough; ++number)
  {
    if (projected.LastColumn[number] < projected.FirstColumn[number] ||
      projected.LastRow[number] < projected.FirstRow[number])
    {
      continue;
    }
    const int count = FindCovered(tile, projected, number, pixels);
    for (int i = count; i < count + DoubleWidth; ++i)
    {
      pixels[i] = 0;
    }
    const bool isWhole = common.Hold(projected, number);
    for (int first = 0; first < count; first += DoubleWidth)
    {
      const Doubles pixel = LoadIntegers(pixels + first);
      const Doubles row = Floor(pixel * (1.0 / CloudTile::Edge));
      const Doubles column = pixel - row * CloudTile::Edge;
      const Doubles middle = CloudTile::Middle;
      const Rays rays(projected, number, column - middle, row - middle);
      Parts parts;
      Mask isPassed = rays.Find(projected, number, parts);
      if (!isWhole)
      {
        isPassed = isPassed & parts.CutToRays(tile, pixels + first);
      }
      const unsigned int lanes =
        ToBits(isPassed) & ((1U << SmallerOf(count - first, DoubleWidth)) - 1U);
      parts.Append(pixels + first, lanes, segments);
    }
  }
  return number;
}

}
}
