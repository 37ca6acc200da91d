// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CornerOrder_h
#define CornerOrder_h

#include "Math/Vector.h"
#include "Mesh/MeshCell.h"

#include <cstddef>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

/// The corners of a tetrahedron in the order of their ids, which is the same in all cells.
struct CornerOrder
{
  unsigned char Corners[4] = { 0, 1, 2, 3 };

  CornerOrder() = default;
  explicit CornerOrder(const MeshCell& cell)
  {
    // Of equal ids the first corner is first.
    const auto sort = [this, &cell](std::size_t a, std::size_t b)
    {
      const bool isInOrder = std::pair(cell.Ids[this->Corners[a]], this->Corners[a]) <
        std::pair(cell.Ids[this->Corners[b]], this->Corners[b]);
      if (!isInOrder)
      {
        std::swap(this->Corners[a], this->Corners[b]);
      }
    };
    sort(0, 1);
    sort(2, 3);
    sort(0, 2);
    sort(1, 3);
    sort(1, 2);
  }

  /// VTK's parametric coordinates of a point, given the weights of the corners in this order.
  Vector3 GetParametric(const double* weights) const
  {
    double ofCorners[4];
    for (std::size_t i = 0; i < 4; ++i)
    {
      ofCorners[this->Corners[i]] = weights[i];
    }
    return { ofCorners[1], ofCorners[2], ofCorners[3] };
  }
};

}

#endif
