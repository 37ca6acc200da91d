// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelRays_h
#define PixelRays_h

#include "Math/Arithmetic.h"

namespace vtkIsosurfaceRayTracing
{

/// Makes rays through the centres of pixels, from t = 0 at the near plane up to a depth in [0, 1]
/// as in the depth buffer. The matrix is row-major and leads from clip coordinates to object space;
/// the size is that of the viewport, in pixels.
///
/// The line through a pixel has homogeneous points a + z b, where z is the clip coordinate, -1 at
/// the near plane and 1 at the far plane. Its direction, b wa - a wb, is found without going to the
/// far plane, which may be very far.
template <typename Number>
SIMD_INLINE void MakePixelRays(const double* objectFromClip, double width, double height,
  Number column, Number row, Number depth, Number origin[3], Number direction[3], Number& end)
{
  const double* m = objectFromClip;
  const Number x = (column + 0.5) * (2.0 / width) - 1.0;
  const Number y = (row + 0.5) * (2.0 / height) - 1.0;
  const Number wa = m[12] * x + m[13] * y + m[15];
  const Number wb = m[14];
  const Number wNear = wa - wb;
  const Number inverseNear = 1.0 / wNear;
  for (int i = 0; i < 3; ++i)
  {
    const Number a = m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 3];
    const Number b = m[4 * i + 2];
    origin[i] = (a - b) * inverseNear;
    direction[i] = b * wa - a * wb;
  }
  const Number z = 2.0 * depth - 1.0;
  end = (z + 1.0) / ((wa + z * wb) * wNear);
  end = Select(0.0 <= end, end, Infinity);
}

/// The depth in [0, 1] of a point in object space.
template <typename Number>
SIMD_INLINE Number GetPixelDepth(const double* clipFromObject, const Number point[3])
{
  const double* m = clipFromObject;
  const Number z = m[8] * point[0] + m[9] * point[1] + m[10] * point[2] + m[11];
  const Number w = m[12] * point[0] + m[13] * point[1] + m[14] * point[2] + m[15];
  return 0.5 * z / w + 0.5;
}

}

#endif
