// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PacketTracer_h
#define PacketTracer_h

#include "Image/Lattice/CellLattice.h"
#include "Image/Macrocells/BlockMask.h"
#include "Image/Macrocells/CroppedBlocks.h"
#include "Image/Traversal/FrustumTraversal.h"
#include "Kernels/Kernels.h"
#include "Math/Compiler.h"
#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// What rays are taken through, which must outlive them: the active macrocells of a lattice, and
/// which parts of them cropping hides; null if none.
struct TracedBlocks
{
  const BlockTree& Tree;
  const CellLattice& Lattice;
  const CroppedBlocks* Cropped;
};

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
  /// The kernels must outlive the tracer.
  PacketTracer(const Kernels& kernels, const TracedBlocks& blocks)
    : TheKernels(kernels)
    , Lattice(blocks.Lattice)
    , Tree(blocks.Tree)
    , Cropped(blocks.Cropped)
  {
    if (const UnevenPlanes* planes = blocks.Lattice.GetPlanes())
    {
      this->OwnPlanes = planes->GetLatticePlanes();
      this->Planes = &this->OwnPlanes;
    }
  }
  PacketTracer(const PacketTracer&) = delete;
  PacketTracer& operator=(const PacketTracer&) = delete;

  /// The order in which a ray comes to the slices of its blocks.
  enum class Order
  {
    FrontToBack,
    /// Any, but a ray that has ended still comes to all that may be nearer than where it has.
    Nearest,
    /// Any; where a ray has ended, it ends.
    Any
  };

  /// Takes all rays of a packet that exist to their ends.
  void Trace(const RayPacket& packet, Cells& cells, Order order);

  virtual void BeginFrustum(const Frustum& /*frustum*/) {}
  /// Called when rays pass a block: its passages are the last ones.
  virtual void AddBlock(const Frustum& /*frustum*/, const Index3& /*block*/) {}
  /// The same for cells of which cropping hides parts: the passages from the first on.
  virtual void AddCroppedCells(const Frustum& frustum, const Index3& block, int /*first*/)
  {
    this->AddBlock(frustum, block);
  }
  /// Called behind the last block of a slice across the axis, or in any order behind a block of
  /// each ray. Rays that have ended are to be removed from Going.
  virtual void EndSlice(const Frustum& frustum) = 0;
  /// Called behind the last block of all.
  virtual void EndFrustum() {}

  void ClearPassages();
  /// Calls visit(cell) for the cells of a passage.
  template <typename Visit>
  void ForEachCell(int axis, int passage, const Visit& visit) const;

  const Kernels& TheKernels;
  const CellLattice& Lattice;
  /// Those of the lattice, if they are uneven; else null.
  const LatticePlanes* Planes = nullptr;
  const RayPacket* Packet = nullptr;
  /// The rays that have not ended.
  RaySet Going = {};
  /// Whether each ray comes to its blocks by itself, not slice by slice.
  bool AreApart = false;
  Passages Passed;

private:
  void TraceSet(const RaySet& rays, int count);
  void TraceHalves(const RaySet& rays, int count);
  void TraceAlike(const RaySet& rays, int axis);
  void TraceFrustum(const Frustum& frustum);
  void TraceApart(const Frustum& frustum);
  void VisitBlock(const Frustum& frustum, const Index3& block);
  void PassBlock(const Frustum& frustum, int ray, const Index3& block);
  bool FindPassages(const Frustum& frustum, const Index3& block, const BlockMask& mask);

  const BlockTree& Tree;
  const CroppedBlocks* Cropped;
  LatticePlanes OwnPlanes;
  Cells* Source = nullptr;
  Order TheOrder = Order::FrontToBack;
  /// Along the axis of the current frustum.
  AlignedRays Aligned;
};

//------------------------------------------------------------------------------
template <typename Visit>
void PacketTracer::ForEachCell(int axis, int passage, const Visit& visit) const
{
  const int* first = this->Passed.First[this->Passed.Segments[passage].Block];
  for (unsigned int slices = this->Passed.Slices[passage]; slices != 0; slices &= slices - 1)
  {
    const int slice = LowestBit(slices);
    for (std::uint64_t bits = this->Passed.Cells[passage][slice]; bits != 0; bits &= bits - 1)
    {
      const int bit = LowestBit(bits);
      Index3 cell = { first[0], first[1], first[2] };
      cell[static_cast<std::size_t>(axis)] += slice;
      cell[static_cast<std::size_t>(BlockMask::U[axis])] += bit % 8;
      cell[static_cast<std::size_t>(BlockMask::V[axis])] += bit / 8;
      visit(cell);
    }
  }
}

}

#endif
