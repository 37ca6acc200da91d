// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The pixels that a projected tetrahedron covers, by the faces that their rays cross: scan
// conversion, with a row of pixels in each lane. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A face of a tetrahedron: its corners in order, and the edge opposite to each.
struct Face
{
  int Corners[3];
  int Edges[3];
};

constexpr Face Faces[4] = { { { 0, 1, 2 }, { 3, 1, 0 } }, { { 0, 1, 3 }, { 4, 2, 0 } },
  { { 0, 2, 3 }, { 5, 2, 1 } }, { { 1, 2, 3 }, { 5, 4, 3 } } };

/// A ray that passes a tetrahedron crosses one of these pairs of faces.
constexpr int PairsOfFaces = 6;
constexpr int FacePairs[PairsOfFaces][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 },
  { 2, 3 } };

/// In each lane a row of pixels: a bit for each column.
using PixelRowBits = ShortVector<std::uint32_t, FloatWidth>::Type;

struct LaneNumbers
{
  alignas(64) float Numbers[FloatWidth];

  constexpr LaneNumbers()
    : Numbers{}
  {
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      this->Numbers[lane] = static_cast<float>(lane);
    }
  }
};

/// On which side of an edge the pixels of some rows are.
struct SidesOfEdge
{
  /// One side, where it is sure.
  PixelRowBits IsRight;
  PixelRowBits IsSure;

  SIMD_INLINE SidesOfEdge(const ProjectedTetrahedra& projected, int number, int edge, Floats rows)
  {
    constexpr auto columns = static_cast<float>(CloudTile::Edge);
    const Floats line =
      MultiplyAdd(projected.LineSlope[edge][number], rows, projected.LineStart[edge][number]);
    const float margin = projected.LineMargin[edge][number];
    // So many of the first columns are surely to the left, and so many of the last to the right.
    const PixelRowBits left = Count(line + (1.0F - margin));
    const PixelRowBits right = Count((columns - margin) - line);
    constexpr std::uint32_t all = (1U << CloudTile::Edge) - 1U;
    const PixelRowBits isLeft = ~(~PixelRowBits{} << left);
    const PixelRowBits isRight = (PixelRowBits{} + (all << CloudTile::Edge)) >> right;
    // Where the area is not negative, if that is sure.
    const std::uint32_t turned = projected.A[edge][number] < 0.0 ? ~0U : 0U;
    this->IsRight = isRight ^ turned;
    this->IsSure = isLeft | isRight;
  }

private:
  /// The whole numbers in a distance, from none to all columns.
  SIMD_INLINE static PixelRowBits Count(Floats distance)
  {
    constexpr auto columns = static_cast<float>(CloudTile::Edge);
    const Floats some = Max(Floats(0.0F), Min(Floats(columns), distance));
    ShortVector<std::int32_t, FloatWidth>::Type count;
    Convert(some.Value, count);
    return reinterpret_cast<PixelRowBits>(count);
  }
};

/// The pixels of a tile whose rays pass a tetrahedron, of those that are open.
class CoveredPixels
{
public:
  /// Lists of pixels: for each pair of faces those whose rays surely cross it, and last those whose
  /// rays may pass near an edge.
  static constexpr int Lists = PairsOfFaces + 1;
  static constexpr int Unsure = PairsOfFaces;

  SIMD_INLINE CoveredPixels(const CloudTile& tile, const ProjectedTetrahedra& projected, int number)
  {
    PixelRows rows(projected, number);
    for (int row = rows.First; row <= rows.Last; row += FloatWidth)
    {
      rows.Scan(tile, projected, number, SmallerOf(row, CloudTile::Edge - FloatWidth));
    }
    int count = 0;
    for (int list = 0; list < Lists; ++list)
    {
      this->Begin[list] = count;
      const int last = (rows.Filled >> list & 1U) != 0 ? rows.Last : -1;
      for (int row = rows.First; row <= last; ++row)
      {
        count += ListRow(row, rows.Bits[list][row], this->Pixels + count);
      }
    }
    this->Begin[Lists] = count;
    for (int i = count; i < count + DoubleWidth; ++i)
    {
      this->Pixels[i] = 0;
    }
  }

