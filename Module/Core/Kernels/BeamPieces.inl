// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What the rays of a beam may meet in a mesh. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// What rounding may move labels by, in units of the labels.
constexpr float LabelMargin = 0x1p-18F;

/// The children with values on both sides of an isovalue.
SIMD_INLINE unsigned int FindActive(
  const CellTreeNode& node, int first, const IsovalueSpan* isovalues, int count)
{
  const Floats low = LoadFloats(&node.Low[first]);
  const Floats high = LoadFloats(&node.High[first]);
  unsigned int active = 0;
  for (int k = 0; k < count; ++k)
  {
    active |= ~ToBits((isovalues[k].Before < low) | (high < isovalues[k].From));
  }
  return active & ((1U << FloatWidth) - 1U);
}

unsigned int ProjectChildren(const CellTreeNode& node, const BeamProjection& beam,
  const IsovalueSpan* isovalues, int count, LabelBounds& bounds)
{
  constexpr auto infinity = static_cast<float>(Infinity);
  unsigned int found = 0;
  for (int i = 0; i < CellTreeNode::Width; i += FloatWidth)
  {
    const unsigned int active = FindActive(node, i, isovalues, count);
    if (active == 0)
    {
      continue;
    }
    // The two ends of the boxes along the beam.
    const Floats z[2] = { LoadFloats(&node.Lower[beam.Along][i]) - beam.Plane + beam.PlaneRest,
      LoadFloats(&node.Upper[beam.Along][i]) - beam.Plane + beam.PlaneRest };
    const Floats w[2] = { MultiplyAdd(beam.Spread, z[0], 1.0F),
      MultiplyAdd(beam.Spread, z[1], 1.0F) };
    const Floats inverse[2] = { ApproximateReciprocal(w[0]), ApproximateReciprocal(w[1]) };
    const FloatMask isNear = (w[0] < beam.SmallestW) | (w[1] < beam.SmallestW);
    // Where all of the box is behind the point where the rays meet.
    FloatMask isOutside = (w[0] < -beam.SmallestW) & (w[1] < -beam.SmallestW);
    for (int k = 0; k < 2; ++k)
    {
      const Floats left = LoadFloats(&node.Lower[beam.Across[k]][i]) - beam.Center[k];
      const Floats right = LoadFloats(&node.Upper[beam.Across[k]][i]) - beam.Center[k];
      const Floats lowest = beam.Scale * (left + beam.CenterRest[k]) - beam.Error;
      const Floats highest = beam.Scale * (right + beam.CenterRest[k]) + beam.Error;
      const Floats shift[2] = { beam.Slope[k] * z[0], beam.Slope[k] * z[1] };
      Floats lower = Min((lowest - shift[0]) * inverse[0], (lowest - shift[1]) * inverse[1]);
      Floats upper = Max((highest - shift[0]) * inverse[0], (highest - shift[1]) * inverse[1]);
      lower = Select(isNear, -infinity, lower - beam.RelativeError * Abs(lower));
      upper = Select(isNear, infinity, upper + beam.RelativeError * Abs(upper));
      isOutside = isOutside | (1.0F < lower) | (upper < -1.0F);
      StoreFloats(lower, &bounds.Lower[k][i]);
      StoreFloats(upper, &bounds.Upper[k][i]);
    }
    const Floats near = beam.IsUp ? z[0] : 0.0F - z[1];
    StoreFloats(near - beam.DepthError, &bounds.Near[i]);
    found |= (active & ~ToBits(isOutside)) << i;
  }
  return found;
}

//------------------------------------------------------------------------------
/// Where edges between corners of some cells meet the surface, as a label.
struct EdgePoints
{
  Floats X;
  Floats Y;
  Floats Depth;
};

struct EdgeEnds
{
  Floats X;
  Floats Y;
  Floats W;
  Floats Depth;
  Floats Difference;
};

SIMD_INLINE EdgeEnds LoadEnds(const BeamCells& cells, int corner, int first)
{
  return { LoadFloats(&cells.X[corner][first]), LoadFloats(&cells.Y[corner][first]),
    LoadFloats(&cells.W[corner][first]), LoadFloats(&cells.Depth[corner][first]),
    LoadFloats(&cells.Difference[corner][first]) };
}

