// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxFirstHits_h
#define BoxFirstHits_h

#include "Image/Tracers/BoxCells.h"
#include "Image/Tracers/CornerRows.h"
#include "Image/Traversal/FirstHitTracer.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The cells of an image for a packet of rays, of which the packet tracer finds the first hits with
/// the faces between boxes. To solve them takes no longer than to classify them.
template <typename T, typename Layout>
class BoxFirstHits final : public FirstHitTracer::FirstHitCells
{
public:
  BoxFirstHits(
    const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks, Layout& bricks)
    : Selection(selection)
    , Rays(rays)
    , Cells(selection, masks, bricks)
    , Corners(this->Cells.GetReader())
  {
  }
  BoxFirstHits(const BoxFirstHits&) = delete;
  BoxFirstHits& operator=(const BoxFirstHits&) = delete;

  void Prefetch(const Index3& block) override { this->Cells.Prefetch(block); }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Cells.GetMask(block, own);
  }

  CellQueueTracer::CornerSource& GetCorners() override { return this->Corners; }

  /// All of them are candidates.
  void ClassifyCells(const PassedCells& cells, int axis, bool /*areCopied*/, Passages& passages,
    Candidates& candidates, RaySet /*hits*/[2]) override
  {
    for (int i = 0; i < cells.Count; ++i)
    {
      const int index = candidates.Count++;
      const Index3 cell = Rows::GetPassedCell(cells.Codes[i], axis, passages);
      candidates.Ray[index] = passages.Segments[cells.Codes[i] & 0xFFFFU].Ray;
      candidates.Cell[0][index] = cell[0];
      candidates.Cell[1][index] = cell[1];
      candidates.Cell[2][index] = cell[2];
      candidates.First[index] = cells.First[i];
    }
  }

  void Solve(const RayPacket& packet, const Candidates& candidates, const LatticePlanes* planes,
    const ScaledIsovalue& isovalue, Solutions& solutions) override
  {
    this->Selection.PacketKernels->SolveBoxes(packet, candidates, planes, isovalue, solutions);
  }

  bool SolvesAtOnce() const override { return true; }

  /// Only hits are requested.
  bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Crossing& begin) override
  {
    std::vector<FaceHit> faces;
    this->Cells.FindFaces(this->Selection.TakeRay(this->Rays, ray), cell, faces);
    std::vector<Hit> hits;
    HitCollector collector = this->Selection.NewCollector(hits);
    const auto first = std::find_if(faces.begin(), faces.end(),
      [&collector](const FaceHit& face) { return collector.Add(face.TheHit); });
    if (first == faces.end())
    {
      return false;
    }
    hit = first->TheHit;
    begin = first->At;
    return true;
  }

private:
  using Rows = CornerRows<Layout>;

  const ImageSelection& Selection;
  const RayPacket& Rays;
  BoxCells<T, Layout> Cells;
  Rows Corners;
};

}

#endif
