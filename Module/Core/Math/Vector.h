// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Vector_h
#define Vector_h

#include "Math/Arithmetic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// A point or a direction. Where it is used tells the space it is in.
using Vector3 = std::array<double, 3>;
/// Lattice coordinates: of a sample, a cell, a brick or a macrocell; or how many there are of them.
using Index3 = std::array<int, 3>;
/// Row-major 4 x 4 matrix, applied to column vectors, as vtkMatrix4x4 has it.
using Matrix4 = std::array<double, 16>;

inline Vector3 operator+(const Vector3& a, const Vector3& b)
{
  return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
}

inline Vector3 operator-(const Vector3& a, const Vector3& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

inline Vector3 operator*(const Vector3& a, double s)
{
  return { a[0] * s, a[1] * s, a[2] * s };
}

template <typename Number>
SIMD_INLINE Number Dot(const Number a[3], const Number b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double Dot(const Vector3& a, const Vector3& b)
{
  return Dot(a.data(), b.data());
}

inline Vector3 Cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

/// Whether the square of a length neither overflowed nor lost digits.
template <typename Number>
SIMD_INLINE auto IsSafeSquare(Number square)
{
  return (1e-280 < square) & (square < 1e280);
}

/// The length of a vector, whose squares may overflow or vanish.
inline double Length(const Vector3& a)
{
  const double square = Dot(a, a);
  if (IsSafeSquare(square))
  {
    return std::sqrt(square);
  }
  const double size = std::max(std::max(std::abs(a[0]), std::abs(a[1])), std::abs(a[2]));
  if (!(size > 0.0))
  {
    return 0.0;
  }
  const Vector3 scaled = { a[0] / size, a[1] / size, a[2] / size };
  return size * std::sqrt(Dot(scaled, scaled));
}

/// Brings a vector to length one, times a factor, where the square of its length is safe. Returns
/// where it is.
template <typename Number>
SIMD_INLINE auto Normalize(Number a[3], double factor)
{
  const Number square = Dot(a, a);
  const Number inverse = 1.0 / Sqrt(square);
  for (int i = 0; i < 3; ++i)
  {
    a[i] = a[i] * inverse * factor;
  }
  return IsSafeSquare(square);
}

/// The vector at length one; a zero vector stays zero.
inline Vector3 Normalized(const Vector3& a)
{
  Vector3 normalized = a;
  if (Normalize(normalized.data(), 1.0))
  {
    return normalized;
  }
  const double size = std::max(std::max(std::abs(a[0]), std::abs(a[1])), std::abs(a[2]));
  if (!(size > 0.0))
  {
    return a;
  }
  const Vector3 scaled = { a[0] / size, a[1] / size, a[2] / size };
  return scaled * (1.0 / std::sqrt(Dot(scaled, scaled)));
}

/// Transforms a point whose homogeneous coordinate stays 1.
inline Vector3 TransformPoint(const Matrix4& m, const Vector3& p)
{
  return { m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3],
    m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
    m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11] };
}

/// Transforms a direction: the linear part of the matrix alone.
template <typename Number>
SIMD_INLINE void TransformDirection(const double* m, const Number d[3], Number transformed[3])
{
  for (int i = 0; i < 3; ++i)
  {
    transformed[i] = m[4 * i] * d[0] + m[4 * i + 1] * d[1] + m[4 * i + 2] * d[2];
  }
}

inline Vector3 TransformDirection(const Matrix4& m, const Vector3& d)
{
  Vector3 transformed;
  TransformDirection(m.data(), d.data(), transformed.data());
  return transformed;
}

/// Multiplies by the transposed linear part. With the inverse of a transformation this carries a
/// gradient to the space the transformation leads to.
inline Vector3 TransposeTransformDirection(const Matrix4& m, const Vector3& g)
{
  return { m[0] * g[0] + m[4] * g[1] + m[8] * g[2], m[1] * g[0] + m[5] * g[1] + m[9] * g[2],
    m[2] * g[0] + m[6] * g[1] + m[10] * g[2] };
}

/// The number of lattice points in a box.
inline std::size_t Count(const Index3& size)
{
  return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) *
    static_cast<std::size_t>(size[2]);
}

/// The offset of an index in an array with x fastest.
inline std::size_t Offset(const Index3& index, const Index3& size)
{
  return static_cast<std::size_t>(index[0]) +
    static_cast<std::size_t>(size[0]) *
    (static_cast<std::size_t>(index[1]) +
      static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(index[2]));
}

/// How many blocks of the given edge cover a size.
inline Index3 BlocksCovering(const Index3& size, int edge)
{
  const auto cover = [edge](int length) { return length / edge + (length % edge != 0 ? 1 : 0); };
  return { cover(size[0]), cover(size[1]), cover(size[2]) };
}

}

#endif
