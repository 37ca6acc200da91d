// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ScatteredRays_h
#define ScatteredRays_h

#include "Kernels/BeamPieces.h"
#include "Math/Compiler.h"
#include "Rays/RayPacket.h"

#include <cstdint>

// Single rays on their way through trees, and a tree over the pieces of a surface, in single
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
/// where the ray begins along the axis that it is longest along.
struct ScatteredRays
{
  static constexpr int Capacity = RayPacket::Capacity;

  // On each axis the depth where a ray has a coordinate: its change, and the depth at 0, earlier
  // and later than it is by more than all rounding.
  alignas(64) float Rate[3][Capacity];
  alignas(64) float Earlier[3][Capacity];
  alignas(64) float Later[3][Capacity];
  /// The depths that a ray begins at, about 0, and ends at.
  alignas(64) float Begin[Capacity];
  alignas(64) float End[Capacity];
  /// The axis that it is longest along, and of the two others, in cyclic order: the coordinate
  /// where that along is 0, and its change. Rounding moves what is measured with them by less than
  /// the error.
  alignas(64) int Along[Capacity];
  alignas(64) double Center[2][Capacity];
  alignas(64) double Slope[2][Capacity];
  alignas(64) float Error[Capacity];
  /// The T where a ray begins, the depth for each step of T, and more than the distance from there
  /// to anything.
  alignas(64) double FirstT[Capacity];
  alignas(64) double DepthOfT[Capacity];
  alignas(64) double Reach[Capacity];

  void SetEnd(int ray, double t)
  {
    const double depth = (t - this->FirstT[ray]) * this->DepthOfT[ray];
    this->End[ray] = static_cast<float>(depth + 0x1p-20 * (Abs(depth) + this->Reach[ray]));
  }
};

/// What is left of the way of a ray through a tree with 16 children of each node, depth first. It
/// leads to the children of nodes of level 0.
struct WayThroughTree
{
  static constexpr std::uint32_t Width = PieceTreeNode::Width;
  /// Nodes of the highest of so many levels would have 2^32 of those below them.
  static constexpr int Levels = PieceTreeLevels::Capacity;

  /// The level of the node that it is in, and that above the root, of which the root is the child.
  int Level;
  int Top;
  /// Whether the last child comes first.
  bool IsDown;
  /// In the node of each level from that on: the number of the first child, and the children that
  /// are left; a bit for each.
  std::uint32_t First[Levels + 1];
  unsigned int Left[Levels + 1];

  void Begin(int top, bool isDown = false)
  {
    this->Level = top;
    this->Top = top;
    this->IsDown = isDown;
    this->First[top] = 0;
    this->Left[top] = 1;
  }

  /// Takes the next child of the node that it is in, or else of one above. Returns whether there is
  /// one.
  SIMD_INLINE bool Take(std::uint32_t& child)
  {
    while (this->Left[this->Level] == 0)
    {
      if (this->Level == this->Top)
      {
        return false;
      }
      ++this->Level;
    }
    unsigned int& left = this->Left[this->Level];
    const int next = this->IsDown ? HighestBit(left) : LowestBit(left);
    child = this->First[this->Level] + static_cast<std::uint32_t>(next);
    left &= ~(1U << next);
    return true;
  }

  /// Goes down to a child, to some of its children; a bit for each.
  SIMD_INLINE void Enter(std::uint32_t child, unsigned int children)
  {
    --this->Level;
    this->First[this->Level] = child * Width;
    this->Left[this->Level] = children;
  }
};

}

#endif
