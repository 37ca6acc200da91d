// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayHitsInCells_h
#define RayHitsInCells_h

#include "Mesh/CellHits.h"
#include "Mesh/MeshSelection.h"
#include "Rays/Hit.h"
#include "Rays/RayFrame.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The part of a ray that is traced, Begin <= t <= End, counted from Base on the ray as it was
/// given. Beyond an opaque hit there are only those at its place; see HitOrder.h.
struct RayPart
{
  double Begin;
  double End;
  double Base;
};

/// Appends a hit with a surface in a cell if it is in the part of the ray, and visible. The part
/// ends at the place of an opaque one.
void KeepHit(const MeshSelection& selection, const CellHit& found, std::int64_t cell, int surface,
  RayPart& part, std::vector<Hit>& hits);

/// Appends all hits with a surface in a cell.
void KeepHitsInCell(const MeshSelection& selection, const RayFrame& frame, std::int64_t cell,
  int surface, CellHits& inCell, RayPart& part, std::vector<Hit>& hits);

}

#endif
