// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Matrix_h
#define Matrix_h

#include "Math/Vector.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

inline Matrix4 Multiply(const Matrix4& a, const Matrix4& b)
{
  Matrix4 result = {};
  for (std::size_t row = 0; row < 4; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      for (std::size_t i = 0; i < 4; ++i)
      {
        result[4 * row + column] += a[4 * row + i] * b[4 * i + column];
      }
    }
  }
  return result;
}

/// The columns of the linear part of a matrix at length one, so that no spacing overflows, their
/// lengths, and the rows of the matrix of cofactors of the columns: cross products.
struct AffineAxes
{
  explicit AffineAxes(const Matrix4& m)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector3 column = { m[i], m[4 + i], m[8 + i] };
      this->Lengths[i] = Length(column);
      this->Columns[i] = Normalized(column);
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->Cofactors[i] = Cross(this->Columns[(i + 1) % 3], this->Columns[(i + 2) % 3]);
    }
    this->Determinant = Dot(this->Columns[0], this->Cofactors[0]);
  }

  Vector3 Columns[3];
  Vector3 Lengths;
  Vector3 Cofactors[3];
  double Determinant;
};

/// The inverse of an affine transformation.
inline Matrix4 InvertAffine(const Matrix4& m)
{
  const AffineAxes axes(m);
  Matrix4 result = {};
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      result[4 * row + column] = axes.Cofactors[row][column] / axes.Determinant / axes.Lengths[row];
    }
  }
  const Vector3 origin = TransformDirection(result, { m[3], m[7], m[11] });
  result[3] = -origin[0];
  result[7] = -origin[1];
  result[11] = -origin[2];
  result[15] = 1.0;
  return result;
}

/// The matrix that carries gradients from the space a transformation starts from to the one it
/// leads to: the transposed of its inverse, up to a positive factor, for transformations that
/// mirror too.
inline Matrix4 NormalMatrix(const Matrix4& m)
{
  const AffineAxes axes(m);
  const double sign = std::copysign(1.0, axes.Determinant);
  const double shortest = std::min(std::min(axes.Lengths[0], axes.Lengths[1]), axes.Lengths[2]);
  Matrix4 result = {};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t row = 0; row < 3; ++row)
    {
      result[4 * row + i] = axes.Cofactors[i][row] * (sign * (shortest / axes.Lengths[i]));
    }
  }
  return result;
}

}

#endif
