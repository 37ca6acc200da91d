// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What the rays of a beam may meet in a mesh. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// What rounding may move labels by, in units of the labels.
constexpr float LabelMargin = 0x1p-18F;
/// Differences that are smaller, as a part of the largest one in a cell, do not keep their ratio in
/// single precision; larger coordinates overflow.
constexpr double SmallestRatio = 1e-30;
constexpr double LargestCoordinate = 1e15;

/// Boxes that reach to a smaller W have any label: more than all points with one, by rounding.
constexpr auto NearW = static_cast<float>(4.0 * SmallestW);

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
    const FloatMask isNear = (w[0] < NearW) | (w[1] < NearW);
    // Where all of the box is behind the point where the rays meet.
    FloatMask isOutside = (w[0] < -NearW) & (w[1] < -NearW);
    // What rounding may have taken off W.
    const float room = 16.0F * (0x1p-20F + std::fabs(beam.Spread) * beam.DepthError);
    for (int k = 0; k < 2; ++k)
    {
      const Floats left = LoadFloats(&node.Lower[beam.Across[k]][i]) - beam.Center[k];
      const Floats right = LoadFloats(&node.Upper[beam.Across[k]][i]) - beam.Center[k];
      const Floats lowest = beam.Scale * (left + beam.CenterRest[k]) - beam.Error;
      const Floats highest = beam.Scale * (right + beam.CenterRest[k]) + beam.Error;
      const Floats shift[2] = { beam.Slope[k] * z[0], beam.Slope[k] * z[1] };
      Floats lower = Min((lowest - shift[0]) * inverse[0], (lowest - shift[1]) * inverse[1]);
      Floats upper = Max((highest - shift[0]) * inverse[0], (highest - shift[1]) * inverse[1]);
      lower = Select(isNear, -FloatInfinity, lower - beam.RelativeError * Abs(lower));
      upper = Select(isNear, FloatInfinity, upper + beam.RelativeError * Abs(upper));
      isOutside = isOutside | (1.0F < lower) | (upper < -1.0F);
      // Boxes that reach beside that point have no labels, but sides of the beam they are beyond.
      isOutside = isOutside |
        ((w[0] + room < lowest - shift[0]) & (w[1] + room < lowest - shift[1])) |
        ((highest - shift[0] < -room - w[0]) & (highest - shift[1] < -room - w[1]));
      StoreFloats(lower, &bounds.Lower[k][i]);
      StoreFloats(upper, &bounds.Upper[k][i]);
    }
    const Floats near = beam.IsUp ? z[0] : 0.0F - z[1];
    const Floats far = beam.IsUp ? z[1] : 0.0F - z[0];
    isOutside = isOutside | (far + beam.DepthError < beam.Begin);
    StoreFloats(near - beam.DepthError, &bounds.Near[i]);
    found |= (active & ~ToBits(isOutside)) << i;
  }
  return found;
}

//------------------------------------------------------------------------------
/// Corners of some cells, projected. The difference is in any unit: its sign is exact.
struct ProjectedCorner
{
  Floats X;
  Floats Y;
  Floats W;
  Floats Depth;
  Floats Difference;
};

SIMD_INLINE ProjectedCorner Select(
  FloatMask mask, const ProjectedCorner& yes, const ProjectedCorner& no)
{
  return { Select(mask, yes.X, no.X), Select(mask, yes.Y, no.Y), Select(mask, yes.W, no.W),
    Select(mask, yes.Depth, no.Depth), Select(mask, yes.Difference, no.Difference) };
}

/// A vector of cells in double precision.
template <int Corners>
struct ProjectedCells
{
  Doubles Points[Corners][5];
  /// Those that cannot be told in single precision, or have corners without a label.
  unsigned int Unbounded;

