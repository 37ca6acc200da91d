// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearFirstHits_h
#define TrilinearFirstHits_h

#include "Image/Tracers/CornerRows.h"
#include "Image/Tracers/TrilinearCells.h"
#include "Image/Traversal/FirstHitTracer.h"

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image for a packet of rays, of which the packet tracer finds the first hits with
/// one surface of the trilinear interpolant.
template <typename T, typename Layout>
class TrilinearFirstHits final : public FirstHitTracer::FirstHitCells
{
public:
  TrilinearFirstHits(
    const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks, Layout& bricks)
    : Selection(selection)
    , Rays(rays)
    , Cells(selection, masks, bricks)
    , Corners(this->Cells.GetReader())
  {
  }

  void Prefetch(const Index3& block) override { this->Cells.Prefetch(block); }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Cells.GetMask(block, own);
  }

  CellQueueTracer::CornerSource& GetCorners() override { return this->Corners; }

  void ClassifyCells(const PassedCells& cells, int axis, bool areCopied, Passages& passages,
    Candidates& candidates, RaySet hits[2]) override
  {
    this->Selection.PacketKernels->ClassifyCells[this->Corners.GetType(areCopied)](cells, axis,
      this->Corners.GetStrides(areCopied), this->Selection.Isovalues[0], passages, candidates,
      hits);
  }

  void Solve(const RayPacket& packet, const Candidates& candidates, const LatticePlanes* planes,
    const ScaledIsovalue& isovalue, Solutions& solutions) override
  {
    this->Selection.PacketKernels->Solve(packet, candidates, planes, isovalue, solutions);
  }

  bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Crossing& begin) override
  {
    const Ray own = this->Selection.TakeRay(this->Rays, ray);
    CellSegment segment;
    if (!SegmentInCell(own, cell, segment))
    {
      return false;
    }
    this->Cells.FindRoots(cell, segment, false, this->Roots);
    begin = { segment.Begin, segment.BeginAxis };
    const CellLattice& lattice = this->Selection.Lattice;
    for (const Root& root : this->Roots.Get())
    {
      hit = MakeHit(own, lattice, cell, segment, root.Fraction, root.Surface, root.Entering);
      if (this->Selection.Request.Visible.Regions.Contain(lattice.GetPoint(cell, hit.Parametric)))
      {
        return true;
      }
    }
    return false;
  }

private:
  const ImageSelection& Selection;
  const RayPacket& Rays;
  TrilinearCells<T, Layout> Cells;
  CornerRows<Layout> Corners;
  /// Kept for its memory.
  RootSet Roots;
};

}

#endif
