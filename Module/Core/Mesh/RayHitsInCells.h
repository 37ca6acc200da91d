// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayHitsInCells_h
#define RayHitsInCells_h

#include "Field/Departure.h"
#include "Mesh/CellHits.h"
#include "Mesh/HitOrder.h"
#include "Mesh/MeshSelection.h"
#include "Rays/Hit.h"
#include "Rays/RayFrame.h"

#include <algorithm>
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
  /// Of a secondary ray, which ends at any hit but the one that it starts on, and the t that this
  /// one is before; else null.
  const Departure* From = nullptr;
  double EndOfStart = 0.0;

  bool Has(double t) const { return t >= this->Begin && t <= this->End; }
};

/// Whether a hit is in a part of the field that is visible.
bool IsVisible(const MeshSelection& selection, const Hit& hit);

/// Whether a hit at t in a part of a ray is kept: if it is visible. The part ends at the place of
/// an opaque one; that of a secondary ray no longer has anything but its begin.
inline bool KeepHit(const MeshSelection& selection, const Hit& hit, double t, RayPart& part)
{
  if (part.From)
  {
    const bool isOwn = hit.T < part.EndOfStart && part.From->Is(hit.Surface, hit.Entering);
    part.End = isOwn ? part.End : part.Begin;
    return !isOwn;
  }
  if (!selection.Request.Visible.IsConvex() && !IsVisible(selection, hit))
  {
    return false;
  }
  if (selection.Request.GetOpacity(hit) >= 1.0)
  {
    part.End = std::min(part.End, t + GetReachOfPlace(t, part.Base));
  }
  return true;
}

/// Appends all hits with a surface in a cell; none if the cell is not finite. What TrilinearSearch
/// found there may be given.
void KeepHitsInCell(const MeshSelection& selection, const RayFrame& frame, std::int64_t cell,
  int surface, CellHits& inCell, RayPart& part, std::vector<Hit>& hits,
  const TrilinearSolutions* solutions = nullptr);

}

#endif
