// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Boxes that a frustum may meet. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

unsigned int FindMetBoxes(const BoxGroup& boxes, const FrustumSide* sides, int count)
{
  unsigned int met = 0;
  for (int i = 0; i < BoxGroup::Size; i += DoubleWidth)
  {
    Mask isMet = ToMask((1U << DoubleWidth) - 1);
    for (const FrustumSide* side = sides; side != sides + count; ++side)
    {
      Doubles highest[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        const double* ends = side->IsUpperHigher[axis] ? boxes.Upper[axis] : boxes.Lower[axis];
        highest[axis] = side->Normal[axis] * Load(&ends[i]);
      }
      isMet = isMet & (0.0 <= highest[0] + highest[1] + highest[2] + side->Offset);
    }
    met |= ToBits(isMet) << i;
  }
  return met;
}

}
}
