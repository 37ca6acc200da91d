// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshBeam_h
#define MeshBeam_h

#include "Field/TracedField.h"
#include "Kernels/BeamPieces.h"
#include "Mesh/BeamFrame.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/NearestNodes.h"
#include "Mesh/TrilinearHulls.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// What a beam of rays may meet in a mesh: sets of pieces of surfaces. The leaves of the tree that
/// hold them are found front to back, as far as the packets of the beam need them. The pieces of a
/// set are projected when the first packet comes to it, for all packets.
class MeshBeam final : public TracedField::Beam
{
public:
  static constexpr std::size_t GroupSize = LabelBounds::Capacity;

  /// Begins with the rays between lines, of which the origins and directions are set.
  void Begin(const MeshSelection& selection, const RayPacket& lines);

  /// Begins with some rays, from where they begin.
  void Begin(const MeshSelection& selection, const RayPacket& rays, const RaySet& some);

  /// About how many cells are side by side in a rectangle.
  static double CountCells(const MeshSelection& selection, double width, double height)
  {
    return (width / selection.CellSize + 1.0) * (height / selection.CellSize + 1.0);
  }

  /// Whether so many rays, with as many cells between them, are so far from each other that they
  /// have little in common: most cells are met by none. That is when a ray has more than some
  /// tetrahedra to itself, or half a trilinear cell, for which a beam takes longer.
  static bool AreFarApart(
    const MeshSelection& selection, double cells, int count, double mostTetrahedra);

  /// Ends without beginning anew: there is no frame.
  void End() { this->HasFrame = false; }

  /// Whether the rays have a frame.
  bool IsBeam() const { return this->HasFrame; }
  const BeamFrame& GetFrame() const { return this->Frame; }

  /// The number of sets found so far.
  std::size_t GetNumberOfSets() const { return this->Sets.size(); }

  /// Finds which of the sets rays may meet that are in the group of 16 of the next one, from that
  /// on; a bit for each of the group. The next one moves behind them.
  unsigned int FindPassed(
    const MeshSelection& selection, const BeamRays& rays, std::size_t& next) const;

  /// Whether rays of the beam between lines may meet a piece.
  bool MayHitBetween(const MeshSelection& selection, const RayPacket& lines);

  /// A depth that the sets which were not found are behind.
  float GetNextDepth() const { return this->Nodes.GetNextDepth(); }

  /// Finds the sets in another leaf. Returns false if there is none before a depth.
  bool FindMore(const MeshSelection& selection, float end);

  /// Returns the number of the pieces of a set. There are as many numbers to a set as it may have
  /// pieces: this is that of the first, divided by it.
  int Load(const MeshSelection& selection, std::size_t set);

  /// Whether rays of the beam have too little in common: many pieces reach behind the point where
  /// the rays meet, as in a mesh of long cells that the camera is in. Any ray may meet these.
  bool HasLittleInCommon() const { return this->AnyLabel > MaximumAnyLabel; }

  /// Whether there are so many that they should be forgotten before further ones are loaded.
  bool IsFull() const { return this->NumberOfSeen >= MaximumSeen; }
  void Forget();

  const BeamPieces& GetPieces(int number) const { return this->GetSeen(number).Pieces; }

  /// The cell and the surface of a piece.
  bool IsInTetrahedron(int piece) const { return this->GetSetOf(piece).Packed->AreInTetrahedra; }
  int GetSurface(int piece) const { return this->GetSetOf(piece).Surface; }
  std::uint32_t GetCell(const MeshSelection& selection, int piece) const
  {
    const Set& set = this->GetSetOf(piece);
    return GetCell(selection, set, piece % BeamPieces::Capacity);
  }

private:
  /// Some 2.5 MB for each thread.
  static constexpr int MaximumSeen = 2048;
  /// Of pieces that may have any label: each is tried with every ray.
  static constexpr int MaximumAnyLabel = 256;
  static constexpr int NotSeen = -1;

  /// Pieces of a surface in a leaf.
  struct Set
  {
    const PackedPieces* Packed;
    std::size_t Leaf;
    int Surface;
    int Seen;
  };

  /// Pieces as the beam sees them.
  struct SeenPieces
  {
    std::size_t Set;
    BeamPieces Pieces;
  };

  static std::uint32_t GetCell(const MeshSelection& selection, const Set& set, int number)
  {
    return selection.Tree->GetCellOfLeaf(set.Leaf, set.Packed->Cells[number]);
  }

  const SeenPieces& GetSeen(int number) const
  {
    return this->Seen[static_cast<std::size_t>(number)];
  }
  const Set& GetSetOf(int piece) const
  {
    return this->Sets[this->GetSeen(piece / BeamPieces::Capacity).Set];
  }

  bool FindFrame(const MeshSelection& selection, const RayPacket& lines, const RaySet& some);
  void AddLeaf(const MeshSelection& selection, std::size_t leaf);
  void AddSets(const MeshSelection& selection, std::size_t leaf, int surface,
    const PackedPieces* first, int count);
  static void Prefetch(const MeshSelection& selection, const Set& set);
  void BoundTrilinear(const MeshSelection& selection, const Set& set, BeamPieces& pieces);

  bool HasFrame = false;
  BeamFrame Frame;
  NearestNodes Nodes;
  std::vector<Set> Sets;
  std::vector<LabelBounds> Bounds;
  /// Those in use are the first: the memory is kept from beam to beam.
  std::vector<SeenPieces> Seen;
  int NumberOfSeen = 0;
  /// Of these, the pieces that may have any label.
  int AnyLabel = 0;
  TrilinearHulls Hulls;
};

}

#endif
