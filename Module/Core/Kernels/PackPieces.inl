// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Pieces of surfaces in cells, for any view. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The edges that a piece has its corners on, in order around it: an end outside of the surface and
/// one inside. Of a triangle the last corner is there twice.
struct PolygonEdges
{
  unsigned char Ends[PackedPieces::Corners][2];
};

/// For each set of corners inside, a bit for each; there is no piece if all are on one side.
constexpr PolygonEdges EdgesOfPolygons[16] = { {}, { { { 1, 0 }, { 2, 0 }, { 3, 0 }, { 3, 0 } } },
  { { { 0, 1 }, { 2, 1 }, { 3, 1 }, { 3, 1 } } }, { { { 2, 0 }, { 2, 1 }, { 3, 1 }, { 3, 0 } } },
  { { { 0, 2 }, { 1, 2 }, { 3, 2 }, { 3, 2 } } }, { { { 1, 0 }, { 1, 2 }, { 3, 2 }, { 3, 0 } } },
  { { { 0, 1 }, { 0, 2 }, { 3, 2 }, { 3, 1 } } }, { { { 3, 0 }, { 3, 1 }, { 3, 2 }, { 3, 2 } } },
  { { { 0, 3 }, { 1, 3 }, { 2, 3 }, { 2, 3 } } }, { { { 1, 0 }, { 1, 3 }, { 2, 3 }, { 2, 0 } } },
  { { { 0, 1 }, { 0, 3 }, { 2, 3 }, { 2, 1 } } }, { { { 2, 0 }, { 2, 1 }, { 2, 3 }, { 2, 3 } } },
  { { { 0, 2 }, { 0, 3 }, { 1, 3 }, { 1, 2 } } }, { { { 1, 0 }, { 1, 2 }, { 1, 3 }, { 1, 3 } } },
  { { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 0, 3 } } }, {} };

/// The points that pieces are packed as, and the bounds of all along each axis.
struct PiecePoints
{
  alignas(64) double Points[PackedPieces::Corners][3][PackedPieces::Capacity];
  double Lower[3];
  double Upper[3];

  SIMD_INLINE void SetBounds(const Doubles lower[3], const Doubles upper[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = ReduceMin(lower[axis]);
      this->Upper[axis] = ReduceMax(upper[axis]);
    }
  }
};

/// The corners of the pieces in some tetrahedra.
struct Polygons : PiecePoints
{
  /// Corners as in TetrahedronPairs. Behind the last piece it is repeated.
  SIMD_INLINE Polygons(const double (*corners)[4][4], int count)
  {
    Doubles lower[3] = { Infinity, Infinity, Infinity };
    Doubles upper[3] = { -Infinity, -Infinity, -Infinity };
    for (int first = 0; first < count; first += DoubleWidth)
    {
      const double(*cells[DoubleWidth])[4];
      const PolygonEdges* edges[DoubleWidth];
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        cells[lane] = corners[SmallerOf(first + lane, count - 1)];
        unsigned int inside = 0;
        for (int corner = 0; corner < 4; ++corner)
        {
          inside |= static_cast<unsigned int>(cells[lane][corner][3] >= 0.0) << corner;
        }
        edges[lane] = &EdgesOfPolygons[inside];
      }
      for (int k = 0; k < PackedPieces::Corners; ++k)
      {
        const double* rows[2][DoubleWidth];
        for (int lane = 0; lane < DoubleWidth; ++lane)
        {
          rows[0][lane] = cells[lane][edges[lane]->Ends[k][0]];
          rows[1][lane] = cells[lane][edges[lane]->Ends[k][1]];
        }
        Doubles outside[4];
        Doubles inside[4];
        LoadFours(rows[0], outside);
        LoadFours(rows[1], inside);
        const Doubles fraction = outside[3] / (outside[3] - inside[3]);
        for (int axis = 0; axis < 3; ++axis)
        {
          const Doubles point = outside[axis] * (1.0 - fraction) + inside[axis] * fraction;
          Store(point, &this->Points[k][axis][first]);
          lower[axis] = Min(lower[axis], point);
          upper[axis] = Max(upper[axis], point);
        }
      }
    }
    this->SetBounds(lower, upper);
  }
};

