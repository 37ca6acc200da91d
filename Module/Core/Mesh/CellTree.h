// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTree_h
#define CellTree_h

#include "Field/TracedField.h"
#include "Kernels/CellTreeNode.h"
#include "Math/PrefetchLines.h"
#include "Mesh/MeshCells.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

class CodeOrder;

/// A tree over the cells of a mesh: in each node the boxes and the ranges of values of 16 children.
///
/// The leaves are blocks of 16 cells in Morton order, and no node needs a pointer (16 children
/// each, level by level). The same tree serves every isovalue. Where the order of the cells is
/// good, as it is in most files, 16 consecutive ones are a block; else the cells are put in Morton
/// order too, which takes longer and a number for each. (J. Wilhelms, A. Van Gelder: Octrees for
/// Faster Isosurface Generation, ACM TOG 11(3), 1992, have ranges of values in a tree; S. G. Parker
/// et al. 1998 trace rays through one.)
class CellTree
{
public:
  /// The number of children of a node, and of cells in a block.
  static constexpr int Width = CellTreeNode::Width;
  /// That of the nodes whose children are blocks of cells.
  static constexpr int LowestLevel = 0;

  /// Builds the tree of all cells that are traced and finite. There may be up to 2^32 - 1 cells.
  CellTree(const MeshCells& cells, int threads);

  /// The box of all cells; Lower > Upper if there are none.
  const Bounds& GetBounds() const { return this->Box; }
  /// The smallest and the largest value.
  double GetLow() const { return this->Low; }
  double GetHigh() const { return this->High; }

  /// What the boxes of nodes are larger by than their cells: what the arithmetic of rays may lose,
  /// many times over.
  double GetMargin() const;

  /// The levels of nodes, the root last.
  int GetNumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  const CellTreeNode& GetNode(int level, std::size_t node) const
  {
    return this->Levels[static_cast<std::size_t>(level)].Nodes[node];
  }

  /// Whether a child of a node has values on both sides of an isovalue.
  static bool Straddles(const CellTreeNode& node, int child, double isovalue)
  {
    return static_cast<double>(node.Low[child]) < isovalue &&
      isovalue <= static_cast<double>(node.High[child]);
  }

  /// Begins to fetch a node.
  void Prefetch(int level, std::size_t node) const
  {
    PrefetchLines(&this->GetNode(level, node), sizeof(CellTreeNode));
  }

  /// Whether all cells that are traced are finite.
  bool AreAllFinite() const { return this->AreFinite; }

  std::size_t GetNumberOfBlocks() const { return this->Blocks; }

  /// Finds the blocks that may have values in a range, in the order in which their cells are in
  /// memory: much faster for those who read many of them.
  std::vector<std::uint32_t> FindBlocks(double low, double high, int threads) const;

  /// The cells of a block: how many there are, and their numbers. Those that are not traced or not
  /// finite may be among them.
  int GetNumberOfCells(std::size_t block) const
  {
    const std::size_t cells = this->IsSorted ? this->Order.size() : this->Cells;
    const std::size_t first =
      (this->IsSorted ? block : std::size_t{ this->Order[block] }) * std::size_t{ Width };
    return static_cast<int>(std::min(cells - first, std::size_t{ Width }));
  }
  std::uint32_t GetCell(std::size_t block, int number) const
  {
    const auto place = static_cast<std::uint32_t>(number);
    return this->IsSorted ? this->Order[block * Width + place] : this->Order[block] * Width + place;
  }

  /// The cell in a place of a leaf: of its blocks, one after the other.
  std::uint32_t GetCellOfLeaf(std::size_t leaf, int place) const
  {
    return this->GetCell(leaf * Width + static_cast<std::size_t>(place / Width), place % Width);
  }

  /// The numbers of all of them. Returns how many there are.
  int GetCells(std::size_t block, std::uint32_t (&numbers)[Width]) const
  {
    const int count = this->GetNumberOfCells(block);
    for (int i = 0; i < count; ++i)
    {
      numbers[i] = this->GetCell(block, i);
    }
    return count;
  }

  /// Begins to fetch the cells of a block that is looked at soon: they may be anywhere in memory,
  /// and those who wait for each do little else.
  void PrefetchCells(const MeshCells& cells, std::size_t block) const
  {
    const int count = this->GetNumberOfCells(block);
    for (int i = 0; i < count; ++i)
    {
      cells.Prefetch(this->GetCell(block, i));
    }
  }

  std::size_t GetMemory() const;

private:
  struct Extent;
  struct RoundedExtent;
  class MortonCoder;
  class CellReader;

  /// Nodes that are not initialized: the threads that fill them are the first to touch them.
  struct Level
  {
    explicit Level(std::size_t count)
      : Count(count)
      , Nodes(new CellTreeNode[count])
    {
    }

    std::size_t Count;
    std::unique_ptr<CellTreeNode[]> Nodes;
  };

  bool AreScattered(const MeshCells& cells);
  template <typename Function>
  bool ReadBlocks(const MeshCells& cells, int threads, const Function& function);
  bool SortBlocks(const MeshCells& cells, int threads);
  void CodeCells(const MeshCells& cells, const Bounds& box, int threads, CodeOrder& order);
  void SortCells(const MeshCells& cells, int threads);
  template <typename Function>
  void BuildLevel(std::size_t children, double margin, const Function& getExtent, int threads);
  void BuildLevelAbove(int threads);

  Bounds Box;
  double Low;
  double High;
  std::size_t Cells;
  std::size_t Blocks = 0;
  /// Whether cells are sorted, or blocks of consecutive ones; and the numbers of these in order.
  bool IsSorted = false;
  bool AreFinite = true;
  std::vector<std::uint32_t> Order;
  std::vector<Level> Levels;
};

}

#endif