SIMD_INLINE EdgeEnds Select(FloatMask mask, const EdgeEnds& yes, const EdgeEnds& no)
{
  return { Select(mask, yes.X, no.X), Select(mask, yes.Y, no.Y), Select(mask, yes.W, no.W),
    Select(mask, yes.Depth, no.Depth), Select(mask, yes.Difference, no.Difference) };
}

SIMD_INLINE EdgePoints MeetSurface(const EdgeEnds& a, const EdgeEnds& b)
{
  const Floats fraction = a.Difference * ApproximateReciprocal(a.Difference - b.Difference);
  const Floats inverse = ApproximateReciprocal(MultiplyAdd(fraction, b.W - a.W, a.W));
  return { MultiplyAdd(fraction, b.X - a.X, a.X) * inverse,
    MultiplyAdd(fraction, b.Y - a.Y, a.Y) * inverse,
    MultiplyAdd(fraction, b.Depth - a.Depth, a.Depth) };
}

/// The bounds of points.
struct PointBounds
{
  Floats Lower[2] = { static_cast<float>(Infinity), static_cast<float>(Infinity) };
  Floats Upper[2] = { -static_cast<float>(Infinity), -static_cast<float>(Infinity) };
  Floats Near = static_cast<float>(Infinity);

  SIMD_INLINE void Include(const EdgePoints& points)
  {
    this->Lower[0] = Min(this->Lower[0], points.X);
    this->Lower[1] = Min(this->Lower[1], points.Y);
    this->Upper[0] = Max(this->Upper[0], points.X);
    this->Upper[1] = Max(this->Upper[1], points.Y);
    this->Near = Min(this->Near, points.Depth);
  }
};

/// What rounding may move the labels of points between the corners of cells by.
SIMD_INLINE Floats FindMargin(const BeamCells& cells, int corners, int first, float margin)
{
  Floats size = 0.0F;
  Floats least = static_cast<float>(Infinity);
  for (int corner = 0; corner < corners; ++corner)
  {
    const Floats w = LoadFloats(&cells.W[corner][first]);
    size = Max(size, Abs(LoadFloats(&cells.X[corner][first])));
    size = Max(size, Abs(LoadFloats(&cells.Y[corner][first])));
    size = Max(size, w);
    least = Min(least, w);
  }
  return MultiplyAdd(size * LabelMargin, ApproximateReciprocal(least), margin);
}

SIMD_INLINE void StoreBounds(
  const PointBounds& bounds, Floats margin, int first, BeamPieces& pieces)
{
  for (int i = 0; i < 2; ++i)
  {
    StoreFloats(bounds.Lower[i] - margin, &pieces.Bounds.Lower[i][first]);
    StoreFloats(bounds.Upper[i] + margin, &pieces.Bounds.Upper[i][first]);
  }
  StoreFloats(bounds.Near, &pieces.Bounds.Near[first]);
}

SIMD_INLINE void StoreLine(Floats a, Floats b, Floats c, int line, int first, BeamPieces& pieces)
{
  StoreFloats(a, &pieces.Line[line][0][first]);
  StoreFloats(b, &pieces.Line[line][1][first]);
  StoreFloats(c, &pieces.Line[line][2][first]);
}

void OpenUnbounded(const BeamCells& cells, BeamPieces& pieces)
{
  constexpr auto infinity = static_cast<float>(Infinity);
  for (std::uint32_t left = cells.Unbounded; left != 0; left &= left - 1)
  {
    const int i = __builtin_ctz(left);
    LabelBounds& bounds = pieces.Bounds;
    bounds.Lower[0][i] = bounds.Lower[1][i] = bounds.Near[i] = -infinity;
    bounds.Upper[0][i] = bounds.Upper[1][i] = infinity;
    for (auto& line : pieces.Line)
    {
      line[0][i] = line[1][i] = line[2][i] = 0.0F;
    }
  }
}