  SIMD_INLINE ProjectedCells(const PassedCellRecords& records, int first, const BeamNumbers& frame)
  {
    Mask isBounded = FirstLanes(DoubleWidth);
    Doubles largest = 0.0;
    for (int corner = 0; corner < Corners; ++corner)
    {
      const double* rows[DoubleWidth];
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        rows[lane] = records.Corner[first + lane][corner];
      }
      Doubles numbers[4];
      LoadFours(rows, numbers);
      Doubles* point = this->Points[corner];
      const Doubles z = numbers[frame.Along] - frame.Plane;
      for (int k = 0; k < 2; ++k)
      {
        const Doubles x = numbers[frame.Across[k]] - frame.Center[k];
        point[k] = (x - frame.Slope[k] * z) * frame.InverseSize;
      }
      point[2] = 1.0 + frame.Spread * z;
      point[3] = frame.Sign * z;
      point[4] = numbers[3];
      largest = Max(largest, Abs(point[4]));
      isBounded = isBounded & (SmallestW < point[2]) &
        (Abs(point[0]) + Abs(point[1]) + point[2] < LargestCoordinate);
    }
    const Doubles inverse = 1.0 / largest;
    isBounded = isBounded & (largest < Infinity);
    for (auto& point : this->Points)
    {
      const Doubles ratio = point[4] * inverse;
      isBounded = isBounded & ((SmallestRatio < Abs(ratio)) | (point[4] == 0.0));
      // Zero is inside: it has no sign.
      point[4] = ratio + 0.0;
    }
    this->Unbounded = ~ToBits(isBounded) & ((1U << DoubleWidth) - 1U);
  }
};

/// Projects cells. Returns those that cannot be bounded.
template <int Corners>
SIMD_INLINE unsigned int Project(const PassedCellRecords& records, int first,
  const BeamNumbers& frame, ProjectedCorner (&corners)[Corners])
{
  const ProjectedCells<Corners> low(records, first, frame);
  const ProjectedCells<Corners> high(records, first + DoubleWidth, frame);
  for (int i = 0; i < Corners; ++i)
  {
    const Doubles* a = low.Points[i];
    const Doubles* b = high.Points[i];
    corners[i] = { Round(a[0], b[0]), Round(a[1], b[1]), Round(a[2], b[2]), Round(a[3], b[3]),
      Round(a[4], b[4]) };
  }
  return low.Unbounded | high.Unbounded << DoubleWidth;
}

/// Where edges between corners of some cells meet the surface, as a label.
struct EdgePoints
{
  Floats X;
  Floats Y;
  Floats Depth;
};

SIMD_INLINE EdgePoints MeetSurface(const ProjectedCorner& a, const ProjectedCorner& b)
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
    const Floats label[2] = { points.X, points.Y };
    for (int i = 0; i < 2; ++i)
    {
      this->Lower[i] = Min(this->Lower[i], label[i]);
      this->Upper[i] = Max(this->Upper[i], label[i]);
    }
    this->Near = Min(this->Near, points.Depth);
  }

  /// Includes the points of some lanes.
  SIMD_INLINE void Include(FloatMask mask, const EdgePoints& points)
  {
    const PointBounds before = *this;
    this->Include(points);
    for (int i = 0; i < 2; ++i)
    {
      this->Lower[i] = Select(mask, this->Lower[i], before.Lower[i]);
      this->Upper[i] = Select(mask, this->Upper[i], before.Upper[i]);
    }
    this->Near = Select(mask, this->Near, before.Near);
  }
};

/// What rounding may move the labels of points between the corners of cells by.
template <int Corners>
SIMD_INLINE Floats FindMargin(const ProjectedCorner (&corners)[Corners], float margin)
{
  Floats size = 0.0F;
  Floats least = static_cast<float>(Infinity);
  for (const ProjectedCorner& corner : corners)
  {
    size = Max(Max(size, Abs(corner.X)), Max(Abs(corner.Y), corner.W));
    least = Min(least, corner.W);
  }
  return MultiplyAdd(size * LabelMargin, ApproximateReciprocal(least), margin);
}

SIMD_INLINE void StoreBounds(
  const PointBounds& bounds, const Floats (&margins)[2], int first, BeamPieces& pieces)
{
  for (int i = 0; i < 2; ++i)
  {
    StoreFloats(bounds.Lower[i] - margins[i], &pieces.Bounds.Lower[i][first]);
    StoreFloats(bounds.Upper[i] + margins[i], &pieces.Bounds.Upper[i][first]);
  }
  StoreFloats(bounds.Near, &pieces.Bounds.Near[first]);
}

SIMD_INLINE void StoreLine(Floats a, Floats b, Floats c, int line, int first, BeamPieces& pieces)
{
  StoreFloats(a, &pieces.Line[line][0][first]);
  StoreFloats(b, &pieces.Line[line][1][first]);
  StoreFloats(c, &pieces.Line[line][2][first]);
}

