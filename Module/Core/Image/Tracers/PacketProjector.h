// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketProjector_h
#define PacketProjector_h

#include "Image/Macrocells/CellMasks.h"
#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/Projector.h"
#include "Image/Traversal/RayFollower.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Finds the extreme values of the rays of a packet. Some rays are projected by themselves, the
/// others start from what their neighbours found and are followed together: in each block only
/// through cells that exceed the smallest value so far of all rays.
template <typename T, typename Layout, Extremum Kind>
class PacketProjector final : public RayFollower::FollowedCells
{
public:
  using RayProjector = Projector<T, Layout, Kind>;

  /// All must outlive the projector.
  PacketProjector(const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks,
    RayProjector& projector)
    : Selection(selection)
    , Rays(rays)
    , Masks(masks)
    , TheProjector(projector)
  {
  }

  /// Appends the hits, at most one for each ray.
  void Project(RayHits& hits)
  {
    RayPacket others = this->Rays;
    for (int i = 0; i < this->Rays.Count; ++i)
    {
      if (!Has(this->Rays.Exists, i))
      {
        continue;
      }
      const Ray ray = this->Selection.TakeRay(this->Rays, i);
      if (i % Spacing == 0)
      {
        this->GetProjection(i) = this->TheProjector.Project(ray);
        Remove(i, others.Exists);
      }
      else
      {
        this->TheProjector.Guess(ray, this->GetProjection(i));
      }
    }
    this->Going = others.Exists;
    RayFollower(*this->Selection.PacketKernels, this->Selection.GetTracedBlocks())
      .Follow(others, *this);
    for (int i = 0; i < this->Rays.Count; ++i)
    {
      if (this->GetProjection(i).Exists())
      {
        hits.Hits.push_back(this->GetProjection(i).Found);
      }
      hits.EndRay();
    }
  }

  /// Most blocks of a frustum are skipped.
  void Prefetch(const Index3& /*block*/) override {}

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    const double least = this->GetLeast();
    if (this->TheProjector.MayExceed(0, block, least))
    {
      this->Masks.FindBeyond(block, RayProjector::Directed(least), RayProjector::IsLargest, own);
    }
    else
    {
      own = {};
    }
    return own;
  }

  /// A ray comes to its cells in the order of their coordinates: at each plane one of these changes
  /// by one.
  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = this->Selection.TakeRay(this->Rays, ray);
    this->InOrder.clear();
    for (const Index3& cell : cells)
    {
      const int place = own.Step[0] * cell[0] + own.Step[1] * cell[1] + own.Step[2] * cell[2];
      this->InOrder.emplace_back(place, cell);
    }
    std::sort(this->InOrder.begin(), this->InOrder.end());
    for (const auto& [place, cell] : this->InOrder)
    {
      if (this->TheProjector.Visit(own, cell, this->GetProjection(ray)))
      {
        this->IsLeastKnown = false;
      }
    }
    return false;
  }

private:
  /// One ray of so many is projected by itself.
  static constexpr int Spacing = 8;

  Projection& GetProjection(int ray) { return this->Projections[static_cast<std::size_t>(ray)]; }

  /// The smallest value that any ray has found so far.
  double GetLeast()
  {
    if (!std::exchange(this->IsLeastKnown, true))
    {
      this->Least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < this->Rays.Count; ++i)
      {
        if (Has(this->Going, i))
        {
          this->Least = std::min(this->Least, this->GetProjection(i).Best);
        }
      }
    }
    return this->Least;
  }

  const ImageSelection& Selection;
  const RayPacket& Rays;
  CellMasks<T>& Masks;
  RayProjector& TheProjector;
  std::array<Projection, RayPacket::Capacity> Projections;
  /// The rays that are followed.
  RaySet Going = {};
  bool IsLeastKnown = false;
  double Least = 0.0;
  /// Kept for its memory.
  std::vector<std::pair<int, Index3>> InOrder;
};

}

#endif
