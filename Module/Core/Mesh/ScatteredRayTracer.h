// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ScatteredRayTracer_h
#define ScatteredRayTracer_h

#include "Kernels/ScatteredRays.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/PairSolver.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces rays of a packet that have little in common, each by itself: through the trees over all
/// pieces of the surfaces, or without these through that of the cells. In rounds, every ray comes
/// to the next pieces that it may hit. The pairs of a round are solved together.
class ScatteredRayTracer
{
public:
  /// Adds the hits of some rays; of secondary rays, with a departure for each ray of the packet,
  /// any that stops them. Given whether all surfaces have trees. Returns those that were traced.
  RaySet Trace(const MeshSelection& selection, const RayPacket& packet, const RaySet& rays,
    const Departure* departures, bool haveTrees, HitsOfRays& hits);

private:
  struct TreeOfSurface
  {
    PieceTreeLevels Levels;
    int Surface;
  };

  /// A ray on its way through a tree, after those before it.
  struct RayOnWay
  {
    int Ray;
    std::size_t Tree;
    WayThroughTree Way;
  };

  void FindTrees(const MeshSelection& selection);
  void Begin(const MeshSelection& selection, const RaySet& rays);
  bool Advance(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits);
  bool AdvanceInTrees(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits);
  bool AdvanceInCells(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits);
  bool FindLeaf(const MeshSelection& selection, RayOnWay& ray, std::size_t& leaf) const;
  bool AddPiecesOfLeaf(const MeshSelection& selection, int ray, std::size_t leaf, HitsOfRays& hits);
  std::uint32_t GetStartCell(int ray, int surface) const;
  void Add(
    const MeshSelection& selection, const PairSolver::PassedCell& cell, int ray, HitsOfRays& hits);
  void Solve(const MeshSelection& selection, HitsOfRays& hits);

  const Departure* Departures = nullptr;
  bool HaveTrees = false;
  /// Those of all surfaces, or none.
  std::vector<TreeOfSurface> Trees;
  ScatteredRays Rays;
  /// Those that are not at their end.
  std::vector<RayOnWay> Going;
  PairSolver Solver;
  /// The ray of each pair.
  std::vector<int> Pairs;
};

}

#endif
