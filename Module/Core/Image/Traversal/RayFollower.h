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
    /// Traces a ray through cells that it may pass, in no order; all cells that it passes before
    /// them have been visited. Returns whether the ray ends there.
    virtual bool Follow(int ray, const std::vector<Index3>& cells) = 0;
  };

  /// Both must outlive the follower.
  RayFollower(const Kernels& kernels, const BlockTree& tree)
    // All passages of a slice must have room, since rays are followed in order.
    : PacketTracer(kernels, tree, Passages::RaysWithRoom)
  {
  }

  /// Follows all rays of a packet that exist.
  void Follow(const RayPacket& packet, FollowedCells& cells);

private:
  void EndSlice(const Frustum& frustum) override;
  void AddCells(int axis, int passage, std::vector<Index3>& cells) const;

  FollowedCells* Source = nullptr;
  /// Kept for its memory.
  std::vector<Index3> CellsOfRay;
};

}

#endif
