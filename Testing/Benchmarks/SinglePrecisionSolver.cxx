// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SinglePrecisionSolver.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

// How vectors are passed by value depends on the instruction set, of which compilers warn. All
// functions that do so are in this file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace Benchmark
{
namespace SinglePrecision
{
namespace
{

// Vector types of GCC and Clang: the compiler uses what the machine has.
using Real = float __attribute__((vector_size(sizeof(float) * BatchSize)));
using Mask = std::int32_t __attribute__((vector_size(sizeof(std::int32_t) * BatchSize)));

/// A root is refined until Newton's step is no larger than a few roundings; where that takes too
/// long (near a triple root), by bisection.
constexpr float Tolerance = 1e-6F;
constexpr int NewtonIterations = 12;
constexpr int MaximumIterations = NewtonIterations + 24;

inline Real Load(const float* elements)
{
  Real value;
  std::memcpy(&value, elements, sizeof(value));
  return value;
}

inline bool IsAny(const Mask& mask)
{
  std::int32_t any = 0;
  for (std::size_t i = 0; i < BatchSize; ++i)
  {
    any |= mask[i];
  }
  return any != 0;
}

inline Real Lerp(const Real& a, const Real& b, const Real& t)
{
  return (1.0F - t) * a + t * b;
}

inline Real SquareRoot(const Real& x)
{
  Real root;
  for (std::size_t i = 0; i < BatchSize; ++i)
  {
    root[i] = std::sqrt(x[i]);
  }
  return root;
}

inline Mask IsInside(const Real& value)
{
  return value >= 0.0F;
}

struct Cubic
{
  Real B[4];

  Real Evaluate(const Real& u) const
  {
    const Real b01 = Lerp(this->B[0], this->B[1], u);
    const Real b12 = Lerp(this->B[1], this->B[2], u);
    const Real b23 = Lerp(this->B[2], this->B[3], u);
    return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
  }

  /// The value, to the last bit that of the face at the ends of the segment.
  Real EvaluateExactAtEnds(const Real& u) const
  {
    const Real inner = this->Evaluate(u);
    return u <= 0.0F ? this->B[0] : (u >= 1.0F ? this->B[3] : inner);
  }
};

/// See CubicAlongSegment in TrilinearCell.h.
Cubic MakeCubic(const Batch& batch)
{
  Real p[3];
  Real q[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = Load(batch.Entry[axis]);
    q[axis] = Load(batch.Exit[axis]);
  }
  Real x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    const Real low = Load(batch.Difference[2 * i]);
    const Real high = Load(batch.Difference[2 * i + 1]);
    x[0][i] = Lerp(low, high, p[0]);
    x[1][i] = Lerp(low, high, q[0]);
  }
  const auto blossom = [&x](int fromX, const Real& y, const Real& z) -> Real
  { return Lerp(Lerp(x[fromX][0], x[fromX][1], y), Lerp(x[fromX][2], x[fromX][3], y), z); };
  constexpr float third = 1.0F / 3.0F;
  Cubic cubic;
  cubic.B[0] = blossom(0, p[1], p[2]);
  cubic.B[1] = (blossom(1, p[1], p[2]) + blossom(0, q[1], p[2]) + blossom(0, p[1], q[2])) * third;
  cubic.B[2] = (blossom(1, q[1], p[2]) + blossom(1, p[1], q[2]) + blossom(0, q[1], q[2])) * third;
  cubic.B[3] = blossom(1, q[1], q[2]);
  return cubic;
}

/// The ends of the three monotone pieces; where there are fewer, some are empty.
void FindPieces(const Cubic& cubic, Real ends[4])
{
  const Real d0 = cubic.B[1] - cubic.B[0];
  const Real d1 = cubic.B[2] - cubic.B[1];
  const Real d2 = cubic.B[3] - cubic.B[2];
  const Real h = d1 - d0;
  const Real a = (d2 - d1) - h;
  const Real discriminant = h * h - a * d0;
  const Mask turns = discriminant > 0.0F;
  const Real root = SquareRoot(turns ? discriminant : discriminant * 0.0F);
  const Real w = -(h + (h < 0.0F ? -root : root));
  const Real e0 = w / a;
  const Real e1 = d0 / w;
  // Comparisons with NaN are false.
  const Real first = e0 < e1 ? e0 : e1;
  const Real second = e0 < e1 ? e1 : e0;
  const Real zero = d0 - d0;
  const Real one = zero + 1.0F;
  ends[0] = zero;
  ends[1] = (turns & (first > 0.0F) & (first < 1.0F)) != 0 ? first : zero;
  ends[2] = (turns & (second > 0.0F) & (second < 1.0F)) != 0 ? second : one;
  ends[3] = one;
}

/// The roots between lo and hi, in the cells where there is one. A cell that is solved keeps its
/// root while others go on: the result does not depend on the other cells of the batch.
Real RefineRoots(const Cubic& cubic, const Mask& isThere, const Real& from, const Real& to,
  const Real& atFrom, const Real& atTo)
{
  const Real* b = cubic.B;
  const Real c1 = 3.0F * (b[1] - b[0]);
  const Real c2 = 3.0F * ((b[2] - b[1]) - (b[1] - b[0]));
  const Real c3 = (b[3] - b[0]) - 3.0F * (b[2] - b[1]);
  const Mask insideAtLo = IsInside(atFrom);
  Real lo = from;
  Real hi = to;
  Real u = lo + (hi - lo) * (atFrom / (atFrom - atTo));
  u = ((u >= lo) & (u <= hi)) != 0 ? u : lo;
  Mask going = isThere;
  for (int i = 0; i < MaximumIterations; ++i)
  {
    const Real f = cubic.Evaluate(u);
    const Mask sameSide = IsInside(f) == insideAtLo;
    lo = sameSide ? u : lo;
    hi = sameSide ? hi : u;
    const Real slope = (3.0F * c3 * u + 2.0F * c2) * u + c1;
    const Real newton = u - f / slope;
    const Mask inBracket = (newton >= lo) & (newton <= hi);
    Real next = lo + 0.5F * (hi - lo);
    if (i < NewtonIterations)
    {
      next = inBracket != 0 ? newton : next;
    }
    const Real step = next - u;
    u = going != 0 ? next : u;
    going &= (step > Tolerance) | (step < -Tolerance);
    if (!IsAny(going))
    {
      break;
    }
  }
  return u;
}

}

//------------------------------------------------------------------------------
void Batch::Set(std::size_t i, const vtkIsosurfaceRayTracing::CellCorners& difference,
  const vtkIsosurfaceRayTracing::CellSegment& segment)
{
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    // What is outside stays outside: a negative number does not become zero, here nor in three
    // interpolations in turn.
    const auto value = static_cast<float>(difference[corner]);
    this->Difference[corner][i] = difference[corner] < 0.0 ? std::min(value, -0x1p-100F) : value;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Entry[axis][i] = static_cast<float>(segment.Entry[axis]);
    this->Exit[axis][i] = static_cast<float>(segment.Exit[axis]);
  }
}

