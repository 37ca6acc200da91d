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
#include "Image/Traversal/RayFollower.h"

#include <algorithm>
#include <vector>

// Surfaces that are found as the roots of polynomials along the segments of rays in cells. The
// cells are given by ImageCells, an object for one thread with these functions:
//   void Load(const Index3& cell): makes a cell the current one;
//   bool MayHit(): whether a surface may pass the cell, if its macrocell is active;
//   void FindRoots(const CellSegment& segment, bool all, RootSet& roots): finds the roots of all
//     surfaces along a segment in the cell, in order; some may be behind opaque surfaces;
//   void Prefetch(const Index3& cell): prefetches the cells around a cell.

namespace vtkIsosurfaceRayTracing
{

/// Adds the hits of the roots in a cell. Returns whether nothing of the ray is left.
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

/// Traces each ray by itself, cell by cell. This is the reference.
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

/// The cells of an image for the rays of a packet that are followed.
template <typename T, typename ImageCells>
class FollowedImageCells : public RayFollower::FollowedCells
{
public:
  FollowedImageCells(const RayPacket& rays, CellMasks<T>& masks, ImageCells& cells)
    : Rays(rays)
    , TheCells(cells)
    , Masks(masks)
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

protected:
  const RayPacket& Rays;
  ImageCells& TheCells;

private:
  CellMasks<T>& Masks;
};

/// Finds the hits of each ray in the cells that it is followed through.
template <typename T, typename ImageCells>
class HitFinder final : public FollowedImageCells<T, ImageCells>
{
public:
  HitFinder(
    const ImageSelection& selection, const RayPacket& rays, CellMasks<T>& masks, ImageCells& cells)
    : FollowedImageCells<T, ImageCells>(rays, masks, cells)
    , Lattice(selection.Lattice)
    , Hits(static_cast<std::size_t>(rays.Count))
  {
    for (std::vector<Hit>& own : this->Hits)
    {
      this->Collectors.push_back(selection.NewCollector(own));
    }
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
  /// Of each ray.
  std::vector<std::vector<Hit>> Hits;
  std::vector<HitCollector> Collectors;
  // Kept for their memory.
  std::vector<CellOnRay> OnRay;
  RootSet Roots;
};

/// Traces rays as packets, and follows each ray through its cells.
template <typename T, typename ImageCells>
void TracePacket(const ImageSelection& selection, RayPacket& rays, CellMasks<T>& masks,
  ImageCells& cells, RayHits& hits)
{
  HitFinder<T, ImageCells> finder(selection, rays, masks, cells);
  RayFollower(*selection.PacketKernels, *selection.Tree).Follow(rays, finder);
  finder.GetHits(hits);
}

/// Adds the effect of the crossings of surfaces in a cell to a ray of a packet.
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

/// Finds the rays that surfaces stop, each ray by itself, cell by cell. This is the reference.
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

/// Finds any crossing in the cells that the packet tracer finds for a ray, in any order.
template <typename T, typename ImageCells>
class StopFinder final : public FollowedImageCells<T, ImageCells>
{
public:
  StopFinder(
    const RayPacket& rays, const Departure* departures, CellMasks<T>& masks, ImageCells& cells)
    : FollowedImageCells<T, ImageCells>(rays, masks, cells)
    , Departures(departures)
  {
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
  const Departure* Departures;
  StoppedRays Stopped;
  RootSet Roots;
};

/// Finds the rays that surfaces stop, in packets where possible.
template <typename T, typename ImageCells>
StoppedRays FindStoppedRays(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, CellMasks<T>& masks, ImageCells& cells)
{
  if (!selection.CanTracePacket(rays))
  {
    return FindStoppedCellByCell(selection, rays, departures, cells);
  }
  StopFinder<T, ImageCells> finder(rays, departures, masks, cells);
  RayFollower(*selection.PacketKernels, *selection.Tree).Follow(rays, finder);
  return finder.GetStopped();
}

}

#endif
