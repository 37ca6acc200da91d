// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FirstHitTracer_h
#define FirstHitTracer_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Traversal/CellQueueTracer.h"
#include "Rays/CellCrossings.h"
#include "Rays/Hit.h"

#include <array>

namespace vtkIsosurfaceRayTracing
{

/// The first hits of the rays of a packet.
struct PacketHits
{
  /// The rays that hit.
  RaySet Found;
  std::array<Hit, RayPacket::Capacity> Hits;
  /// Where each ray enters the cell of its hit.
  std::array<Crossing, RayPacket::Capacity> Begin;
};

/// Finds the first hits of a packet with one opaque surface.
///
/// Single precision classifies most of the cells that the rays pass as sure misses or sure hits;
/// the remaining candidates are solved together, exactly as for a single ray.
class FirstHitTracer final : public CellQueueTracer
{
public:
  /// Cells in which the first hits with one surface are found.
  class FirstHitCells : public Cells
  {
  public:
    virtual CornerSource& GetCorners() = 0;
    /// Finds the candidates among cells, whose corners are kept in rows or were copied.
    virtual void ClassifyCells(const PassedCells& cells, int axis, bool areCopied,
      Passages& passages, Candidates& candidates, RaySet hits[2]) = 0;
    /// Finds the first hit in each candidate; a ray of the packet that has one needs no cells of
    /// later slices.
    virtual void Solve(const RayPacket& packet, const Candidates& candidates,
      const LatticePlanes* planes, const ScaledIsovalue& isovalue, Solutions& solutions) = 0;
    /// Whether cells are not classified: then candidates are solved before the next slice, so that
    /// a ray that hits needs no more.
    virtual bool SolvesAtOnce() const { return false; }
    /// Solves a cell that the kernels do not: the first visible hit of a ray of the packet in it,
    /// and where the ray enters the cell. Returns false if there is none.
    virtual bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Crossing& begin) = 0;
  };

  /// The kernels must outlive the tracer.
  FirstHitTracer(const Kernels& kernels, const TracedBlocks& blocks)
    : CellQueueTracer(kernels, blocks)
  {
  }

  /// Finds the first hits of all rays of a packet that exist, with one surface. The candidates of
  /// many rays are solved at once.
  const PacketHits& FindFirstHits(
    const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue);

private:
  void AddCroppedCells(const Frustum& frustum, const Index3& block, int first) override;
  void EndQueuedSlice(const Frustum& frustum) override;
  int KeepNeeded(const Frustum& frustum, int* passages, int count) const override;
  bool IsBehindHit(const Frustum& frustum, int passage) const;
  void TakeQueue(const Frustum& frustum) override;
  void SolveCandidates();
  void KeepSolutions();
  Index3 GetCell(int candidate) const;
  Hit GetHit(int candidate) const;
  void FindFirstHit(int ray, const Index3& cell);
  void Keep(int ray, const Hit& hit, const Crossing& begin);

  FirstHitCells* Source = nullptr;
  ScaledIsovalue Isovalue = {};
  PacketHits Hits;
  /// The rays that surely hit something, at any t: where values fall, and where they rise along the
  /// axis of the frustum.
  RaySet SurelyHit[2] = {};
  bool SolvesAtOnce = false;
  /// Whether the corners of the candidates were copied.
  bool AreCopied = false;
  Candidates Waiting;
  Solutions Solved;
};

}

#endif
