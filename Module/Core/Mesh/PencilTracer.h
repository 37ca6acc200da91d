// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PencilTracer_h
#define PencilTracer_h

#include "Mesh/BeamFrame.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/NodesInPencil.h"
#include "Mesh/PairSolver.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces rays of a packet that make no beam, each in a frame of its own. Those that follow each
/// other and go about the same way come through the tree as a pencil; others are pencils of one
/// ray. In rounds, every pencil comes to a leaf with pieces that some of its rays may hit. The
/// pairs of a round are solved together.
class PencilTracer
{
public:
  /// Adds the hits of some rays; of secondary rays, with a departure for each ray of the packet,
  /// any that stops them. Returns those that were traced: all that have a frame.
  RaySet Trace(const MeshSelection& selection, const RayPacket& packet, const RaySet& rays,
    const Departure* departures, HitsOfRays& hits);

private:
  /// Rays in consecutive places, and their way through the tree.
  struct Pencil
  {
    int First;
    int Count;
    NodesInPencil Nodes;
  };

  /// Pieces of a surface in a leaf.
  struct SetOfLeaf
  {
    const PackedPieces* Pieces;
    std::size_t Leaf;
    int Surface;
  };

  RaySet PlaceRays(const MeshSelection& selection, const RaySet& rays);
  void MakePencils(const MeshSelection& selection, int first, int count);
  void AddPencil(
    const MeshSelection& selection, int first, int count, const PencilThroughBoxes& bounds);
  float FindEnd(int place) const;
  float FindEnd(const Pencil& pencil) const;
  /// Whether a secondary ray starts on a surface in a cell.
  bool StartsAt(int ray, std::uint32_t cell, int surface) const
  {
    return this->Departures && this->Departures[ray].Cell == cell &&
      this->Departures[ray].Surface == surface;
  }
  bool Advance(const MeshSelection& selection, Pencil& pencil, HitsOfRays& hits);
  void AddPieces(
    const MeshSelection& selection, const RaysInPencil& rays, std::size_t leaf, HitsOfRays& hits);
  void AddPieces(
    const MeshSelection& selection, const SetOfLeaf& set, const MetPieces& met, HitsOfRays& hits);
  void Solve(const MeshSelection& selection, HitsOfRays& hits);

  const RayPacket* Packet = nullptr;
  const Departure* Departures = nullptr;
  /// Those that go one way along an axis follow each other.
  LoneRays Rays;
  /// Those in use are the first. Some 2 kB for each.
  std::vector<Pencil> Pencils;
  std::size_t NumberOfPencils = 0;
  /// The numbers of those that are not at their end.
  std::vector<std::size_t> Going;
  PairSolver Solver;
  /// The ray and the place of each pair.
  std::vector<int> Pairs;
  std::vector<int> Places;
};

}

#endif
