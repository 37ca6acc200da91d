// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Interpolation of points and of gradients between the corners of cells. Included by Kernels.inl
// only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// In vectors of x, y, z and nothing.
template <typename Number>
SIMD_INLINE void SumVectorsAtCorners(const Number* vectors, const WeightedCorners& corners,
  int first, double (*sums)[RayPacket::Capacity])
{
  using Doubles4 = ShortVector<double, 4>::Type;
  for (int i = 0; i < corners.Count; ++i)
  {
    Doubles4 sum = {};
    for (int corner = 0; corner < corners.Corners[i]; ++corner)
    {
      const Number* vector = vectors + 3 * corners.Ids[i][corner];
      const typename ShortVector<Number, 4>::Type numbers = { vector[0], vector[1], vector[2] };
      Doubles4 wide;
      Convert(numbers, wide);
      sum = sum + wide * corners.Weights[i][corner];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      sums[axis][first + i] = sum[axis];
    }
  }
}

void SumAtCorners(const void* vectors, bool areFloats, const WeightedCorners& corners, int first,
  double (*sums)[RayPacket::Capacity])
{
  if (areFloats)
  {
    SumVectorsAtCorners(static_cast<const float*>(vectors), corners, first, sums);
  }
  else
  {
    SumVectorsAtCorners(static_cast<const double*>(vectors), corners, first, sums);
  }
}

}
}
