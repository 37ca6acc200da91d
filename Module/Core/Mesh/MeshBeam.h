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

/// What a beam of rays may meet in a mesh: blocks of cells, and in them pieces of surfaces. Blocks
/// are found front to back through the tree, as far as the packets of the beam need them. The cells
/// of a block are read and projected when the first packet comes to it, for all packets.
class MeshBeam final : public TracedField::Beam
{
public:
  /// Begins with the rays between lines.
  void Begin(const MeshSelection& selection, const RayPacket& lines);

  /// Whether the rays have a frame.
  bool IsBeam() const { return this->HasFrame; }
  const BeamFrame& GetFrame() const { return this->Frame; }

  /// The number of blocks found so far.
  int GetNumberOfBlocks() const { return static_cast<int>(this->Blocks.size()); }
  /// The bounds of the blocks from a multiple of LabelBounds::Capacity on.
  const LabelBounds& GetBounds(int first) const
  {
    return this->Bounds[static_cast<std::size_t>(first / LabelBounds::Capacity)];
  }

  /// Finds further blocks. Returns false if no other is before a depth.
  bool FindMore(const MeshSelection& selection, float end);

  /// Pieces of a surface in a block, all in tetrahedra or all in others.
  struct PieceSet
  {
    /// The number of the first one. There are as many numbers to a set as it may have pieces.
    int First;
    int Surface;
    bool AreTetrahedra;
    BeamPieces Pieces;
    PassedCellRecords Records;
    std::uint32_t Cells[BeamPieces::Capacity];
    /// Of tetrahedra.
    CornerOrder Orders[BeamPieces::Capacity];
  };

  /// All sets of a block.
  struct PieceSets
  {
    const PieceSet* Begin;
    const PieceSet* End;

    const PieceSet* begin() const { return this->Begin; }
    const PieceSet* end() const { return this->End; }
  };
  PieceSets GetPieces(const MeshSelection& selection, int block);

  const PieceSet& GetSetOf(int piece) const
  {
    return this->Sets[static_cast<std::size_t>(piece / BeamPieces::Capacity)];
  }

  /// The numbers in all records, and where those of a piece begin.
  const double* GetRecords() const { return &this->Sets[0].Records.Corner[0][0][0]; }
  static int FindRecord(int piece)
  {
    constexpr int size = sizeof(PieceSet) / sizeof(double);
    return piece / BeamPieces::Capacity * size + piece % BeamPieces::Capacity;
  }

private:
  /// A node of the tree, or with level -1 a block, with its bounds.
  struct Node
  {
    std::size_t Number;
    int Level;
    float Near;
    float Lower[2];
    float Upper[2];

    /// The nearest one is on top of the heap.
    bool operator<(const Node& other) const { return this->Near > other.Near; }
  };

  struct Block
  {
    std::size_t Number;
    /// Its sets of pieces; none yet if the first is -1.
    int FirstSet;
    int LastSet;
  };

  void Expand(const MeshSelection& selection, const Node& node);
  void AddBlock(const MeshSelection& selection, const Node& node);
  void AddPieces(const MeshSelection& selection, std::size_t block);
  void AddSet(const MeshSelection& selection, const std::uint32_t* numbers, int count,
    std::size_t surface, bool areTetrahedra);

  bool HasFrame = false;
  BeamFrame Frame;
  BeamProjection Projection;
  std::vector<IsovalueSpan> Spans;
  std::vector<Node> Heap;
  std::vector<Block> Blocks;
  std::vector<LabelBounds> Bounds;
  /// Those in use are the first: the memory is kept from beam to beam.
  std::vector<PieceSet> Sets;
  int NumberOfSets = 0;
};

}

#endif
