// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The gradients in tetrahedra. Included by Kernels.inl only.

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
    const Doubles sign = Select(determinant == 0.0, 0.0, CopySign(1.0, determinant));
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles sum = numbers[1][3] * across[0][axis] + numbers[2][3] * across[1][axis] +
        numbers[3][3] * across[2][axis];
      Store(sign * sum, &gradients.Gradient[axis][first]);
    }
    Store(Abs(determinant), &gradients.Weight[first]);
  }
}

}
}
