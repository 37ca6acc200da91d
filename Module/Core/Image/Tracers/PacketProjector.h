// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketProjector_h
#define PacketProjector_h

#include "Image/Macrocells/CellMasks.h"
#include "Image/Tracers/CornerRows.h"
#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/CellQueueTracer.h"
#include "Image/Traversal/Projector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// Finds the extreme values of the rays of a packet. Some rays are projected by themselves; the
/// others start from what their neighbours found, and are taken through the volume together. In
/// each block only the cells with a corner beyond the least extreme value so far count; of these,
/// single precision leaves the few in which a ray may come to a value beyond its own.
template <typename T, typename Layout, Extremum Kind>
class PacketProjector final
  : private CellQueueTracer
  , private PacketTracer::Cells
{
public:
  using RayProjector = Projector<T, Layout, Kind>;

  /// All must outlive the projector.
  PacketProjector(const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks,
    Layout& bricks, RayProjector& projector)
    : CellQueueTracer(*selection.PacketKernels, selection.GetTracedBlocks())
    , Selection(selection)
    , Rays(rays)
    , Masks(masks)
    , Reader(bricks)
    , CornersInRows(this->Reader)
    , TheProjector(projector)
  {
  }

  /// Appends the hits, at most one for each ray.
  void Project(RayHits& hits)
  {
    RayPacket others = this->Rays;
    this->Bounds.fill(std::numeric_limits<float>::infinity());
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
        this->SetBound(i);
      }
    }
    this->FindLeast();
    this->TraceQueued(others, *this, this->CornersInRows, Order::FrontToBack);
    for (int i = 0; i < this->Rays.Count; ++i)
    {
      if (this->GetProjection(i).Exists())
      {
        hits.Hits.push_back(this->GetProjection(i).Found);
      }
      hits.EndRay();
    }
  }

private:
  using Rows = CornerRows<Layout>;

  /// One ray of so many is projected by itself.
  static constexpr int Spacing = 16;

  // The cells.
  /// Most blocks of a frustum are skipped.
  void Prefetch(const Index3& /*block*/) override {}

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    if (this->TheProjector.GetMost(0, block) > this->Least)
    {
      this->Masks.FindBeyond(
        block, RayProjector::Directed(this->Least), RayProjector::IsLargest, own);
    }
    else
    {
      own = {};
    }
    return own;
  }

  // The tracer.
  void TakeQueue(const Frustum& frustum) override
  {
    const bool areCopied = !this->AllInRows;
    if (areCopied)
    {
      this->CornersInRows.Copy(this->Queue, frustum.Axis, this->Passed);
    }
    float bounds[PassedCells::Capacity];
    this->TheKernels.BoundCells[this->CornersInRows.GetType(areCopied)](this->Queue, frustum.Axis,
      this->CornersInRows.GetStrides(areCopied), !RayProjector::IsLargest, this->Passed, bounds);
    for (int i = 0; i < this->Queue.Count; ++i)
    {
      const unsigned int code = this->Queue.Codes[i];
      const int ray = this->Passed.Segments[code & 0xFFFFU].Ray;
      // What is NaN is not below.
      if (!(bounds[i] < this->Bounds[static_cast<std::size_t>(ray)]))
      {
        this->Visit(ray, Rows::GetPassedCell(code, frustum.Axis, this->Passed));
      }
    }
  }

  void Visit(int ray, const Index3& cell)
  {
    if (this->TheProjector.Visit(
          this->Selection.TakeRay(this->Rays, ray), cell, this->GetProjection(ray)))
    {
      this->SetBound(ray);
    }
  }

  int KeepNeeded(const Frustum& /*frustum*/, int* /*passages*/, int count) const override
  {
    return count;
  }

  // In a slice the cells of a ray come in no order: one with an equal value, which lies before,
  // must not be left out. Behind the slice all lie behind, and values must be larger.
  void EndQueuedSlice(const Frustum& /*frustum*/) override { this->FindLeast(); }

  Projection& GetProjection(int ray) { return this->Projections[static_cast<std::size_t>(ray)]; }

  /// Rounded down.
  void SetBound(int ray)
  {
    this->Bounds[static_cast<std::size_t>(ray)] = std::nextafter(
      static_cast<float>(this->GetProjection(ray).Best), -std::numeric_limits<float>::infinity());
  }

  void FindLeast()
  {
    this->Least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < this->Rays.Count; ++i)
    {
      if (this->Bounds[static_cast<std::size_t>(i)] < std::numeric_limits<float>::infinity())
      {
        this->Least = std::min(this->Least, this->GetProjection(i).Best);
      }
    }
  }

  const ImageSelection& Selection;
  const RayPacket& Rays;
  CellMasks<T>& Masks;
  typename Layout::Reader Reader;
  Rows CornersInRows;
  RayProjector& TheProjector;
  std::array<Projection, RayPacket::Capacity> Projections;
  /// Below the values that rays have found; infinite for rays that are not followed.
  std::array<float, RayPacket::Capacity> Bounds;
  /// The smallest value that rays which are followed have found before the slice.
  double Least = 0.0;
};

}

#endif
