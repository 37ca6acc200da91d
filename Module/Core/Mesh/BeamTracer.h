// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamTracer_h
#define BeamTracer_h

#include "Kernels/BeamPieces.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshBeam.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/PairSolver.h"
#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// Traces packets of rays through a mesh. Single precision finds the rays that may hit the pieces
/// of a beam; these pairs are solved exactly as for a single ray. It also finds rays that surely
/// hit a piece: they end behind it at once, and what is farther is not solved. A ray that then does
/// not hit before is given up.
class BeamTracer
{
public:
  /// Adds the hits of the rays that are in the beam, unless they are far apart, and are not given
  /// up; of secondary rays, with a departure for each ray of the packet, any that stops them.
  /// Returns which these are: those of others are not all there.
  RaySet Trace(const MeshSelection& selection, const RayPacket& packet, const Departure* departures,
    MeshBeam& beam, HitsOfRays& hits);

private:
  void Enter(const MeshSelection& selection, const BeamFrame& frame);
  void PlaceRays();
  bool AreFarApart(const MeshSelection& selection, const BeamFrame& frame);
  bool FindMore(const MeshSelection& selection, MeshBeam& beam, HitsOfRays& hits);
  void RemovePairsBehindEnds();
  void Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void AddCell(const MeshSelection& selection, const MeshBeam& beam, int& pair);

  const RayPacket* Packet = nullptr;
  BeamRays Rays;
  /// What the rays were placed for.
  int PlacedColumns = 0;
  int PlacedCount = 0;
  BeamPairs Pairs;
  /// Of the pairs that are solved.
  int RayOfPair[BeamPairs::Capacity];
  PairSolver Solver;
};

}

#endif
