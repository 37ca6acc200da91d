// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageSelection_h
#define ImageSelection_h

#include "Field/HitCollector.h"
#include "Image/Lattice/CellLattice.h"
#include "Image/Lattice/Ray.h"
#include "Image/Macrocells/ActiveMacrocells.h"
#include "Image/Macrocells/BlockTree.h"
#include "Image/Macrocells/CroppedBlocks.h"
#include "Image/Traversal/PacketTracer.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/Compiler.h"
#include "Math/PrefetchLines.h"
#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"
#include "Rays/TraceRequest.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What is traced of an image: the request, and what follows from it for the macrocells.
struct ImageSelection
{
  const TracedField& Field;
  TraceRequest Request;
  CellLattice Lattice;
  /// See Execution.
  const Kernels* PacketKernels = nullptr;
  /// Of the surfaces, in the same order.
  std::vector<ScaledIsovalue> Isovalues;
  /// Where rays may hit surfaces.
  ActiveMacrocells Active;
  /// The same for packets of rays; none unless the finest macrocells have 8^3 cells.
  std::optional<BlockTree> Tree;
  /// Of which blocks parts are hidden by cropping; none if it hides nothing.
  std::optional<CroppedBlocks> Cropped;

  ImageSelection(const TracedField& field, const MacrocellLattice& lattice)
    : Field(field)
    , Lattice({ lattice.Cells[0] + 1, lattice.Cells[1] + 1, lattice.Cells[2] + 1 })
    , Active(lattice)
  {
  }

  void SetActive(ActiveMacrocells active, int threads)
  {
    this->Active = std::move(active);
    const auto& levels = this->Active.GetLattice().Levels;
    const bool isBlock = !levels.empty() && levels[0].Edge == BlockMask::Edge;
    this->Tree = isBlock ? std::make_optional<BlockTree>(this->Active, threads) : std::nullopt;
  }

  void SetCropping()
  {
    const CroppingRegions& regions = this->Request.Visible.Regions;
    this->Cropped.reset();
    if (regions.Visible != CroppingRegions::All)
    {
      this->Cropped.emplace(regions, this->Lattice);
    }
  }

  /// What a packet of rays is taken through.
  TracedBlocks GetTracedBlocks() const
  {
    return { *this->Tree, this->Lattice, this->Cropped ? &*this->Cropped : nullptr };
  }

  HitCollector NewCollector(std::vector<Hit>& hits) const
  {
    return HitCollector(this->Field, hits);
  }

  /// Whether rays end at a surface, where it is visible.
  bool IsOpaque(std::size_t surface) const
  {
    return this->Request.Surfaces[surface].Opacity >= 1.0;
  }

  /// Whether they end at its first root in a cell: cells that are hidden as a whole are not among
  /// those that masks lead rays to, but cropping may hide one root and not the next.
  bool EndsRays(std::size_t surface) const { return this->IsOpaque(surface) && !this->Cropped; }

  /// Those of packets, or others for rays that are traced one by one.
  const Kernels& GetAnyKernels() const
  {
    return this->PacketKernels ? *this->PacketKernels : GetBestKernels();
  }

  /// A ray of a packet that exists.
  Ray TakeRay(const RayPacket& rays, int i) const
  {
    Ray ray = GetRay(rays, i);
    ray.Planes = this->Lattice.GetPlanes();
    return ray;
  }

  /// Calls trace(ray) for the rays of a packet that exist, of which each appends its hits.
  template <typename Trace>
  void ForEachRay(const RayPacket& rays, RayHits& hits, const Trace& trace) const
  {
    for (int i = 0; i < rays.Count; ++i)
    {
      if (Has(rays.Exists, i))
      {
        trace(this->TakeRay(rays, i));
      }
      hits.EndRay();
    }
  }

  /// Asks for what the selection refers to.
  void Prefetch() const
  {
    PrefetchLine(this->Request.Surfaces.data());
    PrefetchLine(this->Isovalues.data());
    if (this->Tree)
    {
      const std::vector<BlockTree::Level>& levels = this->Tree->GetLevels();
      PrefetchLines(levels.data(), sizeof(levels[0]));
    }
  }

  /// Packets need macrocells of 8^3 cells, and rays of ordinary length.
  bool CanTracePacket(const RayPacket& rays) const
  {
    bool isFinite = true;
    for (int i = 0; i < rays.Count; ++i)
    {
      // The difference is finite only if both are.
      isFinite = isFinite && (!Has(rays.Exists, i) || std::isfinite(rays.End[i] - rays.Begin[i]));
    }
    return isFinite && this->Tree && this->PacketKernels;
  }
};

}

#endif
