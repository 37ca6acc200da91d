// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef NearestNodes_h
#define NearestNodes_h

#include "Kernels/BeamPieces.h"
#include "Mesh/MeshSelection.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The leaves of the tree that a beam may meet, front to back.
class NearestNodes
{
public:
  /// Begins at the root. The selection must have a tree with nodes, and kernels.
  void Begin(const MeshSelection& selection, const BeamProjection& projection);
  /// Begins without any.
  void Clear() { this->Heap.clear(); }

  /// A depth that all leaves which were not found are behind.
  float GetNextDepth() const
  {
    return this->Heap.empty() ? FloatInfinity : this->Heap.front().Near;
  }

  /// Finds the next leaf. Returns false if there is none before a depth.
  bool FindLeaf(const MeshSelection& selection, float end, std::size_t& leaf);

  /// The boxes of some sets of pieces of a leaf, as those of a node: finds which of up to 16 sets
  /// the beam may meet, a bit for each, and their bounds.
  unsigned int FindSets(
    const MeshSelection& selection, const PackedPieces* sets, int count, LabelBounds& bounds) const;

private:
  /// A node of the tree, and a depth that it is behind.
  struct Node
  {
    float Near;
    int Level;
    std::size_t Number;

    /// The nearest one is on top of the heap.
    bool operator<(const Node& other) const { return this->Near > other.Near; }
  };

  void Expand(const MeshSelection& selection, const Node& node);

  BeamProjection Projection;
  std::vector<Node> Heap;
};

}

#endif
