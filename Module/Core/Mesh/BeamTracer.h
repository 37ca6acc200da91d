// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamTracer_h
#define BeamTracer_h

#include "Kernels/BeamPieces.h"
#include "Mesh/CellHits.h"
#include "Mesh/MeshBeam.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/RayHitsInCells.h"
#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <array>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces packets of rays through a mesh. Single precision finds the rays that may hit the pieces
/// of a beam; these pairs are solved exactly as for a single ray.
class BeamTracer
{
public:
  /// Of each ray of a packet, in no order; those beyond the first opaque one may be missing.
  using HitsOfRays = std::array<std::vector<Hit>, RayPacket::Capacity>;

  /// Finds the hits of the rays that are in the beam. Returns which these are.
  RaySet Trace(
    const MeshSelection& selection, const RayPacket& packet, MeshBeam& beam, HitsOfRays& hits);

private:
  void Enter(const MeshSelection& selection, const BeamFrame& frame);
  void PlaceRays();
  void FindEnds();
  void Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void SolveTetrahedra(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void SolveByItself(
    const MeshSelection& selection, const MeshBeam& beam, int piece, int ray, HitsOfRays& hits);

  const RayPacket* Packet = nullptr;
  BeamRays Rays;
  /// What the rays were placed for.
  int PlacedColumns = 0;
  int PlacedCount = 0;
  FramedRays Framed;
  RayPart Parts[RayPacket::Capacity];
  BeamPairs Pairs;
  TetrahedronPairs InTetrahedra;
  CellHits InCell;
};

}

#endif
