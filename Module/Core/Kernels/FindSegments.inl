// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Segments of rays in projected tetrahedra. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The depths of the corners of a face, and the numbers there.
template <int Components, int Gradients>
struct FaceCorners
{
  Doubles Depth[3];
  Doubles Number[Components + 3 * Gradients][3];

  /// Given what takes the numbers of three corners.
  template <typename Take>
  SIMD_INLINE FaceCorners(const Take& take, const ProjectedTetrahedra& projected)
  {
    take(projected.Depth, this->Depth);
    for (int i = 0; i < Components; ++i)
    {
      take(projected.Value[i], this->Number[i]);
    }
    for (int i = 0; i < 3 * Gradients; ++i)
    {
      take(projected.Gradient[i], this->Number[Components + i]);
    }
  }
};

/// The crossings of a face by a vector of rays: depths, and some numbers that are linear in
/// tetrahedra.
template <int Numbers>
struct FaceCrossings
{
  Doubles Depth;
  Doubles Number[Numbers];

  /// Given the corners and the weights of the second and the third, none of which is negative: a
  /// function of face and ray alone, which does not depend on the side that the face is seen from.
  /// All are between those of the corners.
  template <typename Corners>
  SIMD_INLINE FaceCrossings(Doubles second, Doubles third, const Corners& corners)
  {
    const auto interpolate = [&](const Doubles at[3])
    { return at[0] + (second * (at[1] - at[0]) + third * (at[2] - at[0])); };
    this->Depth = interpolate(corners.Depth);
    for (int i = 0; i < Numbers; ++i)
    {
      this->Number[i] = interpolate(corners.Number[i]);
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

  /// Sets them to those between two faces. Returns which have a length.
  SIMD_INLINE Mask SetBetween(
    const FaceCrossings<Numbers>& one, const FaceCrossings<Numbers>& other)
  {
    const Mask isOneFirst = one.Depth < other.Depth;
    this->Depth[0] = Select(isOneFirst, one.Depth, other.Depth);
    this->Depth[1] = Select(isOneFirst, other.Depth, one.Depth);
    for (int i = 0; i < Numbers; ++i)
    {
      this->Number[i][0] = Select(isOneFirst, one.Number[i], other.Number[i]);
      this->Number[i][1] = Select(isOneFirst, other.Number[i], one.Number[i]);
    }
    return this->Depth[0] < this->Depth[1];
  }

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
    // Most often none of the first is left out.
    if ((lanes & (lanes + 1)) == 0)
    {
      std::memcpy(&segments.Pixel[segments.Count], pixels, DoubleWidth * sizeof(int));
      this->AppendWith(
        CountBits(lanes), segments, [](Doubles some, double* to) { Store(some, to); });
    }
    else
    {
      this->AppendWith(CopyLanes(pixels, lanes, &segments.Pixel[segments.Count]), segments,
        [lanes](Doubles some, double* to) { StoreLanes(some, lanes, to); });
    }
  }

private:
  /// Puts so many of them behind segments, given what stores a vector.
  template <typename StoreVector>
  SIMD_INLINE void AppendWith(int count, CloudSegments& segments, const StoreVector& store) const
  {
    for (int end = 0; end < 2; ++end)
    {
      store(this->Depth[end], &segments.Depth[end][segments.Count]);
      for (int i = 0; i < Components; ++i)
      {
        store(this->Number[i][end], &segments.Value[i][end][segments.Count]);
      }
      for (int i = Components; i < Numbers; ++i)
      {
        double wide[DoubleWidth];
        store(this->Number[i][end], wide);
        for (int k = 0; k < count; ++k)
        {
          segments.Gradient[i - Components][end][segments.Count + k] = static_cast<float>(wide[k]);
        }
      }
    }
    segments.Count += count;
  }

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

/// A face of a tetrahedron, and rays that surely cross it.
template <int Components, int Gradients, int Number>
class SureFace
{
public:
  SIMD_INLINE SureFace(const ProjectedTetrahedra& projected, int tetrahedron)
    : Corners(
        [tetrahedron](const double (*of)[ProjectedTetrahedra::Capacity], Doubles numbers[3])
        {
          for (int i = 0; i < 3; ++i)
          {
            numbers[i] = of[Faces[Number].Corners[i]][tetrahedron];
          }
        },
        projected)
  {
    for (int i = 0; i < 3; ++i)
    {
      const int edge = Faces[Number].Edges[i];
      this->A[i] = projected.A[edge][tetrahedron];
      this->B[i] = projected.B[edge][tetrahedron];
      this->C[i] = projected.C[edge][tetrahedron];
    }
  }

  SIMD_INLINE FaceCrossings<Components + 3 * Gradients> Find(Doubles column, Doubles row) const
  {
    Doubles areas[3];
    for (int i = 0; i < 3; ++i)
    {
      areas[i] = Abs(column * this->A[i] + (row * this->B[i] + this->C[i]));
    }
    const Doubles inverse = 1.0 / (areas[0] + areas[1] + areas[2]);
    return { areas[1] * inverse, areas[2] * inverse, this->Corners };
  }

private:
  Doubles A[3];
  Doubles B[3];
  Doubles C[3];
  FaceCorners<Components, Gradients> Corners;
};

/// Rays that surely cross the faces of a pair.
template <int Components, int Gradients, int Pair>
class RaysBetweenFaces
{
public:
  SIMD_INLINE RaysBetweenFaces(const ProjectedTetrahedra& projected, int tetrahedron)
    : One(projected, tetrahedron)
    , Other(projected, tetrahedron)
  {
  }

  /// Finds their parts between the faces. Returns which have a length.
  SIMD_INLINE Mask Find(Doubles column, Doubles row, RayParts<Components, Gradients>& parts) const
  {
    return parts.SetBetween(this->One.Find(column, row), this->Other.Find(column, row));
  }

private:
  SureFace<Components, Gradients, FacePairs[Pair][0]> One;
  SureFace<Components, Gradients, FacePairs[Pair][1]> Other;
};

/// Smaller areas of faces tell no weights of their corners.
constexpr double LeastFaceArea = 0x1p-900;

/// A vector of rays and one tetrahedron that they may pass.
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
    return (crosses012 | crosses013 | crosses023) & parts.SetBetween(one, other);
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

  /// The areas of a face, given what takes those of its edges: none is negative. They are exact if
  /// one of its edges is unsure: so the crossings of faces that are seen edge-on are in order, and
  /// both cells that have the face agree.
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
    // All have one sign, but for rounding.
    const Doubles sign = CopySign(Doubles(1.0), areas[0] + areas[1] + areas[2]);
    for (int i = 0; i < 3; ++i)
    {
      areas[i] = Max(areas[i] * sign, Doubles(0.0));
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
    const Doubles total = areas[0] + areas[1] + areas[2];
    // Without an area, in the middle.
    const Mask hasArea = LeastFaceArea < total;
    const Doubles inverse = 1.0 / total;
    const Doubles second = Select(hasArea, areas[1] * inverse, Doubles(1.0 / 3.0));
    const Doubles third = Select(hasArea, areas[2] * inverse, Doubles(1.0 / 3.0));
    return { second, third, FaceCorners<Components, Gradients>(take, projected) };
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

/// Rays that may pass a tetrahedron near its edges.
template <int Components, int Gradients>
struct RaysNearEdges
{
  const ProjectedTetrahedra& Projected;
  int Number;

  SIMD_INLINE Mask Find(Doubles column, Doubles row, RayParts<Components, Gradients>& parts) const
  {
    const RaysInTetrahedron<Components, Gradients> rays(this->Projected, this->Number, column, row);
    return rays.Find(this->Projected, this->Number, parts);
  }
};

/// What adds the segments that rays have in a tetrahedron.
template <int Components, int Gradients>
struct SegmentAdder
{
  const CloudTile& Tile;
  const ProjectedTetrahedra& Projected;
  int Number;
  const CoveredPixels& Covered;
  /// Whether nothing is cut off from the parts of rays.
  bool AreWhole;
  CloudSegments& Segments;

  /// Adds those of rays between pairs of faces...
  template <int... Pairs>
  SIMD_INLINE void AddSure(std::integer_sequence<int, Pairs...>) const
  {
    (this->AddBetween<Pairs>(), ...);
  }
  /// ...and near edges.
  SIMD_INLINE void AddUnsure() const
  {
    if (this->Covered.GetCount(CoveredPixels::Unsure) > 0)
    {
      this->Add(CoveredPixels::Unsure,
        RaysNearEdges<Components, Gradients>{ this->Projected, this->Number });
    }
  }

private:
  template <int Pair>
  SIMD_INLINE void AddBetween() const
  {
    if (this->Covered.GetCount(Pair) > 0)
    {
      this->Add(Pair, RaysBetweenFaces<Components, Gradients, Pair>(this->Projected, this->Number));
    }
  }

  /// Adds those of a list of pixels, given what finds their parts.
  template <typename Rays>
  SIMD_INLINE void Add(int list, const Rays& rays) const
  {
    const int* pixels = this->Covered.GetPixels(list);
    const int count = this->Covered.GetCount(list);
    for (int first = 0; first < count; first += DoubleWidth)
    {
      ShortVector<std::int32_t, DoubleWidth>::Type pixel;
      std::memcpy(&pixel, pixels + first, sizeof(pixel));
      Doubles column;
      Doubles row;
      Convert((pixel & (CloudTile::Edge - 1)) - CloudTile::Middle, column.Value);
      Convert((pixel >> CloudTile::EdgeBits) - CloudTile::Middle, row.Value);
      RayParts<Components, Gradients> parts;
      Mask isPassed = rays.Find(column, row, parts);
      if (!this->AreWhole)
      {
        isPassed = isPassed & parts.CutToRays(this->Tile, pixels + first);
      }
      const unsigned int lanes =
        ToBits(isPassed) & ((1U << SmallerOf(count - first, DoubleWidth)) - 1U);
      parts.Append(pixels + first, lanes, this->Segments);
    }
  }
};

template <int Components, int Gradients>
int FindSegments(
  const CloudTile& tile, const ProjectedTetrahedra& projected, int number, CloudSegments& segments)
{
  segments.Components = Components;
  segments.Gradients = Gradients;
  const CommonDepths common(tile);
  for (; number < projected.Count && segments.Count < segments.Enough; ++number)
  {
    if (projected.LastColumn[number] < projected.FirstColumn[number] ||
      projected.LastRow[number] < projected.FirstRow[number])
    {
      continue;
    }
    const CoveredPixels covered(tile, projected, number);
    const SegmentAdder<Components, Gradients> adder{ tile, projected, number, covered,
      common.Hold(projected, number), segments };
    adder.AddSure(std::make_integer_sequence<int, PairsOfFaces>{});
    adder.AddUnsure();
  }
  return number;
}

}
}
