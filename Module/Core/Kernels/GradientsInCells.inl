// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradients in tetrahedra, and at the corners of hexahedra. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE void Cross(const Doubles a[3], const Doubles b[3], Doubles result[3])
{
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    result[i] = a[j] * b[k] - a[k] * b[j];
  }
}

void WeightGradients(const double (*corners)[4][4], int count, WeightedGradients& gradients)
{
  for (int first = 0; first < count; first += DoubleWidth)
  {
    Doubles numbers[4][4];
    for (int corner = 0; corner < 4; ++corner)
    {
      LoadCorner(corners, first, count, corner, numbers[corner]);
    }
    // The edges from the first corner, and the rises of the value along them.
    for (int corner = 1; corner < 4; ++corner)
    {
      for (int i = 0; i < 4; ++i)
      {
        numbers[corner][i] = numbers[corner][i] - numbers[0][i];
      }
    }
    Doubles across[3][3];
    Cross(numbers[2], numbers[3], across[0]);
    Cross(numbers[3], numbers[1], across[1]);
    Cross(numbers[1], numbers[2], across[2]);
    const Doubles determinant =
      numbers[1][0] * across[0][0] + numbers[1][1] * across[0][1] + numbers[1][2] * across[0][2];
    // The gradient is the sum below, divided by the determinant; flat cells have none.
    const Mask isFlat = AreFlat(numbers[1], numbers[2], numbers[3], determinant);
    const Doubles sign = Select(isFlat, 0.0, CopySign(1.0, determinant));
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles sum = numbers[1][3] * across[0][axis] + numbers[2][3] * across[1][axis] +
        numbers[3][3] * across[2][axis];
      Store(sign * sum, &gradients.Gradient[axis][first]);
    }
    Store(Select(isFlat, 0.0, Abs(determinant)), &gradients.Weight[first]);
  }
}

//------------------------------------------------------------------------------
/// The edges of a vector of hexahedra along each axis, from the corner number x + 2 y + 4 z at
/// their lower end, and in place of a fourth coordinate the rises of the value along them. Those at
/// other corners are not set.
struct HexahedronEdges
{
  Doubles Along[3][8][4];
  /// Four times the edges in the middle.
  Doubles Middle[3][4];

  SIMD_INLINE explicit HexahedronEdges(const Doubles (&corners)[8][4])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (Doubles& number : this->Middle[axis])
      {
        number = 0.0;
      }
      for (int low = 0; low < 8; ++low)
      {
        const int high = low | 1 << axis;
        for (int i = 0; i < 4 && high != low; ++i)
        {
          const Doubles rise = corners[high][i] - corners[low][i];
          this->Along[axis][low][i] = rise;
          this->Middle[axis][i] = this->Middle[axis][i] + rise;
        }
      }
    }
  }

  /// That at a corner. It may lead away from it or to it: the gradient is the same.
  SIMD_INLINE const Doubles* Get(int axis, int corner) const
  {
    return this->Along[axis][corner & ~(1 << axis)];
  }
};

/// At a corner the gradient is that in the tetrahedron between its three edges.
void FindCornerGradients(
  const double (*corners)[PassedCellRecords::Corners][4], int count, CornerGradients& gradients)
{
  for (int first = 0; first < count; first += DoubleWidth)
  {
    Doubles numbers[8][4];
    for (int corner = 0; corner < 8; ++corner)
    {
      LoadCorner(corners, first, count, corner, numbers[corner]);
    }
    const HexahedronEdges edges(numbers);
    const auto& m = edges.Middle;
    Doubles across[3][3];
    Cross(m[0], m[1], across[2]);
    // Zero times a number that is not finite is NaN.
    const Doubles rises = m[0][3] + m[1][3] + m[2][3];
    const Doubles volume =
      (1.0 / 64.0) * Abs(m[2][0] * across[2][0] + m[2][1] * across[2][1] + m[2][2] * across[2][2]) +
      0.0 * rises;
    Store(volume, &gradients.Volume[first]);
    for (int corner = 0; corner < 8; ++corner)
    {
      const Doubles* x = edges.Get(0, corner);
      const Doubles* y = edges.Get(1, corner);
      const Doubles* z = edges.Get(2, corner);
      Cross(y, z, across[0]);
      Cross(z, x, across[1]);
      Cross(x, y, across[2]);
      const Doubles determinant = x[0] * across[0][0] + x[1] * across[0][1] + x[2] * across[0][2];
      const Doubles factor = Select(AreFlat(x, y, z, determinant), Infinity, volume / determinant);
      for (int axis = 0; axis < 3; ++axis)
      {
        const Doubles sum =
          x[3] * across[0][axis] + y[3] * across[1][axis] + z[3] * across[2][axis];
        Store(factor * sum, &gradients.Gradient[corner][axis][first]);
      }
    }
  }
}

}
}
