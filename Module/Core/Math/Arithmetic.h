// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Arithmetic_h
#define Arithmetic_h

#include "Math/Compiler.h"

#include <cmath>
#include <limits>

// What the kernels share with the rest of the core is written once, as templates of a Number: a
// double, or a SIMD vector of doubles (Kernels/Vectors.h), with a comparison for each lane. It is
// SIMD_INLINE, always: otherwise the linker might keep the copy that was compiled for a processor
// which is not there. For the same reason it calls nothing of the standard library but C's
// functions.

namespace vtkIsosurfaceRayTracing
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr float FloatInfinity = std::numeric_limits<float>::infinity();

// The operations of a Number, for double. Those of vectors have the same names and give the same
// bits, of NaN and of the signs of zeros too.

SIMD_INLINE bool AndNot(bool a, bool b)
{
  return a && !b;
}

SIMD_INLINE bool Any(bool a)
{
  return a;
}

SIMD_INLINE unsigned int ToBits(bool a)
{
  return a ? 1U : 0U;
}

SIMD_INLINE void Store(double a, double* to)
{
  *to = a;
}

SIMD_INLINE double Select(bool condition, double yes, double no)
{
  return condition ? yes : no;
}

/// As std::min chooses.
SIMD_INLINE double Min(double a, double b)
{
  return b < a ? b : a;
}

/// As std::max chooses.
SIMD_INLINE double Max(double a, double b)
{
  return a < b ? b : a;
}

SIMD_INLINE double Abs(double a)
{
  return std::fabs(a);
}

/// The first with the sign of the second.
SIMD_INLINE double CopySign(double a, double b)
{
  return std::copysign(a, b);
}

SIMD_INLINE double Sqrt(double a)
{
  return std::sqrt(a);
}

SIMD_INLINE double Floor(double a)
{
  return std::floor(a);
}

/// a b + c, rounded once.
SIMD_INLINE double FusedMultiplyAdd(double a, double b, double c)
{
  return std::fma(a, b, c);
}

/// As std::clamp chooses: NaN stays.
template <typename Number>
SIMD_INLINE Number Clamp(Number value, Number low, Number high)
{
  return Select(value < low, low, Select(high < value, high, value));
}

/// The sign rule of the whole ray tracer: a value equal to the isovalue is inside. A root is where
/// the sign changes. Touching the isovalue from inside is no root; touching it from outside is two
/// roots at one point, an entry and an exit.
template <typename Number>
SIMD_INLINE auto IsInside(Number valueMinusIsovalue)
{
  return 0.0 <= valueMinusIsovalue;
}

/// Linear interpolation that is exact at both ends and never changes the common sign of a and b,
/// unless they all but vanish (see SmallestDifference). (a + t (b - a) is neither.) Written without
/// fma, so that every instruction set gives one result.
template <typename Number>
SIMD_INLINE Number Lerp(Number a, Number b, Number t)
{
  return (1.0 - t) * a + t * b;
}

}

#endif
