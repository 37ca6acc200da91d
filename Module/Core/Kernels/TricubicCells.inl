// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Tricubic cells, 4^3 numbers each: coefficients, polynomials along rays, gradients. Included by
// Kernels.inl only.
//
// All is done along x, then y, then z. Lines of four numbers along the axis are loaded as vectors
// of first, second, third and fourth numbers, one lane for each line, and stored so that the
// numbers of the next axis are neighbours: after three axes, their order is the first one again.
// Combinations are convex wherever signs count.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Calls change(c) for vectors of lines, whose four numbers are next to each other, and stores the
/// results one behind the other.
template <int Lines, typename Change>
SIMD_INLINE void ChangeLines(const double* cell, double* turned, const Change& change)
{
  for (int line = 0; line < Lines; line += DoubleWidth)
  {
    const double* lines[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      lines[lane] = cell + 4 * (line + lane);
    }
    Doubles c[4];
    LoadFours(lines, c);
    change(c);
    for (int i = 0; i < 4; ++i)
    {
      Store(c[i], turned + Lines * i + line);
    }
  }
}

/// Which signs numbers have.
class Signs
{
public:
  SIMD_INLINE void Include(const Doubles c[4])
  {
    for (int i = 0; i < 4; ++i)
    {
      const unsigned int inside = ToBits(IsInside(c[i]));
      this->Any |= inside;
      this->All &= inside;
    }
  }

  SIMD_INLINE bool AreBoth() const
  {
    return this->Any != 0 && this->All != (1U << DoubleWidth) - 1U;
  }

private:
  unsigned int Any = 0;
  unsigned int All = (1U << DoubleWidth) - 1U;
};

/// Replaces four samples in a row by the coefficients of the cell in their middle.
SIMD_INLINE void MakeCoefficients(const Doubles w[4], Doubles c[4])
{
  const Doubles before = c[1] - c[0];
  const Doubles within = c[2] - c[1];
  const Doubles behind = c[3] - c[2];
  c[0] = c[1];
  c[3] = c[2];
  c[1] = c[0] + (w[0] * before + w[1] * within);
  c[2] = c[3] - (w[2] * within + w[3] * behind);
}

bool InterpolateSamples(
  const double* const weights[3], const ScaledIsovalue& isovalue, double cell[64])
{
  double turned[2][64];
  const double* from = cell;
  Signs signs;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles w[4] = { weights[axis][0], weights[axis][1], weights[axis][2], weights[axis][3] };
    double* to = axis == 2 ? cell : turned[axis];
    signs = {};
    ChangeLines<16>(from, to,
      [axis, &w, &isovalue, &signs](Doubles c[4])
      {
        for (int i = 0; axis == 0 && i < 4; ++i)
        {
          const Doubles difference =
            c[i] * isovalue.Scale - Doubles(isovalue.Isovalue * isovalue.Scale);
          c[i] = KeepSign(difference, c[i], isovalue.Isovalue);
        }
        MakeCoefficients(w, c);
        signs.Include(c);
      });
    from = to;
  }
  return signs.AreBoth();
}

/// Makes coefficients across rows of samples, of which four are taken, with the weights of one cell
/// along that axis.
template <int Length>
SIMD_INLINE void CombineRows(const double* rows, const double (*weights)[TricubicBlock::Edge],
  int cell, double (*coefficients)[Length])
{
  const Doubles w[4] = { weights[0][cell], weights[1][cell], weights[2][cell], weights[3][cell] };
  for (int i = 0; i < Length; i += DoubleWidth)
  {
    Doubles c[4];
    for (int k = 0; k < 4; ++k)
    {
      c[k] = Load(rows + Length * (cell + k) + i);
    }
    MakeCoefficients(w, c);
    for (int k = 0; k < 4; ++k)
    {
      Store(c[k], coefficients[k] + i);
    }
  }
}

