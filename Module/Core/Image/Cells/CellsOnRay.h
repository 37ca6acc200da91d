// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellsOnRay_h
#define CellsOnRay_h

#include "Image/Cells/CellSegment.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A cell that a ray passes, and its segment there.
struct CellOnRay
{
  Index3 Cell;
  CellSegment Segment;
};

/// Finds those of some cells that a ray passes, in order along the ray.
void FindCellsOnRay(
  const Ray& ray, const std::vector<Index3>& cells, std::vector<CellOnRay>& onRay);

}

#endif
