// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearFirstHits_h
#define TrilinearFirstHits_h

#include "Image/Tracers/TrilinearCells.h"
#include "Image/Traversal/FirstHitTracer.h"

#include <vector>

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
    , Reader(this->Cells.GetReader())
  {
  }

  void Prefetch(const Index3& block) override { this->Cells.Prefetch(block); }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Cells.GetMask(block, own);
  }

  const void* FindCorner(const Index3& block) override
  {
    return this->Reader.FindBlock(BlockMask::GetFirstCell(block), BlockMask::Edge);
  }

  std::array<std::ptrdiff_t, 3> GetCornerSteps() const override
  {
    const std::ptrdiff_t* strides = this->Reader.GetStrides();
    constexpr std::ptrdiff_t size = sizeof(typename Layout::Kept);
    return { strides[0] * size, strides[1] * size, strides[2] * size };
  }

  void CopyCorners(PassedCells& cells, int axis, const Passages& passages) override
  {
    // Those behind the last, up to a full vector, repeat the first.
    const int count = cells.Count + PassedCells::Spare;
    this->Copies.resize(8 * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i)
    {
      const unsigned int code = cells.Codes[i];
      const int* first = passages.First[passages.Segments[code & 0xFFFFU].Block];
      Index3 cell = { first[0], first[1], first[2] };
      cell[static_cast<std::size_t>(axis)] += static_cast<int>(code >> 16 & 7U);
      cell[static_cast<std::size_t>(BlockMask::U[axis])] += static_cast<int>(code >> 24 & 7U);
      cell[static_cast<std::size_t>(BlockMask::V[axis])] += static_cast<int>(code >> 27);
      auto* corners = &this->Copies[8 * static_cast<std::size_t>(i)];
      this->Reader.Load(cell, corners);
      cells.First[i] = corners;
    }
  }

  void ClassifyCells(const PassedCells& cells, int axis, bool areCopied, Passages& passages,
    Candidates& candidates, RaySet hits[2]) override
  {
    this->Selection.PacketKernels->ClassifyCells[GetType(areCopied)](cells, axis,
      this->GetStrides(areCopied), this->Selection.Isovalues[0], passages, candidates, hits);
  }

  void LoadCorners(bool areCopied, Candidates& candidates) override
  {
    this->Selection.PacketKernels->LoadCorners[GetType(areCopied)](
      this->GetStrides(areCopied), candidates);
  }

  void FindStops(
    int ray, const Index3& cell, const Departure& departure, StoppedRays& stopped) override
  {
    FindStopsInCell(
      ray, this->Selection.TakeRay(this->Rays, ray), cell, departure, this->Cells, this->Roots, stopped);
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
  static std::size_t GetType(bool areCopied)
  {
    return static_cast<std::size_t>(
      areCopied ? ScalarTypeOf<typename Layout::Value>() : ScalarTypeOf<typename Layout::Kept>());
  }

  const std::ptrdiff_t* GetStrides(bool areCopied) const
  {
    static constexpr std::ptrdiff_t ofCopies[3] = { 1, 2, 4 };
    return areCopied ? ofCopies : this->Reader.GetStrides();
  }

  const ImageSelection& Selection;
  const RayPacket& Rays;
  TrilinearCells<T, Layout> Cells;
  typename Layout::Reader& Reader;
  /// The eight corners of each cell that is classified where there are no rows.
  std::vector<typename Layout::Value> Copies;
  /// Kept for its memory.
  RootSet Roots;
};

}

#endif
