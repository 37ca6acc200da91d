// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshBeam_h
#define MeshBeam_h

#include "Field/TracedField.h"
#include "Kernels/BeamPieces.h"
#include "Mesh/BeamFrame.h"
#include "Mesh/CornerOrder.h"
#include "Mesh/MeshSelection.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What a beam of rays may meet in a mesh: blocks of cells, and in them pieces of surfaces. The
/// leaves of the tree, of 16 blocks each, are found front to back, as far as the packets of the
/// beam need them. The cells of a block are read and projected when the first packet comes to it,
/// for all packets.
class MeshBeam final : public TracedField::Beam
{
public:
  /// Begins with the rays between lines.
  void Begin(const MeshSelection& selection, const RayPacket& lines);

  /// Whether the rays have a frame.
  bool IsBeam() const { return this->HasFrame; }
  const BeamFrame& GetFrame() const { return this->Frame; }

  /// Pieces of a surface in a leaf, all in tetrahedra or all in others.
  struct PieceSet
  {
    /// The number of the first one. There are as many numbers to a set as it may have pieces.
    int First;
    int Surface;
    bool AreTetrahedra;
    /// The next set of the leaf, or NoSet.
    int Next;
    BeamPieces Pieces;
    PassedCellRecords Records;
    std::uint32_t Cells[BeamPieces::Capacity];
    /// Of tetrahedra.
    CornerOrder Orders[BeamPieces::Capacity];
  };
  static constexpr int NoSet = -1;

  /// A leaf of the tree: the blocks that the beam may meet, and those whose pieces are there.
  struct Leaf
  {
    LabelBounds Bounds;
    std::size_t Number;
    unsigned int Blocks;
    unsigned int Loaded;
    int FirstSet;
  };

  /// The number of leaves found so far.
  std::size_t GetNumberOfLeaves() const { return this->Leaves.size(); }
  const Leaf& GetLeaf(std::size_t leaf) const { return this->Leaves[leaf]; }

  /// Whether rays of the beam between lines may meet a block.
  bool MayHitBetween(const MeshSelection& selection, const RayPacket& lines);

  /// Finds another leaf. Returns false if there is none before a depth.
  bool FindMore(const MeshSelection& selection, float end);

  /// Makes sure that the pieces in some blocks of a leaf are there; a bit for each block.
  void Load(const MeshSelection& selection, std::size_t leaf, unsigned int blocks);

  /// Whether there are so many pieces that they should be forgotten before further ones are loaded.
  bool IsFull() const { return this->NumberOfSets >= MaximumSets; }
  void ForgetPieces();

  const PieceSet& GetSet(int set) const { return this->Sets[static_cast<std::size_t>(set)]; }
  const PieceSet& GetSetOf(int piece) const { return this->GetSet(piece / BeamPieces::Capacity); }

private:
  /// Some 11 MB for each thread.
  static constexpr int MaximumSets = 2048;

  /// A node of the tree, and a depth that it is behind.
  struct Node
  {
    float Near;
    int Level;
    std::size_t Number;

    /// The nearest one is on top of the heap.
    bool operator<(const Node& other) const { return this->Near > other.Near; }
  };

  /// Cells of one kind.
  struct CellList
  {
    int Count = 0;
    std::uint32_t Numbers[BeamPieces::Capacity];
  };

  void Expand(const MeshSelection& selection, const Node& node);
  void AddLeaf(const MeshSelection& selection, std::size_t number, unsigned int blocks,
    const LabelBounds& bounds);
  void AddSet(const MeshSelection& selection, CellList& cells, std::size_t surface,
    bool areTetrahedra, Leaf& leaf);

  bool HasFrame = false;
  BeamFrame Frame;
  BeamProjection Projection;
  std::vector<IsovalueSpan> Spans;
  std::vector<Node> Heap;
  std::vector<Leaf> Leaves;
  /// Those in use are the first: the memory is kept from beam to beam.
  std::vector<PieceSet> Sets;
  int NumberOfSets = 0;
};

}

#endif
