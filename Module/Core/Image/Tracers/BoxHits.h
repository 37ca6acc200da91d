// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BoxHits_h
#define BoxHits_h

#include "Image/Tracers/BoxCells.h"
#include "Image/Tracers/PacketCollector.h"
#include "Image/Traversal/RayFollower.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The hits of the rays of a packet with the faces between boxes of all surfaces.
template <typename T, typename Layout>
class BoxHits final : public RayFollower::FollowedCells
{
public:
  /// All must outlive the hits.
  BoxHits(
    const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks, Layout& bricks)
    : Selection(selection)
    , Rays(rays)
    , Cells(selection, masks, bricks)
    , Collector(selection, rays.Count)
  {
  }

  void Prefetch(const Index3& block) override { this->Cells.Prefetch(block); }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Cells.GetMask(block, own);
  }

  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = this->Selection.TakeRay(this->Rays, ray);
    this->Faces.clear();
    for (const Index3& cell : cells)
    {
      this->Cells.FindFaces(own, cell, this->Faces);
    }
    std::sort(this->Faces.begin(), this->Faces.end());
    return std::any_of(this->Faces.begin(), this->Faces.end(),
      [this, ray](const FaceHit& face) { return this->Collector.Add(ray, face.TheHit); });
  }

  /// Appends the hits of the rays that were followed.
  void AppendTo(RayHits& hits) const { this->Collector.AppendTo(hits); }

private:
  const ImageSelection& Selection;
  const RayPacket& Rays;
  BoxCells<T, Layout> Cells;
  PacketCollector Collector;
  /// Kept for its memory.
  std::vector<FaceHit> Faces;
};

}

#endif
