// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/CellsOnRay.h"

#include "Kernels/Kernels.h"
#include "Math/Compiler.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void FindCellsOnRay(const Kernels& kernels, const LatticePlanes* planes, const RayPacket& rays,
  int ray, const std::vector<Index3>& cells, std::vector<CellOnRay>& onRay)
{
  onRay.clear();
  SegmentsInCells found;
  int numbers[3][SegmentsInCells::Capacity];
  for (std::size_t first = 0; first < cells.size(); first += SegmentsInCells::Capacity)
  {
    for (std::size_t i = 0; i < SegmentsInCells::Capacity; ++i)
    {
      const Index3& cell = cells[std::min(first + i, cells.size() - 1)];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        numbers[axis][i] = cell[axis];
      }
    }
    const std::size_t count =
      std::min<std::size_t>(cells.size() - first, SegmentsInCells::Capacity);
    unsigned int passed =
      kernels.FindSegmentsInCells(rays, ray, planes, numbers, static_cast<int>(count), found);
    for (; passed != 0; passed &= passed - 1)
    {
      const int i = LowestBit(passed);
      onRay.push_back({ cells[first + static_cast<std::size_t>(i)],
        { found.Begin[i], found.End[i], static_cast<int>(found.BeginAxis[i]),
          { found.Entry[0][i], found.Entry[1][i], found.Entry[2][i] },
          { found.Exit[0][i], found.Exit[1][i], found.Exit[2][i] } } });
    }
  }
  const Vector3 direction = rays.GetDirection(ray);
  std::sort(onRay.begin(), onRay.end(),
    [&direction](const CellOnRay& a, const CellOnRay& b)
    {
      return IsEnteredBefore(a.Cell, { a.Segment.Begin, a.Segment.BeginAxis }, b.Cell,
        { b.Segment.Begin, b.Segment.BeginAxis }, direction);
    });
}

}
