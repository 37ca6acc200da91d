// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamTracer_h
#define BeamTracer_h

#include "Kernels/BeamPieces.h"
#include "Mesh/CellHits.h"
#include "Mesh/CornerOrder.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshBeam.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/RayHitsInCells.h"
#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traces packets of rays through a mesh. Single precision finds the rays that may hit the pieces
/// of a beam; these pairs are solved exactly as for a single ray. It also finds rays that surely hit
/// a piece: they end behind it at once, and what is farther is not solved. A ray that then does not
/// hit before is given up.
class BeamTracer
{
public:
  /// Finds the hits of the rays that are in the beam, and are not given up. Returns which these are.
  RaySet Trace(
    const MeshSelection& selection, const RayPacket& packet, MeshBeam& beam, HitsOfRays& hits);

private:
  void Enter(const MeshSelection& selection, const BeamFrame& frame);
  void PlaceRays();
  RayPart GetPart(int ray) const
  {
    return { this->Packet->Begin[ray], this->Ends[ray], this->Packet->Base[ray] };
  }
  bool IsBehindSure(float depth) const;
  void RemovePairsBehindEnds();
  void Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  /// The cells of pairs, and the pieces they were found by.
  struct PairedCells
  {
    int Count = 0;
    std::uint32_t Cells[TetrahedronPairs::Capacity];
    int Pieces[TetrahedronPairs::Capacity];
  };

  template <typename CellPairs>
  void Add(const MeshSelection& selection, const MeshBeam& beam, int piece, const int* places,
    int count, CellPairs& pairs, PairedCells& cells, HitsOfRays& hits);
  template <int Corners>
  static void FindDifferences(const MeshSelection& selection, const MeshBeam& beam,
    const PairedCells& cells, double (*corners)[Corners][4]);
  void SolveTetrahedra(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void MakeHit(const MeshBeam& beam, int pair, Hit& hit) const;
  void SolveTrilinear(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void SolveByItself(
    const MeshSelection& selection, const MeshBeam& beam, int piece, int ray, HitsOfRays& hits);

  const RayPacket* Packet = nullptr;
  BeamRays Rays;
  /// What the rays were placed for.
  int PlacedColumns = 0;
  int PlacedCount = 0;
  FramedRays Framed;
  /// Where each ray ends by the hits that were found.
  double Ends[RayPacket::Capacity];
  BeamPairs Pairs;
  TetrahedronPairs InTetrahedra;
  PairedCells Tetrahedra;
  TrilinearPairs InTrilinear;
  PairedCells Trilinear;
  CornerOrder Orders[TetrahedronPairs::Capacity];
  CellHits InCell;
  std::vector<Hit> HitsInCell;
};

}

#endif
