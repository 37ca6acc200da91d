// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PairSolver_h
#define PairSolver_h

#include "Kernels/BeamPieces.h"
#include "Mesh/CellHits.h"
#include "Mesh/CornerOrder.h"
#include "Mesh/HitsOfRays.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/RayHitsInCells.h"
#include "Mesh/TrilinearHulls.h"
#include "Rays/Hit.h"
#include "Rays/RayPacket.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Solves pairs of rays and cells, exactly as for a single ray. Cells are read in stages, each
/// fetched ahead for all cells that wait.
class PairSolver
{
public:
  /// Begins with the rays of a packet, of which the frames are to be set. Secondary rays have a
  /// departure each, or null. Trilinear cells may be given that are not within the hulls of their
  /// pieces, if these are to be bounded.
  void Begin(const MeshSelection& selection, const RayPacket& packet, const Departure* departures,
    bool boundsHulls);
  FramedRays& GetFramed() { return this->Framed; }

  /// Where each ray ends by the hits that were found.
  const double* GetEnds() const { return this->Ends; }

  /// A cell that a surface passes.
  struct PassedCell
  {
    std::uint32_t Number;
    bool IsTetrahedron;
    int Surface;
  };

  /// Adds a cell with the rays of some consecutive pairs, of which the numbers are given.
  void Add(const MeshSelection& selection, const PassedCell& cell, int firstPair, int endOfPairs);
  /// Whether there is no room for more.
  bool IsFull() const { return this->Tetrahedra.IsFull() || this->Trilinear.IsFull(); }

  /// Adds the hits in all cells, and removes these; given the ray of each pair.
  void Solve(const MeshSelection& selection, const int* rays, HitsOfRays& hits);

private:
  /// Cells of pairs.
  struct PairedCells
  {
    static constexpr int Capacity = 256;

    int Count = 0;
    std::uint32_t Cells[Capacity];
    int Surfaces[Capacity];
    /// The pairs that are left.
    int FirstPair[Capacity];
    int EndOfPairs[Capacity];
    /// The cells of the pairs that are solved, and the first one that has others left.
    int FirstTaken;
    int Taken;
    int Next = 0;

    void Clear() { this->Count = this->Next = 0; }
    bool IsFull() const { return this->Count == Capacity; }
  };

  RayPart GetPart(int ray) const
  {
    return { this->Packet->Begin[ray], this->Ends[ray], this->Packet->Base[ray],
      this->Departures ? &this->Departures[ray] : nullptr, this->EndsOfStarts[ray] };
  }
  template <typename CellPairs>
  static void Take(PairedCells& cells, const int* rays, CellPairs& pairs);
  template <int Corners>
  static void FindDifferences(
    const MeshSelection& selection, const PairedCells& cells, double (*corners)[Corners][4]);
  void SolveTetrahedra(const MeshSelection& selection, const int* rays, HitsOfRays& hits);
  void KeepHits(const MeshSelection& selection, HitsOfRays& hits);
  void MakeHit(int pair, double base, Hit& hit) const;
  void SolveTrilinear(const MeshSelection& selection, const int* rays, HitsOfRays& hits);
  void KeepTrilinearHits(const MeshSelection& selection, HitsOfRays& hits);
  bool IsWithinHull(const MeshSelection& selection, int number, int ray);
  void SolveByItself(const MeshSelection& selection, const PairedCells& cells, int number, int ray,
    HitsOfRays& hits, const TrilinearSolutions* solutions = nullptr);

  const RayPacket* Packet = nullptr;
  const Departure* Departures = nullptr;
  bool BoundsHulls = false;
  FramedRays Framed;
  double Ends[RayPacket::Capacity];
  /// Of secondary rays.
  double EndsOfStarts[RayPacket::Capacity] = {};
  TetrahedronPairs InTetrahedra;
  PairedCells Tetrahedra;
  TrilinearPairs InTrilinear;
  PairedCells Trilinear;
  TrilinearHulls Hulls;
  /// Of the corners of tetrahedra.
  CornerOrder Orders[PairedCells::Capacity];
  std::int64_t Ids[PairedCells::Capacity][4];
  CellHits InCell;
  std::vector<Hit> HitsInCell;
};

}

#endif