  SIMD_INLINE int GetCount(int list) const { return this->Begin[list + 1] - this->Begin[list]; }

  /// The pixels of a list; behind the last there is room for a vector.
  SIMD_INLINE const int* GetPixels(int list) const { return this->Pixels + this->Begin[list]; }

private:
  /// Tetrahedra in no more pixels than this have one list: many short ones would take longer.
  static constexpr int FewPixels = 32;

  struct PixelRows
  {
    int First;
    int Last;
    std::uint32_t Columns;
    bool AreFew;
    std::uint32_t Bits[Lists][CloudTile::Edge];
    /// The lists that have any; a bit for each.
    unsigned int Filled = 0;

    SIMD_INLINE PixelRows(const ProjectedTetrahedra& projected, int number)
      : First(projected.FirstRow[number])
      , Last(projected.LastRow[number])
      , Columns(
          (~0U << projected.FirstColumn[number]) & (~0U >> (31 - projected.LastColumn[number])))
      , AreFew((this->Last - this->First + 1) *
            (projected.LastColumn[number] - projected.FirstColumn[number] + 1) <=
          FewPixels)
    {
    }

    SIMD_INLINE void Scan(
      const CloudTile& tile, const ProjectedTetrahedra& projected, int number, int first)
    {
      static constexpr LaneNumbers lanes;
      const Floats rows = LoadFloats(lanes.Numbers) + static_cast<float>(first);
      PixelRowBits open;
      std::memcpy(&open, &tile.Open[first], sizeof(open));
      open &= this->Columns;
      PixelRowBits sides[ProjectedTetrahedra::Edges];
      PixelRowBits isSure = open;
      for (int i = 0; i < ProjectedTetrahedra::Edges; ++i)
      {
        const SidesOfEdge edge(projected, number, i, rows);
        sides[i] = edge.IsRight;
        isSure &= edge.IsSure;
      }
      PixelRowBits crossed[4];
      for (int i = 0; i < 4; ++i)
      {
        // Both edges at the first corner, and those at the second, are on different sides.
        const int* edges = Faces[i].Edges;
        crossed[i] = (sides[edges[2]] ^ sides[edges[1]]) & ~(sides[edges[2]] ^ sides[edges[0]]);
      }
      if (this->AreFew)
      {
        // Rays that cross the last face cross another one, too.
        this->Keep(Unsure, first, open & (~isSure | crossed[0] | crossed[1] | crossed[2]));
        return;
      }
      for (int i = 0; i < PairsOfFaces; ++i)
      {
        this->Keep(i, first, isSure & crossed[FacePairs[i][0]] & crossed[FacePairs[i][1]]);
      }
      this->Keep(Unsure, first, open & ~isSure);
    }

    SIMD_INLINE void Keep(int list, int first, const PixelRowBits& rows)
    {
      std::memcpy(&this->Bits[list][first], &rows, sizeof(rows));
      Floats number;
      Convert(reinterpret_cast<ShortVector<std::int32_t, FloatWidth>::Type>(rows), number.Value);
      this->Filled |= static_cast<unsigned int>(ToBits(Floats(0.0F) < number) != 0) << list;
    }
  };

  /// So many pixels are listed at once.
  static constexpr int Run = 8;
  using RunOfPixels = ShortVector<std::int32_t, Run>::Type;

  /// Most often the pixels of a row follow each other, and are no more than a run, if there are
  /// any.
  SIMD_INLINE static int ListRow(int row, std::uint32_t columns, int* pixels)
  {
    const int first = LowestBit(columns | 1U << CloudTile::Edge);
    const std::uint32_t rest = columns >> first;
    if ((rest & (rest + 1)) == 0 && rest < 1U << Run)
    {
      const RunOfPixels run =
        RunOfPixels{ 0, 1, 2, 3, 4, 5, 6, 7 } + (row * CloudTile::Edge + first);
      std::memcpy(pixels, &run, sizeof(run));
      return CountBits(rest);
    }
    int count = 0;
    for (; columns != 0; columns &= columns - 1)
    {
      pixels[count++] = row * CloudTile::Edge + LowestBit(columns);
    }
    return count;
  }

  int Begin[Lists + 1];
  int Pixels[CloudTile::Capacity + Run];
};

}
}
