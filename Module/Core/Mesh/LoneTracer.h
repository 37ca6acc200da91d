// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef LoneTracer_h
#define LoneTracer_h

#include "Mesh/BeamFrame.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/NodesOnRay.h"
#include "Mesh/PairSolver.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces rays of a packet that make no beam, each in a frame of its own: in rounds, in each of
/// which every ray comes to a leaf of the tree with pieces that it may hit. The pairs of a round
/// are solved together.
class LoneTracer
{
public:
  /// Adds the hits of some rays; of secondary rays, with a departure for each ray of the packet,
  /// any that stops them. Returns those that were traced: all that have a frame.
  RaySet Trace(const MeshSelection& selection, const RayPacket& packet, const RaySet& rays,
    const Departure* departures, HitsOfRays& hits);

private:
  /// How a ray goes through the tree.
  struct Way
  {
    /// The depth that it ends at.
    float End;
    NodesOnRay Nodes;
  };

  bool BeginWay(const MeshSelection& selection, int ray);
  float FindEnd(int ray) const;
  /// Whether a secondary ray starts on a surface in a cell.
  bool StartsAt(int ray, std::uint32_t cell, int surface) const
  {
    return this->Departures && this->Departures[ray].Cell == cell &&
      this->Departures[ray].Surface == surface;
  }
  bool Advance(const MeshSelection& selection, int ray, HitsOfRays& hits);
  void AddPieces(const MeshSelection& selection, int ray, std::size_t leaf, HitsOfRays& hits);
  void Solve(const MeshSelection& selection, HitsOfRays& hits);

  const RayPacket* Packet = nullptr;
  const Departure* Departures = nullptr;
  /// Of each ray, as a beam of its own.
  BeamNumbers Frames[RayPacket::Capacity];
  /// Some 2 kB for each ray.
  std::vector<Way> Ways;
  PairSolver Solver;
  /// The ray of each pair.
  std::vector<int> Pairs;
};

}

#endif
