// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RayFollower_h
#define RayFollower_h

#include "Image/Traversal/PacketTracer.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Follows each ray of a packet through the cells that may have hits, slice by slice.
class RayFollower final : public PacketTracer
{
public:
  /// Cells through which each ray is followed.
  class FollowedCells : public Cells
  {
  public:
    /// Whether a ray must have been followed through all cells that it passes before others.
    virtual bool NeedsOrder() const { return true; }
    /// Traces a ray through cells that it may pass, in no order. Returns whether the ray ends
    /// there.
    virtual bool Follow(int ray, const std::vector<Index3>& cells) = 0;
  };

  /// The kernels must outlive the follower.
  RayFollower(const Kernels& kernels, const TracedBlocks& blocks)
    : PacketTracer(kernels, blocks)
  {
  }

  /// Follows all rays of a packet that exist.
  void Follow(const RayPacket& packet, FollowedCells& cells);

private:
  /// A cell that a ray may pass, and the number of the next one of the ray.
  struct LinkedCell
  {
    Index3 Cell;
    int Next;
  };

  void BeginFrustum(const Frustum& frustum) override;
  void AddBlock(const Frustum& frustum, const Index3& block) override;
  void EndSlice(const Frustum& frustum) override;
  void TakeCells(int axis);

  FollowedCells* Source = nullptr;
  /// Those of the slice, and the number of the first one of each ray; negative if it has none.
  std::vector<LinkedCell> CellsOfSlice;
  int First[RayPacket::Capacity];
  /// Kept for its memory.
  std::vector<Index3> CellsOfRay;
};

}

#endif