SIMD_INLINE void OpenUnbounded(unsigned int unbounded, int first, BeamPieces& pieces)
{
  constexpr float largest = std::numeric_limits<float>::max();
  pieces.AnyLabel += CountBits(unbounded);
  for (; unbounded != 0; unbounded &= unbounded - 1)
  {
    const int i = first + LowestBit(unbounded);
    LabelBounds& bounds = pieces.Bounds;
    bounds.Lower[0][i] = bounds.Lower[1][i] = -FloatInfinity;
    bounds.Upper[0][i] = bounds.Upper[1][i] = FloatInfinity;
    // Behind the end of rays that are not there.
    bounds.Near[i] = -largest;
    for (auto& line : pieces.Line)
    {
      line[0][i] = line[1][i] = line[2][i] = 0.0F;
    }
    pieces.Far[i] = FloatInfinity;
  }
}

/// Bounds pieces that no ray of the beam meets.
SIMD_INLINE void Close(unsigned int outside, int first, BeamPieces& pieces)
{
  pieces.AnyLabel -= CountBits(outside);
  for (; outside != 0; outside &= outside - 1)
  {
    const int i = first + LowestBit(outside);
    LabelBounds& bounds = pieces.Bounds;
    bounds.Lower[0][i] = bounds.Lower[1][i] = FloatInfinity;
    bounds.Upper[0][i] = bounds.Upper[1][i] = -FloatInfinity;
  }
}

/// Of the corners of pieces, how far they are on the inner side of each side of the beam, and
/// before the point where its rays meet. It is linear, also where there are no labels.
struct BeamSides
{
  Floats Inside[5] = { -FloatInfinity, -FloatInfinity, -FloatInfinity, -FloatInfinity,
    -FloatInfinity };

  SIMD_INLINE void Include(Floats x, Floats y, Floats w)
  {
    const Floats distances[5] = { w - x, w + x, w - y, w + y, w };
    for (int i = 0; i < 5; ++i)
    {
      this->Inside[i] = Max(this->Inside[i], distances[i]);
    }
  }

  /// Those with all corners beyond a side, by more than an error.
  SIMD_INLINE unsigned int FindOutside(Floats error) const
  {
    FloatMask isOutside = this->Inside[0] + error < 0.0F;
    for (int i = 1; i < 5; ++i)
    {
      isOutside = isOutside | (this->Inside[i] + error < 0.0F);
    }
    return ToBits(isOutside);
  }
};

/// Bounds polygons, whose corners may be off by margins: then they are in the convex hull of the
/// corners, widened by a box. A ray that stays on the inside of all edges, however the corners
/// move, is within.
SIMD_INLINE void BoundPolygons(
  const EdgePoints (&points)[4], const Floats (&margins)[2], int first, BeamPieces& pieces)
{
  PointBounds bounds;
  for (const EdgePoints& point : points)
  {
    bounds.Include(point);
  }
  StoreBounds(bounds, margins, first, pieces);
  const Floats area = (points[2].X - points[0].X) * (points[3].Y - points[1].Y) -
    (points[2].Y - points[0].Y) * (points[3].X - points[1].X);
  const Floats sign = CopySign(1.0F, area);
  for (int i = 0; i < BeamPieces::Lines; ++i)
  {
    const EdgePoints& p = points[i];
    const EdgePoints& q = points[(i + 1) % 4];
    const Floats a = sign * (p.Y - q.Y);
    const Floats b = sign * (q.X - p.X);
    // Through the edge, but for pieces seen edge on: there rounding may have moved corners across.
    Floats lowest = 0.0F;
    for (int other = 2; other < 4; ++other)
    {
      const EdgePoints& corner = points[(i + other) % 4];
      lowest = Min(lowest, MultiplyAdd(a, corner.X - p.X, b * (corner.Y - p.Y)));
    }
    const Floats margin = MultiplyAdd(margins[0], Abs(a), margins[1] * Abs(b));
    StoreLine(a, b, margin - lowest - (a * p.X + b * p.Y), i, first, pieces);
    StoreFloats(2.0F * margin - lowest, &pieces.Inset[i][first]);
  }
}