/// In a tetrahedron the piece is a triangle or a quadrangle.
void BoundTetrahedra(const BeamCells& cells, float rayMargin, BeamPieces& pieces)
{
  for (int first = 0; first < cells.Count; first += FloatWidth)
  {
    EdgeEnds ends[4];
    for (int i = 0; i < 4; ++i)
    {
      ends[i] = LoadEnds(cells, i, first);
    }
    // In order around the piece; of a triangle the last two points are one.
    const FloatMask isTwoByTwo = 0.5F < LoadFloats(&cells.IsTwoByTwo[first]);
    const EdgeEnds from = Select(isTwoByTwo, ends[1], ends[0]);
    const EdgePoints points[4] = { MeetSurface(ends[0], ends[2]), MeetSurface(ends[0], ends[3]),
      MeetSurface(from, Select(isTwoByTwo, ends[3], ends[1])),
      MeetSurface(from, Select(isTwoByTwo, ends[2], ends[1])) };
    PointBounds bounds;
    for (const EdgePoints& point : points)
    {
      bounds.Include(point);
    }
    const Floats margin = FindMargin(cells, 4, first, rayMargin);
    StoreBounds(bounds, margin, first, pieces);

    const Floats area = (points[2].X - points[0].X) * (points[3].Y - points[1].Y) -
      (points[2].Y - points[0].Y) * (points[3].X - points[1].X);
    const Floats size =
      bounds.Upper[0] - bounds.Lower[0] + bounds.Upper[1] - bounds.Lower[1] + margin;
    // What the margin of the ends of an edge makes across the piece.
    const Floats slack = 4.0F * margin * size;
    // Of a piece seen edge on, the orientation is not certain.
    const FloatMask isFlat = Abs(area) < 4.0F * slack;
    const Floats sign = Select(isFlat, 0.0F, CopySign(1.0F, area));
    for (int i = 0; i < BeamPieces::Lines; ++i)
    {
      const EdgePoints& p = points[i];
      const EdgePoints& q = points[(i + 1) % 4];
      const Floats a = sign * (p.Y - q.Y);
      const Floats b = sign * (q.X - p.X);
      const Floats c = MultiplyAdd(2.0F * margin, Abs(a) + Abs(b), slack) - (a * p.X + b * p.Y);
      StoreLine(a, b, c, i, first, pieces);
    }
  }
  OpenUnbounded(cells, pieces);
}

/// A trilinear cell is, with its values, in the convex hull of its corners; so the piece is in that
/// of the points where segments between corners on both sides meet the surface. It is bounded by
/// an octagon.
void BoundTrilinear(const BeamCells& cells, float rayMargin, BeamPieces& pieces)
{
  constexpr auto infinity = static_cast<float>(Infinity);
  for (int first = 0; first < cells.Count; first += FloatWidth)
  {
    PointBounds bounds;
    Floats least[2] = { infinity, infinity };
    Floats most[2] = { -infinity, -infinity };
    for (int i = 0; i < 7; ++i)
    {
      const EdgeEnds a = LoadEnds(cells, i, first);
      for (int j = i + 1; j < 8; ++j)
      {
        const EdgeEnds b = LoadEnds(cells, j, first);
        const FloatMask crosses = HaveDifferentSigns(a.Difference, b.Difference);
        if (ToBits(crosses) == 0)
        {
          continue;
        }
        EdgePoints point = MeetSurface(a, b);
        const Floats sum = point.X + point.Y;
        const Floats difference = point.X - point.Y;
        bounds.Lower[0] = Select(crosses, Min(bounds.Lower[0], point.X), bounds.Lower[0]);
        bounds.Lower[1] = Select(crosses, Min(bounds.Lower[1], point.Y), bounds.Lower[1]);
        bounds.Upper[0] = Select(crosses, Max(bounds.Upper[0], point.X), bounds.Upper[0]);
        bounds.Upper[1] = Select(crosses, Max(bounds.Upper[1], point.Y), bounds.Upper[1]);
        bounds.Near = Select(crosses, Min(bounds.Near, point.Depth), bounds.Near);
        least[0] = Select(crosses, Min(least[0], sum), least[0]);
        most[0] = Select(crosses, Max(most[0], sum), most[0]);
        least[1] = Select(crosses, Min(least[1], difference), least[1]);
        most[1] = Select(crosses, Max(most[1], difference), most[1]);
      }
    }
    const Floats margin = FindMargin(cells, 8, first, rayMargin);
    StoreBounds(bounds, margin, first, pieces);
    const Floats one = 1.0F;
    const Floats two = 2.0F * margin;
    StoreLine(one, one, two - least[0], 0, first, pieces);
    StoreLine(0.0F - one, 0.0F - one, two + most[0], 1, first, pieces);
    StoreLine(one, 0.0F - one, two - least[1], 2, first, pieces);
    StoreLine(0.0F - one, one, two + most[1], 3, first, pieces);
  }
  OpenUnbounded(cells, pieces);
}

