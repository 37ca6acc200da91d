// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxGroup_h
#define BoxGroup_h

namespace vtkIsosurfaceRayTracing
{

/// Boxes in arrays.
struct alignas(64) BoxGroup
{
  static constexpr int Size = 8;

  double Lower[3][Size];
  double Upper[3][Size];
};

/// A plane at the side of a frustum, which is where the normal points to.
struct FrustumSide
{
  double Normal[3];
  /// Of a point at the plane, the height is the product with the normal, and this; boxes get more
  /// than what rounding may take from them.
  double Offset;
  /// Along each axis, whether the upper end of boxes is the higher one.
  bool IsUpperHigher[3];
};

}

#endif
