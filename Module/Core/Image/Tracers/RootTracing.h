// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef RootTracing_h
#define RootTracing_h

#include "Field/Departure.h"
#include "Field/RootSet.h"
#include "Image/Cells/CellsOnRay.h"
#include "Image/Macrocells/CellMasks.h"
#include "Image/Tracers/ImageSelection.h"
#include "Image/Traversal/CellTraversal.h"
#include "Image/Traversal/PacketTracer.h"

#include <algorithm>
#include <vector>

// Surfaces that are found as the roots of polynomials along the segments of rays in cells. What a
// cell has to say is asked of ImageCells, an object for one thread with these functions:
//   void Load(const Index3& cell): goes to a cell;
//   bool MayHit(): whether a surface may pass the cell, if its macrocell is active;
//   void FindRoots(const CellSegment& segment, bool all, RootSet& roots): the roots of all surfaces
//   along a
//     segment in the cell, in order. Behind one of an opaque surface there may be more;
//   void Prefetch(const Index3& cell): says that the cells around it are needed soon.

namespace vtkIsosurfaceRayTracing
{

/// Adds the hits that the roots in a cell are. Returns whether nothing of the ray is left.
inline bool AddHits(const Ray& ray, const CellLattice& lattice, const Index3& cell,
  const CellSegment& segment, const RootSet& roots, HitCollector& collector)
{
  for (const Root& root : roots.Get())
  {
    if (collector.Add(
          MakeHit(ray, lattice, cell, segment, root.Fraction, root.Surface, root.Entering)))
    {
      return true;
    }
  }
  return false;
}

/// Traces each ray by itself, from cell to cell. This is the reference.
template <typename ImageCells>
void TraceCellByCell(
  const ImageSelection& selection, const RayPacket& rays, ImageCells& cells, RayHits& hits)
{
  RootSet roots;
  selection.ForEachRay(rays, hits,
    [&](const Ray& ray)
    {
      HitCollector collector = selection.NewCollector(hits.Hits);
      TraverseCells(ray, selection.Active,
        [&](const Index3& cell)
        {
          CellSegment segment;
          cells.Load(cell);
          if (!cells.MayHit() || !SegmentInCell(ray, cell, segment))
          {
            return false;
          }
          cells.FindRoots(segment, false, roots);
          return AddHits(ray, selection.Lattice, cell, segment, roots, collector);
        });
    });
}

/// Follows each ray of a packet through the cells that the packet tracer finds for it.
template <typename T, typename ImageCells>
class PacketFollower final : public PacketTracer::FollowedCells
{
public:
  PacketFollower(
    const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks, ImageCells& cells)
    : Lattice(selection.Lattice)
    , Rays(rays)
    , Masks(masks)
    , TheCells(cells)
    , Hits(static_cast<std::size_t>(rays.Count))
  {
    for (std::vector<Hit>& own : this->Hits)
    {
      this->Collectors.push_back(selection.NewCollector(own));
    }
  }

  void Prefetch(const Index3& block) override
  {
    this->Masks.Prefetch(block);
    this->TheCells.Prefetch(
      { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge, block[2] * BlockMask::Edge });
  }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Masks.Get(block, own);
  }

  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = GetRay(this->Rays, ray);
    FindCellsOnRay(own, cells, this->OnRay);
    for (const CellOnRay& passed : this->OnRay)
    {
      this->TheCells.Load(passed.Cell);
      this->TheCells.FindRoots(passed.Segment, false, this->Roots);
      if (AddHits(own, this->Lattice, passed.Cell, passed.Segment, this->Roots,
            this->Collectors[static_cast<std::size_t>(ray)]))
      {
        return true;
      }
    }
    return false;
  }

  /// Appends the hits of the rays that were followed.
  void GetHits(RayHits& hits) const
  {
    for (const std::vector<Hit>& own : this->Hits)
    {
      hits.Hits.insert(hits.Hits.end(), own.begin(), own.end());
      hits.EndRay();
    }
  }