/// A number of packed points, as a function of their steps.
struct StepFunction
{
  float Start;
  float Across;
  float Along;
  /// By how much it may be wrong.
  float Error;

  SIMD_INLINE StepFunction(double start, double across, double along)
    : Start(static_cast<float>(start))
    , Across(static_cast<float>(across))
    , Along(static_cast<float>(along))
  {
    // Points are half a step off at most; and what rounding to single precision takes off.
    const double perStep = std::fabs(across) + std::fabs(along);
    this->Error = static_cast<float>(0.51 * perStep +
      0x1p-21 * (std::fabs(start) + static_cast<double>(PackedPieces::Steps) * perStep));
  }

  SIMD_INLINE Floats Get(Floats across, Floats along) const
  {
    return MultiplyAdd(this->Across, across, MultiplyAdd(this->Along, along, this->Start));
  }
};

/// How the points of a set are projected to labels.
struct PackedProjection
{
  StepFunction X;
  StepFunction Y;
  StepFunction W;
  StepFunction Depth;

  SIMD_INLINE static double GetLower(const PackedPieces& packed, const BeamNumbers& frame, int k)
  {
    return static_cast<double>(packed.Lower[frame.Across[k]]) - frame.Center[k];
  }
  SIMD_INLINE static double GetStep(const PackedPieces& packed, int axis)
  {
    return (static_cast<double>(packed.Upper[axis]) - static_cast<double>(packed.Lower[axis])) *
      (1.0 / PackedPieces::Steps);
  }
  SIMD_INLINE static StepFunction MakeAcross(
    const PackedPieces& packed, const BeamNumbers& frame, int k, double z, double stepOfZ)
  {
    const double slope = frame.Slope[k] * frame.InverseSize;
    return StepFunction(GetLower(packed, frame, k) * frame.InverseSize - slope * z,
      GetStep(packed, frame.Across[k]) * frame.InverseSize, -slope * stepOfZ);
  }

  SIMD_INLINE PackedProjection(
    const PackedPieces& packed, const BeamNumbers& frame, double z, double stepOfZ)
    : X(MakeAcross(packed, frame, 0, z, stepOfZ))
    , Y(MakeAcross(packed, frame, 1, z, stepOfZ))
    , W(1.0 + frame.Spread * z, 0.0, frame.Spread * stepOfZ)
    , Depth(frame.Sign * z, 0.0, frame.Sign * stepOfZ)
  {
  }
  SIMD_INLINE PackedProjection(const PackedPieces& packed, const BeamNumbers& frame)
    : PackedProjection(packed, frame, static_cast<double>(packed.Lower[frame.Along]) - frame.Plane,
        GetStep(packed, frame.Along))
  {
  }

  /// Whether labels are told in single precision.
  SIMD_INLINE bool IsBounded() const
  {
    const float largest = static_cast<float>(LargestCoordinate) * 0x1p-10F;
    return this->X.Error < largest && this->Y.Error < largest && this->W.Error < largest;
  }
};

/// Pieces beyond a side of the beam.
SIMD_INLINE unsigned int FindPiecesBeside(const PackedPieces& packed, int first,
  const BeamNumbers& frame, const PackedProjection& projection)
{
  constexpr unsigned int mask = PackedPieces::Steps;
  BeamSides sides;
  for (const std::uint32_t(&polygon)[PackedPieces::Capacity] : packed.Polygons)
  {
    const std::uint32_t* corners = &polygon[first];
    const Floats x = GetBits(corners, PackedPieces::Bits * frame.Across[0], mask);
    const Floats y = GetBits(corners, PackedPieces::Bits * frame.Across[1], mask);
    const Floats z = GetBits(corners, PackedPieces::Bits * frame.Along, mask);
    sides.Include(projection.X.Get(x, z), projection.Y.Get(y, z), projection.W.Get(0.0F, z));
  }
  return sides.FindOutside(
    2.0F * (projection.X.Error + projection.Y.Error + projection.W.Error) + frame.Margin);
}

