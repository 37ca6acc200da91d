// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Matrices_h
#define Matrices_h

#include "Math/Matrix.h"

#include <cmath>
#include <cstddef>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

/// By elimination, with the largest pivot of each column.
inline Matrix4 Invert(const Matrix4& matrix)
{
  long double rows[4][8] = {};
  for (std::size_t i = 0; i < 16; ++i)
  {
    rows[i / 4][i % 4] = static_cast<long double>(matrix[i]);
    rows[i / 4][4 + i / 4] = 1.0L;
  }
  for (std::size_t column = 0; column < 4; ++column)
  {
    std::size_t pivot = column;
    for (std::size_t row = column; row < 4; ++row)
    {
      pivot = std::abs(rows[row][column]) > std::abs(rows[pivot][column]) ? row : pivot;
    }
    std::swap(rows[pivot], rows[column]);
    for (std::size_t row = 0; row < 4; ++row)
    {
      const long double factor = rows[row][column] / rows[column][column];
      for (std::size_t k = 0; row != column && k < 8; ++k)
      {
        rows[row][k] -= factor * rows[column][k];
      }
    }
  }
  Matrix4 inverse;
  for (std::size_t i = 0; i < 16; ++i)
  {
    inverse[i] = static_cast<double>(rows[i / 4][4 + i % 4] / rows[i / 4][i / 4]);
  }
  return inverse;
}

/// Looks along -z from the origin, as OpenGL has it.
inline Matrix4 Perspective(double near, double far, double tangentOfHalfAngle)
{
  const double s = 1.0 / tangentOfHalfAngle;
  return { s, 0.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, (near + far) / (near - far),
    2.0 * near * far / (near - far), 0.0, 0.0, -1.0, 0.0 };
}

inline Matrix4 Orthographic(double near, double far, double halfHeight)
{
  const double s = 1.0 / halfHeight;
  return { s, 0.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, 0.0, 2.0 / (near - far),
    (near + far) / (near - far), 0.0, 0.0, 0.0, 1.0 };
}

inline Matrix4 Translation(const Vector3& by)
{
  return { 1.0, 0.0, 0.0, by[0], 0.0, 1.0, 0.0, by[1], 0.0, 0.0, 1.0, by[2], 0.0, 0.0, 0.0, 1.0 };
}

inline Matrix4 Scaling(const Vector3& by)
{
  return { by[0], 0.0, 0.0, 0.0, 0.0, by[1], 0.0, 0.0, 0.0, 0.0, by[2], 0.0, 0.0, 0.0, 0.0, 1.0 };
}

/// About the z axis and then about the x axis, in radians.
inline Matrix4 Rotation(double aboutZ, double aboutX)
{
  const double c = std::cos(aboutZ);
  const double s = std::sin(aboutZ);
  const Matrix4 z = { c, -s, 0.0, 0.0, s, c, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0 };
  const double d = std::cos(aboutX);
  const double t = std::sin(aboutX);
  return Multiply({ 1.0, 0.0, 0.0, 0.0, 0.0, d, -t, 0.0, 0.0, t, d, 0.0, 0.0, 0.0, 0.0, 1.0 }, z);
}

}

#endif
