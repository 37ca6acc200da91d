// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Cells on the lattices of the levels of a refined grid: their indices and boxes of them.

#ifndef AmrCells_h
#define AmrCells_h

#include "Math/Bounds.h"
#include "Math/Vector.h"

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// The largest whole number that is not above a quotient.
inline int FloorDivide(int dividend, int divisor)
{
  return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

/// Whether a cell is in the box of a patch or of a region.
template <typename Cells>
bool IsIn(const Cells& cells, const Index3& cell)
{
  bool isIn = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int place = cell[axis] - cells.First[axis];
    isIn = isIn && place >= 0 && place < cells.Cells[axis];
  }
  return isIn;
}

/// Calls visit(index) for the indices of a box, which may be empty.
template <typename Visit>
void ForEachIndex(const Index3& first, const Index3& count, const Visit& visit)
{
  Index3 i;
  for (i[2] = first[2]; i[2] < first[2] + count[2]; ++i[2])
  {
    for (i[1] = first[1]; i[1] < first[1] + count[1]; ++i[1])
    {
      for (i[0] = first[0]; i[0] < first[0] + count[0]; ++i[0])
      {
        visit(i);
      }
    }
  }
}

/// The cell behind the last one, along each axis.
inline Index3 GetEnd(const Index3& first, const Index3& count)
{
  return { first[0] + count[0], first[1] + count[1], first[2] + count[2] };
}

/// The box of some cells of a level.
inline Bounds GetBox(const Index3& first, const Index3& count)
{
  Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Lower[axis] = first[axis];
    box.Upper[axis] = first[axis] + count[axis];
  }
  return box;
}

/// Whether boxes have cells in common.
inline bool Overlap(const Bounds& a, const Bounds& b)
{
  bool overlap = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    overlap = overlap && a.Lower[axis] < b.Upper[axis] && b.Lower[axis] < a.Upper[axis];
  }
  return overlap;
}

}

#endif