//------------------------------------------------------------------------------
std::array<float, BatchSize> FindFirstRoots(const Batch& batch)
{
  std::array<float, BatchSize> roots;
  roots.fill(std::numeric_limits<float>::quiet_NaN());
  const Cubic cubic = MakeCubic(batch);
  const Mask inside = IsInside(cubic.B[0]);
  // The cells that are not solved yet. Coefficients of one sign have no root.
  Mask open = (IsInside(cubic.B[1]) != inside) | (IsInside(cubic.B[2]) != inside) |
    (IsInside(cubic.B[3]) != inside);
  if (!IsAny(open))
  {
    return roots;
  }
  Real ends[4];
  FindPieces(cubic, ends);
  Real atLo = cubic.B[0];
  Real first = Load(roots.data());
  for (int piece = 0; piece < 3; ++piece)
  {
    const Real atHi = cubic.EvaluateExactAtEnds(ends[piece + 1]);
    const Mask found = open & (IsInside(atLo) != IsInside(atHi));
    if (IsAny(found))
    {
      const Real u = RefineRoots(cubic, found, ends[piece], ends[piece + 1], atLo, atHi);
      first = found != 0 ? u : first;
      open &= ~found;
    }
    atLo = atHi;
  }
  std::memcpy(roots.data(), &first, sizeof(first));
  return roots;
}

}
}
