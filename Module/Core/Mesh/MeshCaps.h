// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCaps_h
#define MeshCaps_h

#include "Mesh/CellHits.h"
#include "Mesh/MeshSelection.h"
#include "Rays/Hit.h"
#include "Rays/RayPacket.h"
#include "Rays/Visibility.h"

#include <vector>

// A cap closes the inside of a surface where a half-space cuts it open. A ray meets one where it is
// cut: at its begin, its end, or both. That place is in the cell between whose crossings of faces
// it is. Which side of the surface it is on follows from the crossing behind it (before the end),
// where all cells of the face agree, and from each hit up to there. So caps and hits take turns,
// and there is no crack between cap and surface.

namespace vtkIsosurfaceRayTracing
{

/// The half-spaces to cut rays to. The planes of those with caps are moved inwards, by what
/// rounding may move the points of the mesh by: a plane in faces passes the cells that it leaves.
std::vector<HalfSpace> MovePlanesIntoCells(
  const std::vector<HalfSpace>& halves, const CellTree& tree, ScalarType pointType);

/// A cap that a ray of a packet hits.
struct Cap
{
  int Ray;
  Hit TheHit;
};

/// The caps that are visible at one end of some rays of a packet, which is cut to the half-spaces;
/// in the order of the rays.
std::vector<Cap> FindCaps(const MeshSelection& selection, const RayPacket& packet,
  const RaySet& rays, RayEnd end, CellHits& inCell);

}

#endif
