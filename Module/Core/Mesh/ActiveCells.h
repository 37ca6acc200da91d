// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ActiveCells_h
#define ActiveCells_h

#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace vtkIsosurfaceRayTracing
{

/// Which cells a surface passes. They are found block by block, when the first ray comes to it: by
/// any thread, since all find the same.
class ActiveCells
{
public:
  /// Both must outlive it.
  ActiveCells(const MeshCells& cells, const CellTree& tree, double isovalue);

  double GetIsovalue() const { return this->Isovalue; }

  /// Those in a block of the tree, a bit for each.
  unsigned int Get(std::size_t block)
  {
    const std::uint32_t mask = this->Masks[block].load(std::memory_order_relaxed);
    return mask != 0 ? mask & AllCells : this->Find(block);
  }

  std::size_t GetMemory() const { return this->Blocks * sizeof(this->Masks[0]); }

private:
  static constexpr std::uint32_t AllCells = (1U << CellTree::Width) - 1U;
  static constexpr std::uint32_t Known = AllCells + 1U;

  unsigned int Find(std::size_t block);

  const MeshCells* Cells;
  const CellTree* Tree;
  double Isovalue;
  std::size_t Blocks;
  std::unique_ptr<std::atomic<std::uint32_t>[]> Masks;
};

}

#endif