/// In a tetrahedron the piece is a triangle or a quadrangle.
void BoundPackedPieces(const PackedPieces& packed, const BeamNumbers& frame, BeamPieces& pieces)
{
  constexpr unsigned int mask = PackedPieces::Steps;
  const PackedProjection projection(packed, frame);
  const float errors[2] = { projection.X.Error, projection.Y.Error };
  pieces.Count = packed.Count;
  for (int first = 0; first < packed.Count; first += FloatWidth)
  {
    EdgePoints points[PackedPieces::Corners];
    Floats least = static_cast<float>(Infinity);
    Floats size = 0.0F;
    Floats far = -static_cast<float>(Infinity);
    for (int i = 0; i < PackedPieces::Corners; ++i)
    {
      const std::uint32_t* corners = &packed.Polygons[i][first];
      const Floats x = GetBits(corners, PackedPieces::Bits * frame.Across[0], mask);
      const Floats y = GetBits(corners, PackedPieces::Bits * frame.Across[1], mask);
      const Floats z = GetBits(corners, PackedPieces::Bits * frame.Along, mask);
      const Floats w = projection.W.Get(0.0F, z);
      const Floats inverse = ApproximateReciprocal(w);
      points[i] = { projection.X.Get(x, z) * inverse, projection.Y.Get(y, z) * inverse,
        projection.Depth.Get(0.0F, z) - projection.Depth.Error };
      size = Max(size, Max(Abs(points[i].X), Abs(points[i].Y)));
      least = Min(least, w);
      far = Max(far, points[i].Depth);
    }
    // Hits at the place of the first one are before it, too.
    const Floats room = 2.0F * projection.Depth.Error + static_cast<float>(frame.Length) * 0x1p-18F;
    StoreFloats(MultiplyAdd(Abs(far), 0x1p-18F, far + room), &pieces.Far[first]);
    const FloatMask hasLabel = static_cast<float>(SmallestW) + 2.0F * projection.W.Error < least;
    // What the quotient may be off by.
    const Floats inverse = ApproximateReciprocal(least - projection.W.Error) * (1.0F + LabelMargin);
    const Floats rounding = MultiplyAdd(size, LabelMargin, frame.Margin + LabelMargin);
    const Floats margins[2] = { MultiplyAdd(MultiplyAdd(size, projection.W.Error, errors[0]),
                                  inverse, rounding),
      MultiplyAdd(MultiplyAdd(size, projection.W.Error, errors[1]), inverse, rounding) };
    BoundPolygons(points, margins, first, pieces);
    const unsigned int bounded = projection.IsBounded() ? ToBits(hasLabel) : 0;
    const unsigned int unbounded = ~bounded & ((1U << FloatWidth) - 1U);
    OpenUnbounded(unbounded, first, pieces);
    if (unbounded != 0 && projection.IsBounded())
    {
      Close(unbounded & FindPiecesBeside(packed, first, frame, projection), first, pieces);
    }
  }
}

/// Cells beyond a side of the beam.
SIMD_INLINE unsigned int FindCellsBeside(
  const ProjectedCorner (&corners)[PassedCellRecords::Corners], float margin)
{
  BeamSides sides;
  Floats size = 0.0F;
  for (const ProjectedCorner& corner : corners)
  {
    sides.Include(corner.X, corner.Y, corner.W);
    size = Max(Max(size, Abs(corner.X)), Max(Abs(corner.Y), Abs(corner.W)));
  }
  return sides.FindOutside(MultiplyAdd(size, LabelMargin, margin));
}