/// Extends the ranges of some cells, from x on, by the coefficients along four rows.
SIMD_INLINE void IncludeRows(const double (*rows)[TricubicBlock::Row],
  const double (*weights)[TricubicBlock::Edge], int x, Doubles& low, Doubles& high)
{
  Doubles w[4];
  for (int k = 0; k < 4; ++k)
  {
    w[k] = Load(weights[k] + x);
  }
  for (int row = 0; row < 4; ++row)
  {
    Doubles c[4];
    for (int k = 0; k < 4; ++k)
    {
      c[k] = Load(rows[row] + x + k);
    }
    MakeCoefficients(w, c);
    low = Min(low, Min(Min(c[0], c[1]), Min(c[2], c[3])));
    high = Max(high, Max(Max(c[0], c[1]), Max(c[2], c[3])));
  }
}

// Along z and y, a vector has neighbours along x; along x, each of its lanes has a cell.
void BoundTricubic(const TricubicBlock& block, TricubicRanges& ranges)
{
  constexpr int edge = TricubicBlock::Edge;
  constexpr int row = TricubicBlock::Row;
  constexpr int plane = TricubicBlock::SamplesPerEdge * row;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (int z = 0; z < edge; ++z)
  {
    alignas(64) double planes[4][plane];
    CombineRows<plane>(block.Samples[0][0], block.Weights[2], z, planes);
    // All rows are stored before the first is loaded again, at other places: that would have to
    // wait.
    alignas(64) double rows[edge][4][4][row];
    for (int y = 0; y < edge; ++y)
    {
      for (int k = 0; k < 4; ++k)
      {
        CombineRows<row>(planes[k], block.Weights[1], y, rows[y][k]);
      }
    }
    for (int y = 0; y < edge; ++y)
    {
      for (int x = 0; x < edge; x += DoubleWidth)
      {
        Doubles low = infinity;
        Doubles high = -infinity;
        for (int k = 0; k < 4; ++k)
        {
          IncludeRows(rows[y][k], block.Weights[0], x, low, high);
        }
        Store(low, ranges.Low[z][y] + x);
        Store(high, ranges.High[z][y] + x);
      }
    }
  }
}

/// Replaces lines by the same cubics on their parts from begin to end: by the values of the blossom
/// where the begin is taken three times, twice, once and not at all. A part that falls is turned
/// around. Returns whether numbers of both signs are left.
template <int Lines>
SIMD_INLINE bool RestrictLines(const double* cell, double* turned, double begin, double end)
{
  const Doubles p = begin;
  const Doubles q = end;
  Signs signs;
  ChangeLines<Lines>(cell, turned,
    [p, q, &signs](Doubles c[4])
    {
      Doubles first[3];
      Doubles last[3];
      for (int i = 0; i < 3; ++i)
      {
        first[i] = Lerp(c[i], c[i + 1], p);
        last[i] = Lerp(c[i], c[i + 1], q);
      }
      const Doubles firsts[2] = { Lerp(first[0], first[1], p), Lerp(first[1], first[2], p) };
      const Doubles both[2] = { Lerp(first[0], first[1], q), Lerp(first[1], first[2], q) };
      const Doubles lasts[2] = { Lerp(last[0], last[1], q), Lerp(last[1], last[2], q) };
      c[0] = Lerp(firsts[0], firsts[1], p);
      c[1] = Lerp(firsts[0], firsts[1], q);
      c[2] = Lerp(both[0], both[1], q);
      c[3] = Lerp(lasts[0], lasts[1], q);
      signs.Include(c);
    });
  return signs.AreBoth();
}

/// The weights of products of Bernstein polynomials of two degrees in those of the sum of them.
template <int First, int Second>
struct ProductWeights
{
  double Weights[First + 1][Second + 1];

  constexpr ProductWeights()
    : Weights()
  {
    for (int i = 0; i <= First; ++i)
    {
      for (int j = 0; j <= Second; ++j)
      {
        this->Weights[i][j] =
          Binomial(First, i) * Binomial(Second, j) / Binomial(First + Second, i + j);
      }
    }
  }

