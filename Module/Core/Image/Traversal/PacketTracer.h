// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketTracer_h
#define PacketTracer_h

#include "Field/Departure.h"
#include "Image/Macrocells/BlockMask.h"
#include "Image/Samples/CellLattice.h"
#include "Image/Traversal/FrustumTraversal.h"
#include "Kernels/Kernels.h"
#include "Rays/Hit.h"
#include "Rays/Ray.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The first hits of the rays of a packet.
struct PacketHits
{
  /// The rays that hit.
  RaySet Found;
  std::array<Hit, RayPacket::Capacity> Hits;
  /// Where each ray comes into the cell of its hit.
  std::array<Crossing, RayPacket::Capacity> Begin;
};

/// Leads the rays of a packet through the volume together.
///
/// They walk as a frustum to the active macrocells; for each of them, all cells of a macrocell that
/// the ray may pass and a surface does are found at once. For first hits, single precision tells of
/// most of these cells whether the ray surely misses or surely hits the surface there; those it may
/// hit are solved together, as exactly as for a ray by itself. What a cell has to say to a ray
/// comes from the two alone (CellSegment.h), so that proposing too many cells costs time and
/// changes nothing.
class PacketTracer
{
public:
  /// Where cells come from. Used by one thread.
  class Cells
  {
  public:
    virtual ~Cells() = default;
    /// Says that a block is needed soon.
    virtual void Prefetch(const Index3& block) = 0;
    /// Which cells of a block of 8^3 a surface passes; either kept elsewhere or made in own.
    virtual const BlockMask& GetMask(const Index3& block, BlockMask& own) = 0;
  };

  /// Cells in which the first hits with one surface are found.
  class FirstHitCells : public Cells
  {
  public:
    /// Where the first corner of the first cell of a block is kept; null unless all its corners are
    /// kept in rows.
    virtual const void* FindCorner(const Index3& block) = 0;
    /// How many bytes it is from there to the next along each axis.
    virtual std::array<std::ptrdiff_t, 3> GetCornerSteps() const = 0;
    /// Copies the corners of cells, wherever they are kept, until the next are copied.
    virtual void CopyCorners(PassedCells& cells, int axis, const Passages& passages) = 0;
    /// Calls the kernels for corners that are kept in rows, or were copied.
    virtual void ClassifyCells(const PassedCells& cells, int axis, bool areCopied,
      Passages& passages, Candidates& candidates, RaySet hits[2]) = 0;
    virtual void LoadCorners(bool areCopied, Candidates& candidates) = 0;
    /// Adds what the crossings of the surface in a cell are to a ray of the packet.
    virtual void FindStops(
      int ray, const Index3& cell, const Departure& departure, StoppedRays& stopped) = 0;
    /// Solves a cell that the kernels do not: the first hit of a ray of the packet in it, and where
    /// the ray comes into the cell. Returns false if there is none.
    virtual bool FindFirstHit(int ray, const Index3& cell, Hit& hit, Crossing& begin) = 0;
  };

  /// Cells through which each ray is followed.
  class FollowedCells : public Cells
  {
  public:
    /// Follows a ray through cells that it may pass, in no order; all it passes before them it has
    /// been through. Returns whether nothing of the ray is left.
    virtual bool Follow(int ray, const std::vector<Index3>& cells) = 0;
  };

  /// All must outlive the tracer.
  PacketTracer(const Kernels& kernels, const BlockTree& tree, const CellLattice& lattice)
    : TheKernels(kernels)
    , Tree(tree)
    , Lattice(lattice)
  {
  }

  /// Whether rays between lines may come to an active macrocell; see ImageField::MayHitBetween.
  static bool MayMeet(
    const Kernels& kernels, const BlockTree& tree, const Index3& dimensions, RayPacket& lines);

  /// Finds the first hits of all rays of a packet that exist, with one surface. The candidates of
  /// many rays are solved at once.
  const PacketHits& FindFirstHits(
    const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue);

  /// Finds the rays of a packet that one surface stops, wherever that is. There is a departure for
  /// each ray.
  const StoppedRays& FindStopped(const RayPacket& packet, FirstHitCells& cells,
    const ScaledIsovalue& isovalue, const Departure* departures);

  /// Leads all rays of a packet that exist through the cells that may have hits.
  void FollowRays(const RayPacket& packet, FollowedCells& cells);

private:
  void TraceSurface(const RayPacket& packet, FirstHitCells& cells, const ScaledIsovalue& isovalue);
  void Trace(const RayPacket& packet, Cells& cells);
  void TraceSet(const RaySet& rays, int count);
  void SetStepsInSlice(int axis);
  void VisitBlock(const Frustum& frustum, const Index3& block);
  void EndSlice(const Frustum& frustum);
  void ClearPassages();
  void ClassifyPassages(const Frustum& frustum);
  void AddCellsOfSlice(int axis, int passage, int slice);
  void ClassifyQueue(const Frustum& frustum);
  void FollowPassages(const Frustum& frustum);
  void AddCells(int axis, int passage, std::vector<Index3>& cells) const;
  void SolveCandidates();
  void DropStoppedCandidates();
  Index3 GetCell(int candidate) const;
  void FindFirstHit(int ray, const Index3& cell);
  void StopAtCandidate(int candidate);
  void StopInCell(int ray, const Index3& cell);
  void StopAtSureHits(const Frustum& frustum);
  bool IsOver(int passage) const;
  Hit GetHit(int candidate) const;
  void Keep(int ray, const Hit& hit, const Crossing& begin);

  const Kernels& TheKernels;
  const BlockTree& Tree;
  const CellLattice& Lattice;

  const RayPacket* Packet = nullptr;
  Cells* Source = nullptr;
  /// The same; one of them is null.
  FirstHitCells* FirstHitSource = nullptr;
  FollowedCells* FollowedSource = nullptr;
  /// Along the axis of the frustum that goes on.
  AlignedRays Aligned;
  /// The rays that are still on their way.
  RaySet Going = {};
  /// The surface whose first hits are requested; none when rays are followed.
  std::optional<ScaledIsovalue> Isovalue;
  PacketHits Hits;
  /// Where rays start, if it is only asked whether they are stopped; else null.
  const Departure* Departures = nullptr;
  StoppedRays Stopped;
  /// The rays that surely hit something, wherever that turns out to be: where values fall, and
  /// where they rise along the axis of the frustum.
  RaySet SurelyHit[2] = {};
  Passages Passed;
  /// Whether the corners of all passages are kept in rows.
  bool AllInRows = true;
  PassedCells Queue;
  /// Whether the corners of the candidates were copied.
  bool AreCopied = false;
  Candidates Waiting;
  Solutions Solved;
  std::array<std::ptrdiff_t, 3> CornerSteps = {};
  /// From the first corner of a slice of cells to that of each of its cells.
  std::array<std::ptrdiff_t, 64> StepsInSlice = {};
  /// Kept for its memory.
  std::vector<Index3> CellsOfRay;
};

}

#endif