//------------------------------------------------------------------------------
/// The groups of rays that may meet what is in some bounds; a bit for each.
SIMD_INLINE unsigned int FindGroups(const LabelBounds& bounds, int number, const BeamRays& rays)
{
  unsigned int found = 0;
  for (int i = 0; i < BeamRays::Groups; i += FloatWidth)
  {
    const FloatMask isBeside = (LoadFloats(&rays.Upper[0][i]) < bounds.Lower[0][number]) |
      (LoadFloats(&rays.Upper[1][i]) < bounds.Lower[1][number]) |
      (bounds.Upper[0][number] < LoadFloats(&rays.Lower[0][i])) |
      (bounds.Upper[1][number] < LoadFloats(&rays.Lower[1][i])) |
      (LoadFloats(&rays.GroupEnd[i]) < bounds.Near[number]);
    found |= (~ToBits(isBeside) & ((1U << FloatWidth) - 1U)) << i;
  }
  return found & ((1U << BeamRays::Groups) - 1U);
}

/// The bounds that some of the rays may meet; a bit for each.
SIMD_INLINE unsigned int FindNear(const LabelBounds& bounds, int count, const BeamRays& rays)
{
  unsigned int near = 0;
  for (int i = 0; i < count; i += FloatWidth)
  {
    const FloatMask isBeside = (rays.UpperOfAll[0] < LoadFloats(&bounds.Lower[0][i])) |
      (rays.UpperOfAll[1] < LoadFloats(&bounds.Lower[1][i])) |
      (LoadFloats(&bounds.Upper[0][i]) < rays.LowerOfAll[0]) |
      (LoadFloats(&bounds.Upper[1][i]) < rays.LowerOfAll[1]) |
      (rays.EndOfAll < LoadFloats(&bounds.Near[i]));
    near |= (~ToBits(isBeside) & ((1U << FloatWidth) - 1U)) << i;
  }
  return near & ((1U << count) - 1U);
}

unsigned int FindPassed(const LabelBounds& bounds, int count, const BeamRays& rays)
{
  unsigned int passed = 0;
  for (unsigned int near = FindNear(bounds, count, rays); near != 0; near &= near - 1)
  {
    const int number = __builtin_ctz(near);
    passed |= static_cast<unsigned int>(FindGroups(bounds, number, rays) != 0) << number;
  }
  return passed;
}

/// Adds the rays of a group that may meet a piece.
SIMD_INLINE void AddPairs(const BeamPieces& pieces, int piece, int number, const BeamRays& rays,
  int group, BeamPairs& pairs)
{
  const LabelBounds& bounds = pieces.Bounds;
  const int begin = group * BeamRays::GroupSize;
  int count = pairs.Count;
  for (int first = begin; first < begin + BeamRays::GroupSize; first += FloatWidth)
  {
    const Floats a = LoadFloats(&rays.Label[0][first]);
    const Floats b = LoadFloats(&rays.Label[1][first]);
    FloatMask isBeside = (a < bounds.Lower[0][piece]) | (bounds.Upper[0][piece] < a) |
      (b < bounds.Lower[1][piece]) | (bounds.Upper[1][piece] < b) |
      (LoadFloats(&rays.End[first]) < bounds.Near[piece]);
    for (const auto& line : pieces.Line)
    {
      const Floats height =
        MultiplyAdd(line[0][piece], a, MultiplyAdd(line[1][piece], b, line[2][piece]));
      isBeside = isBeside | (height < 0.0F);
    }
    for (unsigned int found = ~ToBits(isBeside) & ((1U << FloatWidth) - 1U); found != 0;
         found &= found - 1)
    {
      pairs.Place[count] = first + __builtin_ctz(found);
      pairs.Piece[count++] = number;
    }
  }
  pairs.Count = count;
}

void FindPairs(const BeamPieces& pieces, int firstPiece, const BeamRays& rays, BeamPairs& pairs)
{
  for (unsigned int near = FindNear(pieces.Bounds, pieces.Count, rays); near != 0; near &= near - 1)
  {
    const int piece = __builtin_ctz(near);
    for (unsigned int groups = FindGroups(pieces.Bounds, piece, rays); groups != 0;
         groups &= groups - 1)
    {
      AddPairs(pieces, piece, firstPiece + piece, rays, __builtin_ctz(groups), pairs);
    }
  }
}

}
}
