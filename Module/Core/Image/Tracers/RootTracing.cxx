// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Tracers/RootTracing.h"

#include "Image/Cells/CellsOnRay.h"
#include "Image/Tracers/PacketCollector.h"
#include "Image/Traversal/CellTraversal.h"
#include "Image/Traversal/RayFollower.h"

#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{
namespace
{

//------------------------------------------------------------------------------
/// The cells for the rays of a packet that are followed.
class FollowedRootCells : public RayFollower::FollowedCells
{
public:
  FollowedRootCells(const ImageSelection& selection, const RayPacket& rays, RootCells& cells)
    : Selection(selection)
    , Rays(rays)
    , TheCells(cells)
  {
    if (const UnevenPlanes* planes = selection.Lattice.GetPlanes())
    {
      this->Planes = planes->GetLatticePlanes();
    }
  }

  void Prefetch(const Index3& block) override { this->TheCells.Prefetch(block); }

  const BlockMask& GetMask(const Index3& block, BlockMask& own) override
  {
    return this->TheCells.GetMask(block, own);
  }

protected:
  /// Null where planes stand at whole numbers.
  const LatticePlanes* GetPlanes() const { return this->Planes ? &*this->Planes : nullptr; }

  const ImageSelection& Selection;
  const RayPacket& Rays;
  RootCells& TheCells;
  /// Kept for its memory.
  RootSet Roots;

private:
  std::optional<LatticePlanes> Planes;
};

//------------------------------------------------------------------------------
/// Finds the hits of each ray in the cells that it is followed through.
class HitFinder final : public FollowedRootCells
{
public:
  HitFinder(const ImageSelection& selection, const RayPacket& rays, RootCells& cells)
    : FollowedRootCells(selection, rays, cells)
    , Collector(selection, rays.Count)
  {
  }

  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = this->Selection.TakeRay(this->Rays, ray);
    FindCellsOnRay(
      *this->Selection.PacketKernels, this->GetPlanes(), this->Rays, ray, cells, this->OnRay);
    for (const CellOnRay& passed : this->OnRay)
    {
      this->TheCells.FindRoots(passed.Cell, passed.Segment, false, this->Roots);
      if (AddHits(own, this->Selection.Lattice, passed.Cell, passed.Segment, this->Roots,
            [this, ray](const Hit& hit) { return this->Collector.Add(ray, hit); }))
      {
        return true;
      }
    }
    return false;
  }

  /// Appends the hits of the rays that were followed.
  void AppendTo(RayHits& hits) const { this->Collector.AppendTo(hits); }

private:
  PacketCollector Collector;
  /// Kept for its memory.
  std::vector<CellOnRay> OnRay;
};

//------------------------------------------------------------------------------
/// Finds any crossing in the cells that a ray is followed through, in any order.
class StopFinder final : public FollowedRootCells
{
public:
  StopFinder(const ImageSelection& selection, const RayPacket& rays, const Departure* departures,
    RootCells& cells)
    : FollowedRootCells(selection, rays, cells)
    , Departures(departures)
  {
  }

  bool NeedsOrder() const override { return false; }

  bool Follow(int ray, const std::vector<Index3>& cells) override
  {
    const Ray own = this->Selection.TakeRay(this->Rays, ray);
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
};

//------------------------------------------------------------------------------
/// Traces each ray by itself, cell by cell. This is the reference.
void TraceCellByCell(
  const ImageSelection& selection, const RayPacket& rays, RootCells& cells, RayHits& hits)
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
          if (!cells.MayHit(cell) || !SegmentInCell(ray, cell, segment))
          {
            return false;
          }
          cells.FindRoots(cell, segment, false, roots);
          return AddHits(ray, selection.Lattice, cell, segment, roots,
            [&collector](const Hit& hit) { return collector.Add(hit); });
        });
    });
}

//------------------------------------------------------------------------------
/// The same for rays that surfaces stop.
StoppedRays FindStoppedCellByCell(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, RootCells& cells)
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
        if (cells.MayHit(cell))
        {
          FindStopsInCell(i, ray, cell, departures[i], cells, roots, stopped);
        }
        return Has(stopped.Stopped, i);
      });
  }
  return stopped;
}

}

//------------------------------------------------------------------------------
void TraceRoots(
  const ImageSelection& selection, const RayPacket& rays, RootCells& cells, RayHits& hits)
{
  if (!selection.CanTracePacket(rays))
  {
    TraceCellByCell(selection, rays, cells, hits);
    return;
  }
  HitFinder finder(selection, rays, cells);
  RayFollower(*selection.PacketKernels, selection.GetTracedBlocks()).Follow(rays, finder);
  finder.AppendTo(hits);
}

//------------------------------------------------------------------------------
StoppedRays FindStoppedRays(const ImageSelection& selection, const RayPacket& rays,
  const Departure* departures, RootCells& cells)
{
  if (!selection.CanTracePacket(rays))
  {
    return FindStoppedCellByCell(selection, rays, departures, cells);
  }
  StopFinder finder(selection, rays, departures, cells);
  RayFollower(*selection.PacketKernels, selection.GetTracedBlocks()).Follow(rays, finder);
  return finder.GetStopped();
}

//------------------------------------------------------------------------------
void FindStopsInCell(int number, const Ray& ray, const Index3& cell, const Departure& departure,
  RootCells& cells, RootSet& roots, StoppedRays& stopped)
{
  CellSegment segment;
  if (!SegmentInCell(ray, cell, segment))
  {
    return;
  }
  cells.FindRoots(cell, segment, true, roots);
  for (const Root& root : roots.Get())
  {
    if (!departure.Is(root.Surface, root.Entering))
    {
      const double t = ray.Base + GetTAt(segment.Begin, segment.End, root.Fraction);
      stopped.AddCrossing(number, t * Length(ray.Direction));
    }
  }
}

}
