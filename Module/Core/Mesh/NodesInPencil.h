// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NodesInPencil_h
#define NodesInPencil_h

#include "Kernels/BeamPieces.h"
#include "Mesh/MeshSelection.h"

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// The leaves of the tree that a pencil of rays may meet, depth first, and about front to back.
/// (Those of a beam come front to back, which takes more for each.)
class NodesInPencil
{
public:
  /// Begins at the root. The selection must have a tree with nodes, and kernels.
  void Begin(const MeshSelection& selection, const PencilThroughBoxes& pencil);

  /// Finds the next leaf before a depth. Returns false if there is none.
  bool FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf);

  const PencilThroughBoxes& GetPencil() const { return this->Pencil; }

private:
  /// A node of the tree, and a depth that it is behind.
  struct Node
  {
    float Near;
    int Level;
    std::size_t Number;
  };

  void Expand(const MeshSelection& selection, int level, std::size_t number, float end);

  /// Nodes of the lowest of so many levels would hold 2^32 cells.
  static constexpr std::size_t MaximumLevels = 7;

  PencilThroughBoxes Pencil;
  /// The next one last.
  Node Nodes[MaximumLevels * CellTreeNode::Width];
  std::size_t Count = 0;
};

}

#endif
