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

/// Traces rays of a packet that have little in common, each by itself through the trees over all
/// pieces of the surfaces. In rounds, every ray comes to the next set with pieces that it may hit.
/// The pairs of a round are solved together.
class ScatteredRayTracer
{
public:
  /// Adds the hits of some rays; of secondary rays, with a departure for each ray of the packet,
  /// any that stops them. All surfaces must have trees. Returns those that were traced.
  RaySet Trace(const MeshSelection& selection, const RayPacket& packet, const RaySet& rays,
    const Departure* departures, HitsOfRays& hits);

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
    WayThroughPieces Way;
  };

  void FindTrees(const MeshSelection& selection);
  void Begin(const RaySet& rays);
  bool Advance(const MeshSelection& selection, RayOnWay& ray, HitsOfRays& hits);
  std::uint32_t GetStartCell(int ray, int surface) const;
  void AddPairs(const MeshSelection& selection, const TreeOfSurface& tree, int ray, int set,
    unsigned int pieces, HitsOfRays& hits);
  void Solve(const MeshSelection& selection, HitsOfRays& hits);

  const Departure* Departures = nullptr;
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
