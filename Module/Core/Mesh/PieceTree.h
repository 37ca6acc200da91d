// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PieceTree_h
#define PieceTree_h

#include "Kernels/ScatteredRays.h"
#include "Mesh/PieceMaker.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A tree over the pieces of a surface in cells of one kind, some 34 bytes for each: for rays that
/// have little in common, as those of ambient occlusion, which pass many cells for every piece that
/// they come to.
///
/// Pieces that are near each other are a set, and sets that are near each other are a node: the
/// cells of all pieces are halved, again and again, across the longest axis of the box of their
/// centres (J. L. Bentley: Multidimensional Binary Search Trees Used for Associative Searching,
/// CACM 18(9), 1975). Halves are whole sets and nodes, and so no node needs a pointer.
class PieceTree
{
public:
  /// A cell that the surface passes, and its centre.
  struct PassedCell
  {
    float Center[3];
    std::uint32_t Number;
  };

  /// Builds that of the pieces in some cells, which are put in order: tetrahedra, or others.
  PieceTree(const PieceMaker& maker, std::vector<PassedCell>& cells, bool areTetrahedra,
    const Kernels& kernels);

  /// How rays come through it.
  PieceTreeLevels GetLevels() const;

  std::size_t GetMemory() const;

private:
  std::vector<PieceTreeNode> PackSets(
    const PieceMaker& maker, bool areTetrahedra, const Kernels& kernels);
  void BuildLevels(std::vector<PieceTreeNode> nodes);

  /// Those of all sets, one after the other.
  std::vector<std::uint32_t> Cells;
  std::vector<PieceBoxes> Boxes;
  /// Empty if the pieces are not in tetrahedra.
  std::vector<PackedPieces> Polygons;
  std::vector<std::vector<PieceTreeNode>> Levels;
};

/// The trees over all pieces of a surface: of those in tetrahedra, and in other cells. There is
/// none without pieces.
class PieceTrees
{
public:
  PieceTrees(const PieceMaker& maker, const Kernels& kernels);

  const std::vector<PieceTree>& Get() const { return this->Trees; }

  std::size_t GetMemory() const;

private:
  std::vector<PieceTree> Trees;
};

/// Those of a surface when they are worth it, and there is memory for them. The thread that comes
/// to that builds them, while others do without.
class PieceTreesOnDemand
{
public:
  explicit PieceTreesOnDemand(const PieceMaker& maker)
    : Maker(maker)
  {
  }

  /// Counts rays that they are for. Returns null as long as there were fewer before, or they are
  /// being built.
  const PieceTrees* Find(int rays, double raysForTrees, const Kernels& kernels);

  /// Those that are there; null if there are none.
  const PieceTrees* Get() const { return this->Built.load(std::memory_order_acquire); }

private:
  PieceMaker Maker;
  std::atomic<std::int64_t> Rays{ 0 };
  std::atomic<bool> AreBegun{ false };
  std::atomic<const PieceTrees*> Built{ nullptr };
  std::unique_ptr<const PieceTrees> Trees;
};

}

#endif
