// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearPolynomials_h
#define TrilinearPolynomials_h

#include "Math/Arithmetic.h"
#include "Math/Vector.h"

// Trilinear functions of three coordinates between -1 and 1, as polynomials: most of what is
// nonlinear in a cell is little, and in powers about the middle it is seen how little.

namespace vtkIsosurfaceRayTracing
{

/// A trilinear function: coefficient number x + 2 y + 4 z belongs to the product of those
/// coordinates that are 1 in it.
template <typename Number>
struct TrilinearPolynomial
{
  Number Coefficients[8];

  /// Makes it eight times the function with these corners. (In place: compilers copy vectors by
  /// halves, and wait for these when the vectors are loaded.)
  SIMD_INLINE void Set(const Number corners[8])
  {
    for (int i = 0; i < 8; ++i)
    {
      this->Coefficients[i] = corners[i];
    }
    for (int bit = 1; bit < 8; bit *= 2)
    {
      for (int i = 0; i < 8; ++i)
      {
        if ((i & bit) == 0)
        {
          const Number low = this->Coefficients[i];
          const Number high = this->Coefficients[i | bit];
          this->Coefficients[i] = low + high;
          this->Coefficients[i | bit] = high - low;
        }
      }
    }
  }

  /// Makes it a function of coordinates in a box, given the middle and the half edges.
  SIMD_INLINE void Restrict(const Number middle[3], const Number half[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int bit = 1 << axis;
      for (int i = 0; i < 8; ++i)
      {
        if ((i & bit) == 0)
        {
          Number& slope = this->Coefficients[i | bit];
          this->Coefficients[i] = this->Coefficients[i] + middle[axis] * slope;
          slope = half[axis] * slope;
        }
      }
    }
  }

  /// The most that it may differ from its value in the middle.
  SIMD_INLINE Number GetVariation() const
  {
    Number sum = Abs(this->Coefficients[1]);
    for (int i = 2; i < 8; ++i)
    {
      sum = sum + Abs(this->Coefficients[i]);
    }
    return sum;
  }
};

/// Inverts a matrix of rows. Returns where it is clearly regular.
template <typename Number>
SIMD_INLINE auto InvertRows(const Number m[3][3], Number inverse[3][3])
{
  Number cofactors[3][3];
  for (int i = 0; i < 3; ++i)
  {
    const Number* a = m[(i + 1) % 3];
    const Number* b = m[(i + 2) % 3];
    for (int j = 0; j < 3; ++j)
    {
      cofactors[i][j] = a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
    }
  }
  const Number determinant = Dot(m[0], cofactors[0]);
  const Number reciprocal = 1.0 / determinant;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      inverse[i][j] = cofactors[j][i] * reciprocal;
    }
  }
  const Number size = Abs(m[0][0] * cofactors[0][0]) + Abs(m[0][1] * cofactors[0][1]) +
    Abs(m[0][2] * cofactors[0][2]);
  return (1e-280 < size) & (1e-6 * size < Abs(determinant));
}

/// Three trilinear functions, multiplied by the inverse of their Jacobian in the middle. What
/// remains of function i is Constant[i], coordinate i, and the products of coordinates.
template <typename Number>
struct PreconditionedTrilinears
{
  Number Inverse[3][3];
  Number Constant[3];
  /// The coefficients of x y, x z, y z and x y z.
  Number Products[3][4];

  /// Returns where the Jacobian is clearly regular. Elsewhere the numbers may be anything.
  SIMD_INLINE auto Find(const TrilinearPolynomial<Number> functions[3])
  {
    Number jacobian[3][3];
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        jacobian[i][axis] = functions[i].Coefficients[1 << axis];
      }
    }
    const auto isRegular = InvertRows(jacobian, this->Inverse);
    constexpr int products[4] = { 3, 5, 6, 7 };
    for (int i = 0; i < 3; ++i)
    {
      this->Constant[i] = this->Combine(functions, i, 0);
      for (int k = 0; k < 4; ++k)
      {
        this->Products[i][k] = this->Combine(functions, i, products[k]);
      }
    }
    return isRegular;
  }

  /// The most that the products of a function may be, given that of the coordinates.
  SIMD_INLINE Number GetSize(int i, const Number most[3]) const
  {
    const Number* p = this->Products[i];
    return most[0] * (Abs(p[0]) * most[1] + Abs(p[1]) * most[2]) +
      (Abs(p[2]) + Abs(p[3]) * most[0]) * (most[1] * most[2]);
  }

  /// The most that their derivatives may be.
  SIMD_INLINE void FindSteepness(int i, const Number most[3], Number steepness[3]) const
  {
    const Number* p = this->Products[i];
    const Number xyz = Abs(p[3]);
    steepness[0] = Abs(p[0]) * most[1] + (Abs(p[1]) + xyz * most[1]) * most[2];
    steepness[1] = Abs(p[0]) * most[0] + (Abs(p[2]) + xyz * most[0]) * most[2];
    steepness[2] = Abs(p[1]) * most[0] + (Abs(p[2]) + xyz * most[0]) * most[1];
  }

  SIMD_INLINE void EvaluateProducts(const Number x[3], Number values[3]) const
  {
    const Number xy = x[0] * x[1];
    const Number xz = x[0] * x[2];
    const Number yz = x[1] * x[2];
    for (int i = 0; i < 3; ++i)
    {
      const Number* p = this->Products[i];
      values[i] = p[0] * xy + p[1] * xz + (p[2] + p[3] * x[0]) * yz;
    }
  }

  /// The inverse of the Jacobian at a point.
  SIMD_INLINE void InvertJacobian(const Number x[3], Number inverse[3][3]) const
  {
    Number rows[3][3];
    for (int i = 0; i < 3; ++i)
    {
      const Number* p = this->Products[i];
      rows[i][0] = p[0] * x[1] + (p[1] + p[3] * x[1]) * x[2];
      rows[i][1] = p[0] * x[0] + (p[2] + p[3] * x[0]) * x[2];
      rows[i][2] = p[1] * x[0] + (p[2] + p[3] * x[0]) * x[1];
      rows[i][i] = rows[i][i] + 1.0;
    }
    InvertRows(rows, inverse);
  }

private:
  SIMD_INLINE Number Combine(
    const TrilinearPolynomial<Number> functions[3], int row, int number) const
  {
    return this->Inverse[row][0] * functions[0].Coefficients[number] +
      this->Inverse[row][1] * functions[1].Coefficients[number] +
      this->Inverse[row][2] * functions[2].Coefficients[number];
  }
};

}

#endif
