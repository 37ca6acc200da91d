// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ScatteredRays_h
#define ScatteredRays_h

#include "Kernels/BeamPieces.h"
#include "Rays/RayPacket.h"

#include <cstdint>

// A tree over the pieces of a surface, and single rays on their way through it, in single
// precision. Everything is bounded with a margin for rounding: what is found is too much at times,
// never too little.

namespace vtkIsosurfaceRayTracing
{

/// A node of a tree over sets of pieces: the boxes of its children.
struct alignas(64) PieceTreeNode
{
  static constexpr int Width = 16;

  /// The lower ends along each axis, then the upper ones.
  float Ends[6][Width];
};

/// The boxes of the pieces of a set, in steps of the box of all.
struct alignas(64) PieceBoxes
{
  static constexpr int Capacity = PackedPieces::Capacity;
  static constexpr int Steps = 255;
  /// Ends may be so many steps off, since points of PackedPieces are half a step of theirs off.
  static constexpr float Error = 0.15F;

  float Lower[3];
  float Step[3];
  /// The lower ends along each axis, then the upper ones.
  std::uint8_t Ends[6][Capacity];
  std::uint8_t Count;
};

/// A tree over the sets of pieces of a surface, level by level, without pointers: all nodes but the
/// last of a level have as many children as they can.
struct PieceTreeLevels
{
  /// Nodes of the highest of so many levels would hold 2^32 pieces.
  static constexpr int Capacity = 7;

  const PieceBoxes* Boxes;
  /// Of each set, the polygons; null if the pieces are not in tetrahedra.
  const PackedPieces* Polygons;
  /// The cells of the pieces of all sets, one after the other.
  const std::uint32_t* Cells;
  /// From the nodes whose children are sets to the root: the nodes of each level, and the number of
  /// children of all of them.
  int Count;
  const PieceTreeNode* Nodes[Capacity];
  std::uint32_t Children[Capacity];
};

/// Rays of a packet, each by itself as it comes to boxes and polygons. The depth is the way from
/// the origin along the axis that the ray is longest along.
struct ScatteredRays
{
  static constexpr int Capacity = RayPacket::Capacity;

  // On each axis the depth where a ray has a coordinate: its change, and the depth at 0, earlier
  // and later than it is by more than all rounding.
  alignas(64) float Rate[3][Capacity];
  alignas(64) float Earlier[3][Capacity];
  alignas(64) float Later[3][Capacity];
  /// The depths that a ray begins and ends at.
  alignas(64) float Begin[Capacity];
  alignas(64) float End[Capacity];
  /// The axis that it is longest along, and of the two others, in cyclic order: the coordinate
  /// where that along is 0, and its change. Rounding moves what is measured with them by less than
  /// the error.
  alignas(64) int Along[Capacity];
  alignas(64) float Center[2][Capacity];
  alignas(64) float Slope[2][Capacity];
  alignas(64) float Error[Capacity];
  /// The depth for each step of T, and more than the distance from the origin to anything.
  alignas(64) double DepthOfT[Capacity];
  alignas(64) double Reach[Capacity];

  void SetEnd(int ray, double t)
  {
    this->End[ray] = static_cast<float>(GetDepth(t * this->DepthOfT[ray], this->Reach[ray], 1.0));
  }

  /// A depth and a margin for rounding, behind it or before.
  template <typename Number>
  SIMD_INLINE static Number GetDepth(Number depth, Number reach, double sign)
  {
    return depth + sign * 0x1p-20 * (Abs(depth) + reach);
  }
};

/// What is left of the way of a ray through such a tree, depth first.
struct WayThroughPieces
{
  /// The level of the node that it is in: above the root is one with the root as its child, and at
  /// the end of the way it is above that.
  int Level;
  /// In the node of each level from that on: the number of the first child, and the children that
  /// are left; a bit for each.
  std::uint32_t First[PieceTreeLevels::Capacity + 1];
  unsigned int Left[PieceTreeLevels::Capacity + 1];

  void Begin(const PieceTreeLevels& tree)
  {
    this->Level = tree.Count;
    this->First[this->Level] = 0;
    this->Left[this->Level] = 1;
  }
};

}

#endif
