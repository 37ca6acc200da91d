// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CornerOrder_h
#define CornerOrder_h

#include "Math/Vector.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// The corners of a tetrahedron in the order of their ids, which is the same in all cells.
struct CornerOrder
{
  unsigned char Corners[4] = { 0, 1, 2, 3 };
  /// Where each corner is among them.
  unsigned char Places[4] = { 0, 1, 2, 3 };

  CornerOrder() = default;
  /// Of equal ids the first corner is first.
  template <typename Id>
  explicit CornerOrder(const Id* ids)
  {
    // Numbers that are in the order of the ids first, and of the corners next.
    std::int64_t keys[4];
    for (int i = 0; i < 4; ++i)
    {
      keys[i] = std::int64_t{ ids[i] } * 4 + i;
    }
    const auto sort = [&keys](int a, int b)
    {
      const std::int64_t low = std::min(keys[a], keys[b]);
      keys[b] = std::max(keys[a], keys[b]);
      keys[a] = low;
    };
    sort(0, 1);
    sort(2, 3);
    sort(0, 2);
    sort(1, 3);
    sort(1, 2);
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->Corners[i] = static_cast<unsigned char>(keys[i] % 4);
      this->Places[this->Corners[i]] = static_cast<unsigned char>(i);
    }
  }

  /// VTK's parametric coordinates of a point, given the weights of the corners in this order, at
  /// some distance from each other.
  Vector3 GetParametric(const double* weights, int stride = 1) const
  {
    return { weights[stride * this->Places[1]], weights[stride * this->Places[2]],
      weights[stride * this->Places[3]] };
  }
};

}

#endif
