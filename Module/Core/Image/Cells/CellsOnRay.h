// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellsOnRay_h
#define CellsOnRay_h

#include "Image/Cells/CellSegment.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

struct Kernels;
struct LatticePlanes;
struct RayPacket;

/// A cell that a ray passes, and its segment there.
struct CellOnRay
{
  Index3 Cell;
  CellSegment Segment;
};

/// Finds those of some cells that a ray of a packet passes, in order along the ray. The planes of
/// the lattice are null where they stand at whole numbers.
void FindCellsOnRay(const Kernels& kernels, const LatticePlanes* planes, const RayPacket& rays,
  int ray, const std::vector<Index3>& cells, std::vector<CellOnRay>& onRay);

}

#endif