/// The lower and the upper corners of the boxes of the pieces in some trilinear cells: all of a
/// piece is in the convex hull of the points where segments between corners on both sides meet the
/// surface.
struct HullBoxes : PiecePoints
{
  /// Corners as in PassedCellRecords. Behind the last piece it is repeated.
  SIMD_INLINE HullBoxes(const double (*corners)[PassedCellRecords::Corners][4], int count)
  {
    constexpr int cornersOfCell = PassedCellRecords::Corners;
    Doubles lowerOfAll[3] = { Infinity, Infinity, Infinity };
    Doubles upperOfAll[3] = { -Infinity, -Infinity, -Infinity };
    for (int first = 0; first < count; first += DoubleWidth)
    {
      Doubles numbers[cornersOfCell][4];
      Mask isOutside[cornersOfCell];
      for (int corner = 0; corner < cornersOfCell; ++corner)
      {
        LoadCorner(corners, first, count, corner, numbers[corner]);
        isOutside[corner] = numbers[corner][3] < 0.0;
      }
      Doubles lower[3] = { Infinity, Infinity, Infinity };
      Doubles upper[3] = { -Infinity, -Infinity, -Infinity };
      for (int a = 0; a < cornersOfCell; ++a)
      {
        for (int b = a + 1; b < cornersOfCell; ++b)
        {
          const Mask isCrossed =
            AndNot(isOutside[a], isOutside[b]) | AndNot(isOutside[b], isOutside[a]);
          if (Any(isCrossed))
          {
            Include(numbers[a], numbers[b], isCrossed, lower, upper);
          }
        }
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        Store(lower[axis], &this->Points[0][axis][first]);
        Store(upper[axis], &this->Points[1][axis][first]);
        lowerOfAll[axis] = Min(lowerOfAll[axis], lower[axis]);
        upperOfAll[axis] = Max(upperOfAll[axis], upper[axis]);
      }
    }
    this->SetBounds(lowerOfAll, upperOfAll);
  }

private:
  /// Includes where segments meet the surface.
  SIMD_INLINE static void Include(
    const Doubles a[4], const Doubles b[4], Mask isCrossed, Doubles lower[3], Doubles upper[3])
  {
    const Doubles fraction = a[3] / (a[3] - b[3]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles point = a[axis] * (1.0 - fraction) + b[axis] * fraction;
      lower[axis] = Min(lower[axis], Select(isCrossed, point, Infinity));
      upper[axis] = Max(upper[axis], Select(isCrossed, point, -Infinity));
    }
  }
};

/// A float that is smaller than the number, but not by much.
SIMD_INLINE float MoveDown(double number)
{
  constexpr double least = 0x1p-140;
  constexpr double largest = 0x1.fffffep127;
  const double lower = number - (std::fabs(number) * 0x1p-22 + least);
  return static_cast<float>(lower < largest ? lower : largest);
}

/// Packs so many points of each piece.
SIMD_INLINE void Pack(const PiecePoints& pieces, int points, PackedPieces& packed)
{
  const int count = packed.Count;
  for (auto& words : packed.Polygons)
  {
    for (std::uint32_t& word : words)
    {
      word = 0;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    packed.Lower[axis] = MoveDown(pieces.Lower[axis]);
    packed.Upper[axis] = -MoveDown(-pieces.Upper[axis]);
    const auto lower = static_cast<double>(packed.Lower[axis]);
    const double size = static_cast<double>(packed.Upper[axis]) - lower;
    if (!(size > 0.0 && size < Infinity))
    {
      continue; // Without a size, or so large that it has no labels in single precision.
    }
    for (int k = 0; k < points; ++k)
    {
      int steps[PackedPieces::Capacity];
      for (int first = 0; first < count; first += DoubleWidth)
      {
        const Doubles point = Load(&pieces.Points[k][axis][first]);
        StoreTruncated((point - lower) * (PackedPieces::Steps / size) + 0.5, &steps[first]);
      }
      for (int i = 0; i < count; ++i)
      {
        packed.Polygons[k][i] |= static_cast<std::uint32_t>(steps[i])
          << (PackedPieces::Bits * axis);
      }
    }
  }
}

void PackPolygons(const double (*corners)[4][4], PackedPieces& packed)
{
  Pack(Polygons(corners, packed.Count), PackedPieces::Corners, packed);
}

void PackBoxes(const double (*corners)[PassedCellRecords::Corners][4], PackedPieces& packed)
{
  Pack(HullBoxes(corners, packed.Count), 2, packed);
}

}
}
