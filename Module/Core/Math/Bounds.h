// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Bounds_h
#define Bounds_h

#include "Math/Vector.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// A box along the axes.
struct Bounds
{
  Vector3 Lower;
  Vector3 Upper;
};

/// The bounds of nothing, to which others are added.
inline Bounds NoBounds()
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return { { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
}

/// The bounds of two boxes.
inline Bounds Unite(const Bounds& a, const Bounds& b)
{
  Bounds both = a;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    both.Lower[axis] = std::min(a.Lower[axis], b.Lower[axis]);
    both.Upper[axis] = std::max(a.Upper[axis], b.Upper[axis]);
  }
  return both;
}

inline Vector3 GetCenter(const Bounds& box)
{
  return box.Lower + (box.Upper - box.Lower) * 0.5;
}

/// One of the eight corners of a box.
inline Vector3 GetCorner(const Bounds& box, int corner)
{
  return { (corner & 1) != 0 ? box.Upper[0] : box.Lower[0],
    (corner & 2) != 0 ? box.Upper[1] : box.Lower[1],
    (corner & 4) != 0 ? box.Upper[2] : box.Lower[2] };
}

/// The bounds of a box that is transformed.
inline Bounds TransformBounds(const Matrix4& matrix, const Bounds& box)
{
  Bounds result = NoBounds();
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 point = TransformPoint(matrix, GetCorner(box, corner));
    result = Unite(result, { point, point });
  }
  return result;
}

}

#endif