/// A trilinear cell is, with its values, in the convex hull of its corners; so the piece is in that
/// of the points where segments between corners on both sides meet the surface. It is bounded by
/// an octagon.
void BoundTrilinear(const PassedCellRecords& records, const BeamNumbers& frame, BeamPieces& pieces)
{
  for (int first = 0; first < pieces.Count; first += FloatWidth)
  {
    ProjectedCorner corners[PassedCellRecords::Corners];
    const unsigned int unbounded = Project(records, first, frame, corners);
    PointBounds bounds;
    // The same along the diagonals: of the sums and the differences of X and Y.
    PointBounds ofDiagonals;
    for (int i = 0; i < 7; ++i)
    {
      for (int j = i + 1; j < 8; ++j)
      {
        const FloatMask crosses = HaveDifferentSigns(corners[i].Difference, corners[j].Difference);
        if (ToBits(crosses) == 0)
        {
          continue;
        }
        const EdgePoints point = MeetSurface(corners[i], corners[j]);
        bounds.Include(crosses, point);
        ofDiagonals.Include(crosses, { point.X + point.Y, point.X - point.Y, point.Depth });
      }
    }
    const Floats margin = FindMargin(corners, frame.Margin);
    StoreBounds(bounds, { margin, margin }, first, pieces);
    const Floats one = 1.0F;
    const Floats two = 2.0F * margin;
    StoreLine(one, one, two - ofDiagonals.Lower[0], 0, first, pieces);
    StoreLine(0.0F - one, 0.0F - one, two + ofDiagonals.Upper[0], 1, first, pieces);
    StoreLine(one, 0.0F - one, two - ofDiagonals.Lower[1], 2, first, pieces);
    StoreLine(0.0F - one, one, two + ofDiagonals.Upper[1], 3, first, pieces);
    StoreFloats(FloatInfinity, &pieces.Far[first]);
    OpenUnbounded(unbounded, first, pieces);
    if (unbounded != 0)
    {
      Close(unbounded & FindCellsBeside(corners, frame.Margin), first, pieces);
    }
  }
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
SIMD_INLINE unsigned int FindNear(
  const LabelBounds& bounds, unsigned int among, const BeamRays& rays)
{
  unsigned int near = 0;
  for (int i = 0; i < LabelBounds::Capacity; i += FloatWidth)
  {
    if ((among >> i & ((1U << FloatWidth) - 1U)) == 0)
    {
      continue;
    }
    const FloatMask isBeside = (rays.UpperOfAll[0] < LoadFloats(&bounds.Lower[0][i])) |
      (rays.UpperOfAll[1] < LoadFloats(&bounds.Lower[1][i])) |
      (LoadFloats(&bounds.Upper[0][i]) < rays.LowerOfAll[0]) |
      (LoadFloats(&bounds.Upper[1][i]) < rays.LowerOfAll[1]) |
      (rays.EndOfAll < LoadFloats(&bounds.Near[i]));
    near |= (~ToBits(isBeside) & ((1U << FloatWidth) - 1U)) << i;
  }
  return near & among;
}

unsigned int FindPassed(const LabelBounds& bounds, unsigned int among, const BeamRays& rays)
{
  unsigned int passed = 0;
  for (unsigned int near = FindNear(bounds, among, rays); near != 0; near &= near - 1)
  {
    const int number = LowestBit(near);
    passed |= static_cast<unsigned int>(FindGroups(bounds, number, rays) != 0) << number;
  }
  return passed;
}

/// Finds the ends of some groups of rays, and that of all.
SIMD_INLINE void FindGroupEnds(unsigned int groups, BeamRays& rays)
{
  for (; groups != 0; groups &= groups - 1)
  {
    const int group = LowestBit(groups);
    const float* ends = rays.End + group * BeamRays::GroupSize;
    Floats end = LoadFloats(ends);
    for (int i = FloatWidth; i < BeamRays::GroupSize; i += FloatWidth)
    {
      end = Max(end, LoadFloats(ends + i));
    }
    rays.GroupEnd[group] = ReduceMax(end);
  }
  rays.EndOfAll = rays.GroupEnd[0];
  for (int group = 1; group < BeamRays::Groups; ++group)
  {
    const float end = rays.GroupEnd[group];
    rays.EndOfAll = rays.EndOfAll < end ? end : rays.EndOfAll;
  }
}

SIMD_INLINE Floats LeastOf(const Floats (&numbers)[4])
{
  return Min(Min(numbers[0], numbers[1]), Min(numbers[2], numbers[3]));
}

/// Adds the rays of a group that may meet a piece. Returns whether some of them surely do: 1 or 0.
/// (Whether any do is unpredictable: there are no branches.)
SIMD_INLINE unsigned int AddPairs(
  const BeamPieces& pieces, int piece, int number, int group, BeamRays& rays, BeamPairs& pairs)
{
  const LabelBounds& bounds = pieces.Bounds;
  const float near = bounds.Near[piece];
  const float far = pieces.Far[piece];
  const int begin = group * BeamRays::GroupSize;
  unsigned int sureOfGroup = 0;
  unsigned int unsureOfGroup = 0;
  int count = pairs.Count;
  for (int first = begin; first < begin + BeamRays::GroupSize; first += FloatWidth)
  {
    const Floats a = LoadFloats(&rays.Label[0][first]);
    const Floats b = LoadFloats(&rays.Label[1][first]);
    const Floats end = LoadFloats(&rays.End[first]);
    FloatMask isBeside = (a < bounds.Lower[0][piece]) | (bounds.Upper[0][piece] < a) |
      (b < bounds.Lower[1][piece]) | (bounds.Upper[1][piece] < b) | (end < near);
    Floats heights[BeamPieces::Lines];
    for (int i = 0; i < BeamPieces::Lines; ++i)
    {
      const auto& line = pieces.Line[i];
      heights[i] = MultiplyAdd(line[0][piece], a, MultiplyAdd(line[1][piece], b, line[2][piece]));
    }
    isBeside = isBeside | (LeastOf(heights) < 0.0F);
    constexpr unsigned int lanes = (1U << FloatWidth) - 1U;
    const unsigned int found = ~ToBits(isBeside) & lanes;
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      pairs.Piece[count + lane] = number;
    }
    StoreFloats(near, &pairs.Near[count]);
    count += AppendLanes(first, found & ((1U << DoubleWidth) - 1U), &pairs.Place[count]);
    count += AppendLanes(first + DoubleWidth, found >> DoubleWidth, &pairs.Place[count]);
    for (int i = 0; i < BeamPieces::Lines; ++i)
    {
      heights[i] = heights[i] - pieces.Inset[i][piece];
    }
    // Rays may begin within what the piece is bounded by, and end before it does.
    const FloatMask isSpared =
      isBeside | (LeastOf(heights) < 0.0F) | (near < LoadFloats(&rays.Begin[first])) | (end < far);
    const unsigned int sure = ~ToBits(isSpared) & lanes;
    sureOfGroup |= sure << (first - begin);
    unsureOfGroup |= (found & ~sure) << (first - begin);
    StoreFloats(Select(isSpared, end, far), &rays.End[first]);
  }
  pairs.Count = count;
  pairs.UnsureCount += CountBits(unsureOfGroup & ~rays.Sure[group]);
  rays.Sure[group] |= sureOfGroup;
  return sureOfGroup != 0 ? 1U : 0U;
}

