// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketTracer_h
#define PacketTracer_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Macrocells/BlockMask.h"
#include "Image/Traversal/FrustumTraversal.h"
#include "Kernels/Kernels.h"
#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// Takes the rays of a packet through the volume together.
///
/// They traverse the active macrocells as a frustum; for each of these, all cells that the rays may
/// pass and a surface does are found at once. What is done in the cells, derived classes say. The
/// result of a cell depends on the ray and the cell alone (CellSegment.h), so that proposing too
/// many cells costs time and changes nothing.
class PacketTracer
{
public:
  /// The source of cells. Used by one thread.
  class Cells
  {
  public:
    virtual ~Cells() = default;
    /// Prefetches a block.
    virtual void Prefetch(const Index3& block) = 0;
    /// Which cells of a block of 8^3 a surface passes; either kept elsewhere or made in own.
    virtual const BlockMask& GetMask(const Index3& block, BlockMask& own) = 0;
  };

  virtual ~PacketTracer() = default;

  /// Whether rays between lines may come to an active macrocell; see ImageField::MayHitBetween.
  static bool MayMeet(
    const Kernels& kernels, const BlockTree& tree, const CellLattice& lattice, RayPacket& lines);

protected:
  /// All must outlive the tracer.
  PacketTracer(const Kernels& kernels, const BlockTree& tree, const CellLattice& lattice)
    : TheKernels(kernels)
    , Lattice(lattice)
    , Tree(tree)
  {
    if (const UnevenPlanes* planes = lattice.GetPlanes())
    {
      this->OwnPlanes = planes->GetLatticePlanes();
      this->Planes = &this->OwnPlanes;
    }
  }
  PacketTracer(const PacketTracer&) = delete;
  PacketTracer& operator=(const PacketTracer&) = delete;

  /// Takes all rays of a packet that exist to their ends.
  void Trace(const RayPacket& packet, Cells& cells);

  virtual void BeginFrustum(const Frustum& /*frustum*/) {}
  /// Called when rays pass a block: its passages are the last ones.
  virtual void AddBlock(const Frustum& /*frustum*/, const Index3& /*block*/) {}
  /// Called behind the last block of a slice across the axis. Rays that have ended are to be
  /// removed from Going.
  virtual void EndSlice(const Frustum& frustum) = 0;

  void ClearPassages();

  const Kernels& TheKernels;
  const CellLattice& Lattice;
  /// Those of the lattice, if they are uneven; else null.
  const LatticePlanes* Planes = nullptr;
  const RayPacket* Packet = nullptr;
  /// The rays that have not ended.
  RaySet Going = {};
  Passages Passed;

private:
  void TraceSet(const RaySet& rays, int count);
  void VisitBlock(const Frustum& frustum, const Index3& block);

  const BlockTree& Tree;
  LatticePlanes OwnPlanes;
  Cells* Source = nullptr;
  /// Along the axis of the current frustum.
  AlignedRays Aligned;
};

}

#endif
