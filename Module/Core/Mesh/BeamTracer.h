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
/// of a beam; these pairs are solved exactly as for a single ray. It also finds rays that surely
/// hit a piece: they end behind it at once, and what is farther is not solved. A ray that then does
/// not hit before is given up.
class BeamTracer
{
public:
  /// Finds the hits of the rays that are in the beam, and are not given up. Returns which these
  /// are.
  RaySet Trace(
    const MeshSelection& selection, const RayPacket& packet, MeshBeam& beam, HitsOfRays& hits);

private:
  void Enter(const MeshSelection& selection, const BeamFrame& frame);
  void PlaceRays();
  RayPart GetPart(int ray) const
  {
    return { this->Packet->Begin[ray], this->Ends[ray], this->Packet->Base[ray] };
  }
  bool FindMore(const MeshSelection& selection, MeshBeam& beam, HitsOfRays& hits);
  void RemovePairsBehindEnds();
  void Solve(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  /// Cells of pairs.
  struct PairedCells
  {
    static constexpr int Capacity = 256;

    int Count;
    std::uint32_t Cells[Capacity];
    /// Those that they were found by.
    int Pieces[Capacity];
    /// The pairs that are left.
    int FirstPair[Capacity];
    int EndOfPairs[Capacity];
    /// The cells of the pairs that are solved, and the first one that has others left.
    int FirstTaken;
    int Taken;
    int Next;

    void Clear() { this->Count = this->Next = 0; }
    bool IsFull() const { return this->Count == Capacity; }
    void Add(std::uint32_t cell, int piece, int first, int end)
    {
      this->Cells[this->Count] = cell;
      this->Pieces[this->Count] = piece;
      this->FirstPair[this->Count] = first;
      this->EndOfPairs[this->Count++] = end;
    }
  };

  int FindCells(const MeshSelection& selection, const MeshBeam& beam, int pair);
  template <typename CellPairs>
  void Take(PairedCells& cells, CellPairs& pairs) const;
  template <int Corners>
  static void FindDifferences(const MeshSelection& selection, const MeshBeam& beam,
    const PairedCells& cells, double (*corners)[Corners][4]);
  void SolveTetrahedra(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void KeepHits(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void MakeHit(const MeshBeam& beam, int pair, Hit& hit) const;
  void SolveTrilinear(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
  void KeepTrilinearHits(const MeshSelection& selection, const MeshBeam& beam, HitsOfRays& hits);
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
  /// Of the corners of tetrahedra.
  CornerOrder Orders[PairedCells::Capacity];
  std::int64_t Ids[PairedCells::Capacity][4];
  CellHits InCell;
  std::vector<Hit> HitsInCell;
};

}

#endif
