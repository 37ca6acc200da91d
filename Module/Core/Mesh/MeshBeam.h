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

/// The pieces of surfaces that a beam of rays may meet in a mesh. The cells are found front to back
/// through the tree, as far as the packets of the beam need them, and each is read and projected
/// once for all packets.
class MeshBeam final : public TracedField::Beam
{
public:
  /// Begins with the rays between lines.
  void Begin(const MeshSelection& selection, const RayPacket& lines);

  /// Whether the rays have a frame.
  bool IsBeam() const { return this->HasFrame; }
  const BeamFrame& GetFrame() const { return this->Frame; }

  /// The pieces found so far, in sets.
  int GetNumberOfSets() const { return this->Sets; }
  const BeamPieces& GetSet(int number) const
  {
    return this->Pieces[static_cast<std::size_t>(number)];
  }

  /// A surface in a cell. Pieces are numbered through all sets.
  struct PassedCell
  {
    std::uint32_t Number;
    int Surface;
    bool IsTetrahedron;
    CornerOrder Order;
  };
  const PassedCell& GetCell(int piece) const
  {
    return this->Cells[static_cast<std::size_t>(piece)];
  }
  /// One for every piece.
  const CellRecord* GetRecords() const { return this->Records.data(); }

  /// Finds one or more further sets. Returns false if no other piece is before a depth.
  bool FindMore(const MeshSelection& selection, float end);

private:
  /// A node of the tree, or with level -1 a block of cells, and a depth that it is behind.
  struct Node
  {
    float Depth;
    int Level;
    std::size_t Number;

    /// The nearest one is on top of the heap.
    bool operator<(const Node& other) const { return this->Depth > other.Depth; }
  };

  /// Cells of one kind that wait for others to be bounded with.
  struct Queue
  {
    BeamCells Bounded = {};
    PassedCell Cells[BeamCells::Capacity];
    CellRecord Records[BeamCells::Capacity];
  };

  void Expand(const MeshSelection& selection, const Node& node);
  void AddBlock(const MeshSelection& selection, std::size_t block);
  void AddCell(const MeshSelection& selection, std::uint32_t number, int surface);
  void AddToBounds(const CellRecord& record, int count, int place, BeamCells& cells) const;
  void Bound(const MeshSelection& selection, Queue& queue, bool areTetrahedra);

  bool HasFrame = false;
  BeamFrame Frame;
  BeamSides Sides = {};
  std::vector<IsovalueSpan> Spans;
  std::vector<Node> Heap;
  Queue Tetrahedra;
  Queue Others;
  // Those in use are the first.
  std::vector<BeamPieces> Pieces;
  std::vector<PassedCell> Cells;
  std::vector<CellRecord> Records;
  int Sets = 0;
};

}

#endif