/// The farthest end of some of the pieces; a bit for each.
SIMD_INLINE float FindFarthest(const BeamPieces& pieces, unsigned int among)
{
  float farthest = -FloatInfinity;
  for (; among != 0; among &= among - 1)
  {
    const float far = pieces.Far[LowestBit(among)];
    farthest = farthest < far ? far : farthest;
  }
  return farthest;
}

/// Groups of rays and pieces that they may meet.
struct GroupsOfPieces
{
  int Count = 0;
  /// The number of the piece, times that of groups, plus the group.
  int Codes[BeamPieces::Capacity * BeamRays::Groups + DoubleWidth];

  SIMD_INLINE void Add(int piece, unsigned int groups)
  {
    for (int i = 0; i < BeamRays::Groups; i += DoubleWidth)
    {
      this->Count += AppendLanes(piece * BeamRays::Groups + i,
        groups >> i & ((1U << DoubleWidth) - 1U), &this->Codes[this->Count]);
    }
  }
};

void FindPairs(const BeamPieces& pieces, int firstPiece, BeamRays& rays, BeamPairs& pairs)
{
  GroupsOfPieces found;
  for (unsigned int near = FindNear(pieces.Bounds, (1U << pieces.Count) - 1U, rays); near != 0;
       near &= near - 1)
  {
    const int piece = LowestBit(near);
    found.Add(piece, FindGroups(pieces.Bounds, piece, rays));
  }
  unsigned int surelyHit = 0;
  unsigned int ended = 0;
  for (int i = 0; i < found.Count; ++i)
  {
    const auto code = static_cast<unsigned int>(found.Codes[i]);
    const int piece = static_cast<int>(code / BeamRays::Groups);
    const int group = static_cast<int>(code % BeamRays::Groups);
    const unsigned int isSure = AddPairs(pieces, piece, firstPiece + piece, group, rays, pairs);
    surelyHit |= isSure << piece;
    ended |= isSure << group;
  }
  if (ended != 0)
  {
    const float farthest = FindFarthest(pieces, surelyHit);
    rays.EndOfSure = rays.EndOfSure < farthest ? farthest : rays.EndOfSure;
    FindGroupEnds(ended, rays);
  }
}

}
}
