// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SurfacePieces_h
#define SurfacePieces_h

#include "Kernels/Kernels.h"
#include "Math/Compiler.h"
#include "Math/PrefetchLines.h"
#include "Mesh/PieceMaker.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace vtkIsosurfaceRayTracing
{

/// The pieces of a surface in the cells of a mesh, 20 bytes for each, for any view. Those in a leaf
/// of the tree (in its 16 blocks of 16 cells) are made when the first beam comes to it, by any
/// thread, since all make the same.
///
/// They tell beams where the surface may be, and no more: what rays hit is found in the cells.
class SurfacePieces
{
public:
  /// Cells and tree must outlive it. For the scale, see MeshSurface.
  SurfacePieces(const MeshCells& cells, const CellTree& tree, double isovalue, double scale);
  ~SurfacePieces();
  SurfacePieces(const SurfacePieces&) = delete;
  SurfacePieces& operator=(const SurfacePieces&) = delete;

  /// Those in a leaf: the first of so many sets as it says.
  const PackedPieces* Get(std::size_t leaf, const Kernels& kernels)
  {
    const PackedPieces* made = this->Leaves[leaf].load(std::memory_order_acquire);
    return made ? made : this->Make(leaf, kernels);
  }

  const PieceMaker& GetMaker() const { return this->Maker; }

  /// Begins to fetch what is known of some consecutive leaves...
  void Prefetch(std::size_t leaf, std::size_t count) const
  {
    PrefetchLines(&this->Leaves[leaf], count * sizeof(this->Leaves[0]));
  }
  /// ...and the boxes of most sets of a leaf.
  void PrefetchBoxes(std::size_t leaf) const
  {
    constexpr int most = 4;
    const PackedPieces* made = this->Leaves[leaf].load(std::memory_order_relaxed);
    for (int i = 0; i < most && made; ++i)
    {
      PrefetchLine(made + i);
    }
  }

  std::size_t GetMemory() const
  {
    return this->NumberOfLeaves * sizeof(this->Leaves[0]) + this->Memory.load();
  }

private:
  const PackedPieces* Make(std::size_t leaf, const Kernels& kernels);
  void MakeSets(const CellsOfLeaf& passed, bool areTetrahedra, const Kernels& kernels,
    PackedPieces*& next) const;

  PieceMaker Maker;
  std::size_t NumberOfLeaves;
  std::unique_ptr<std::atomic<const PackedPieces*>[]> Leaves;
  std::atomic<std::size_t> Memory{ 0 };
};

}

#endif
