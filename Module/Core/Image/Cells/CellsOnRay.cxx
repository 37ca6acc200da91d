// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Cells/CellsOnRay.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void FindCellsOnRay(const Ray& ray, const std::vector<Index3>& cells, std::vector<CellOnRay>& onRay)
{
  onRay.clear();
  for (const Index3& cell : cells)
  {
    CellSegment segment;
    if (SegmentInCell(ray, cell, segment))
    {
      onRay.push_back({ cell, segment });
    }
  }
  std::sort(onRay.begin(), onRay.end(),
    [&ray](const CellOnRay& a, const CellOnRay& b)
    {
      return IsEnteredBefore(a.Cell, { a.Segment.Begin, a.Segment.BeginAxis }, b.Cell,
        { b.Segment.Begin, b.Segment.BeginAxis }, ray.Direction);
    });
}

}