private:
  const CellLattice& Lattice;
  const RayPacket& Rays;
  CellMasks<T>& Masks;
  ImageCells& TheCells;
  /// Of each ray.
  std::vector<std::vector<Hit>> Hits;
  std::vector<HitCollector> Collectors;
  // Kept for their memory.
  std::vector<CellOnRay> OnRay;
  RootSet Roots;
};

/// Traces rays as packets, and follows each through its cells.
template <typename T, typename ImageCells>
void TracePacket(const ImageSelection& selection, RayPacket& rays, CellMasks<T>& masks,
  ImageCells& cells, RayHits& hits)
{
  PacketTracer tracer(*selection.PacketKernels, *selection.Tree, selection.Lattice);
  PacketFollower<T, ImageCells> follower(selection, rays, masks, cells);
  tracer.FollowRays(rays, follower);
  follower.GetHits(hits);
}

/// Adds what the crossings of surfaces in a cell are to a ray of a packet.
template <typename ImageCells>
void FindStopsInCell(int number, const Ray& ray, const Index3& cell, const Departure& departure,
  ImageCells& cells, RootSet& roots, StoppedRays& stopped)
{
  CellSegment segment;
  cells.Load(cell);
  if (!cells.MayHit() || !SegmentInCell(ray, cell, segment))
  {
    return;
  }
  cells.FindRoots(segment, true, roots);
  for (const Root& root : roots.Get())
  {
    if (!departure.Is(root.Surface, root.Entering))
    {
      const double t = ray.Base + GetTAt(segment.Begin, segment.End, root.Fraction);
      stopped.AddCrossing(number, t, ray.Direction);
    }
  }
}

/// Finds the rays that surfaces stop, each ray by itself, from cell to cell. This is the reference.
template <typename ImageCells>
StoppedRays FindStoppedCellByCell(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, ImageCells& cells)
{
  StoppedRays stopped;
  RootSet roots;
  for (int i = 0; i < rays.Count; ++i)
  {
    if (!Has(rays.Exists, i))
    {
      continue;
    }
    const Ray ray = selection.TakeRay(rays, i);
    TraverseCells(ray, selection.Active,
      [&](const Index3& cell)
      {
        FindStopsInCell(i, ray, cell, departures[i], cells, roots, stopped);
        return Has(stopped.Stopped, i);
      });
  }
  return stopped;
}

/// Looks for any crossing in the cells that the packet tracer finds for a ray, in whatever order.
template <typename T, typename ImageCells>
class StopFinder final : public PacketTracer::FollowedCells
{
public:
  StopFinder(
    const RayPacket& rays, const Departure* departures, CellMasks<T>& masks, ImageCells& cells)
    : Rays(rays)
    , Departures(departures)
    , Masks(masks)
    , TheCells(cells)
  {
  }

  void Prefetch(const Index3& block) override
  {
    this->Masks.Prefetch(block);
    this->TheCells.Prefetch(
      { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge, block[2] * BlockMask::Edge });
  }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->Masks.Get(block, own);
  }

  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = GetRay(this->Rays, ray);
    for (const Index3& cell : cells)
    {
      FindStopsInCell(
        ray, own, cell, this->Departures[ray], this->TheCells, this->Roots, this->Stopped);
      if (Has(this->Stopped.Stopped, ray))
      {
        return true;
      }
    }
    return false;
  }

  const StoppedRays& GetStopped() const { return this->Stopped; }

private:
  const RayPacket& Rays;
  const Departure* Departures;
  CellMasks<T>& Masks;
  ImageCells& TheCells;
  StoppedRays Stopped;
  RootSet Roots;
};

/// Finds the rays that surfaces stop, in packets if it can.
template <typename T, typename ImageCells>
StoppedRays FindStoppedRays(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, CellMasks<T>& masks, ImageCells& cells)
{
  if (!selection.CanTracePacket(rays))
  {
    return FindStoppedCellByCell(selection, rays, departures, cells);
  }
  PacketTracer tracer(*selection.PacketKernels, *selection.Tree, selection.Lattice);
  StopFinder<T, ImageCells> finder(rays, departures, masks, cells);
  tracer.FollowRays(rays, finder);
  return finder.GetStopped();
}

}

#endif