  static constexpr double Binomial(int n, int k)
  {
    double product = 1.0;
    for (int i = 1; i <= k; ++i)
    {
      product = product * (n - k + i) / i;
    }
    return product;
  }
};

bool RestrictCell(const double cell[64], const double p[3], const double q[3], double nonic[10])
{
  double alongX[64];
  double alongXY[64];
  if (!RestrictLines<16>(cell, alongX, p[0], q[0]) ||
    !RestrictLines<16>(alongX, alongXY, p[1], q[1]))
  {
    return false;
  }
  // Along the diagonal of x and y, lines along z are a polynomial of degree 6. The last is there
  // twice, to fill a vector.
  static constexpr ProductWeights<3, 3> ofPlane;
  double lines[8][4] = {};
  for (int y = 0; y < 4; ++y)
  {
    for (int x = 0; x < 4; ++x)
    {
      for (int z = 0; z < 4; ++z)
      {
        lines[x + y][z] += ofPlane.Weights[x][y] * alongXY[z + 4 * x + 16 * y];
      }
    }
  }
  for (int z = 0; z < 4; ++z)
  {
    lines[7][z] = lines[6][z];
  }
  double turned[32];
  if (!RestrictLines<8>(lines[0], turned, p[2], q[2]))
  {
    return false;
  }
  static constexpr ProductWeights<6, 3> ofLine;
  for (int i = 0; i < 10; ++i)
  {
    nonic[i] = 0.0;
  }
  for (int z = 0; z < 4; ++z)
  {
    for (int i = 0; i < 7; ++i)
    {
      nonic[i + z] += ofLine.Weights[i][z] * turned[i + 8 * z];
    }
  }
  return true;
}

/// The sum of four numbers with weights.
template <typename Number>
SIMD_INLINE Number Weigh(const Number c[4], const double weights[4])
{
  return weights[0] * c[0] + weights[1] * c[1] + weights[2] * c[2] + weights[3] * c[3];
}

/// The weights of the value of a cubic at t, and of its slope.
SIMD_INLINE void FindWeights(double t, double value[4], double slope[4])
{
  const double s = 1.0 - t;
  value[0] = s * s * s;
  value[1] = 3.0 * s * s * t;
  value[2] = 3.0 * s * t * t;
  value[3] = t * t * t;
  slope[0] = -3.0 * s * s;
  slope[1] = 3.0 * s * (s - 2.0 * t);
  slope[2] = 3.0 * t * (2.0 * s - t);
  slope[3] = 3.0 * t * t;
}

void FindCellGradient(const double cell[64], const double p[3], double gradient[3])
{
  double value[3][4];
  double slope[3][4];
  for (int axis = 0; axis < 3; ++axis)
  {
    FindWeights(p[axis], value[axis], slope[axis]);
  }
  // The values along x, and the slopes.
  double ofX[2][16];
  for (int line = 0; line < 16; line += DoubleWidth)
  {
    const double* lines[DoubleWidth];
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      lines[lane] = cell + 4 * (line + lane);
    }
    Doubles c[4];
    LoadFours(lines, c);
    Store(Weigh(c, value[0]), ofX[0] + line);
    Store(Weigh(c, slope[0]), ofX[1] + line);
  }
  double ofXY[3][4];
  for (int z = 0; z < 4; ++z)
  {
    ofXY[0][z] = Weigh(ofX[1] + 4 * z, value[1]);
    ofXY[1][z] = Weigh(ofX[0] + 4 * z, slope[1]);
    ofXY[2][z] = Weigh(ofX[0] + 4 * z, value[1]);
  }
  gradient[0] = Weigh(ofXY[0], value[2]);
  gradient[1] = Weigh(ofXY[1], value[2]);
  gradient[2] = Weigh(ofXY[2], slope[2]);
}

}
}
