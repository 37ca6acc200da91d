// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FrustumTraversal_h
#define FrustumTraversal_h

#include "Image/Macrocells/BlockTree.h"
#include "Kernels/Kernels.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{

/// Traverses a tree of blocks with a frustum of rays, slice by slice across its axis, to the active
/// macrocells it may pass. Those of one slice come together, in no order; everything that a ray
/// meets in a later slice is behind everything it meets in an earlier one.
class FrustumTraversal
{
public:
  /// The maximum width of a frustum, in cells.
  static constexpr double LargestWidth = 96.0;

  /// The tree must outlive the traversal.
  FrustumTraversal(const BlockTree& tree, const Frustum& frustum)
    : Tree(tree)
    , TheFrustum(frustum)
  {
    for (int j = 0; j < 2; ++j)
    {
      this->LeastSlope[j] =
        (frustum.Least[j][1] - frustum.Least[j][0]) / (frustum.High - frustum.Low);
      this->MostSlope[j] = (frustum.Most[j][1] - frustum.Most[j][0]) / (frustum.High - frustum.Low);
    }
  }

  static bool IsTooWide(const Frustum& frustum)
  {
    for (int j = 0; j < 2; ++j)
    {
      if (frustum.Most[j][0] - frustum.Least[j][0] > LargestWidth ||
        frustum.Most[j][1] - frustum.Least[j][1] > LargestWidth)
      {
        return true;
      }
    }
    return false;
  }

  /// Calls visit(macrocells, count) for the macrocells of every slice that has any, until visit
  /// returns true.
  template <typename Visit>
  void ForEachSlice(const Visit& visit) const
  {
    const std::size_t top = this->Tree.GetLevels().size() - 1;
    const Index3& size = this->Tree.GetLevels()[top].Size;
    const auto axis = static_cast<std::size_t>(this->TheFrustum.Axis);
    Members all;
    all.Count = 0;
    for (int v = 0; v < size[static_cast<std::size_t>(BlockMask::V[axis])]; ++v)
    {
      for (int u = 0; u < size[static_cast<std::size_t>(BlockMask::U[axis])]; ++u)
      {
        all.Add(u, v);
      }
    }
    this->ForEachMember(
      0, size[axis], [&](int block) { return this->EnterBlocks(top, block, all, visit); });
  }

private:
  /// Members of a slice, by their positions across the axis.
  struct Members
  {
    static constexpr int Capacity = 256;
    int Count;
    int U[Capacity];
    int V[Capacity];

    void Add(int u, int v)
    {
      this->U[this->Count] = u;
      this->V[this->Count++] = v;
    }
  };

  /// Calls function(i) for count numbers from first on, in the order of the frustum, until it
  /// returns true; returns whether it did.
  template <typename Function>
  bool ForEachMember(int first, int count, const Function& function) const
  {
    for (int i = 0; i < count; ++i)
    {
      if (function(first + (this->TheFrustum.IsUp ? i : count - 1 - i)))
      {
        return true;
      }
    }
    return false;
  }

  template <typename Visit>
  bool EnterBlocks(std::size_t level, int block, const Members& blocks, const Visit& visit) const
  {
    return this->ForEachMember(block * BlockMask::Edge, BlockMask::Edge,
      [&](int slice) { return this->EnterSlice(level, slice, blocks, visit); });
  }

  /// Continues with the members of blocks that are active and that the frustum may pass in a slice.
  template <typename Visit>
  bool EnterSlice(std::size_t level, int slice, const Members& blocks, const Visit& visit) const
  {
    Members members;
    this->FindMembers(level, slice, blocks, members);
    if (members.Count == 0)
    {
      return false;
    }
    if (level > 0)
    {
      return this->EnterBlocks(level - 1, slice, members, visit);
    }
    const int axis = this->TheFrustum.Axis;
    Index3 macrocells[Members::Capacity];
    for (int i = 0; i < members.Count; ++i)
    {
      macrocells[i][static_cast<std::size_t>(axis)] = slice;
      macrocells[i][static_cast<std::size_t>(BlockMask::U[axis])] = members.U[i];
      macrocells[i][static_cast<std::size_t>(BlockMask::V[axis])] = members.V[i];
    }
    return visit(macrocells, members.Count);
  }

  void FindMembers(
    std::size_t levelNumber, int slice, const Members& blocks, Members& members) const
  {
    members.Count = 0;
    const BlockTree::Level& level = this->Tree.GetLevels()[levelNumber];
    const Frustum& frustum = this->TheFrustum;
    const int axis = frustum.Axis;
    const double edge = level.MemberEdge;
    const double begin = std::max(slice * edge, frustum.Low) - frustum.Low;
    const double end = std::min((slice + 1) * edge, frustum.High) - frustum.Low;
    if (begin > end)
    {
      return;
    }
    int first[2];
    int last[2];
    for (int j = 0; j < 2; ++j)
    {
      const double least =
        frustum.Least[j][0] + std::min(begin * this->LeastSlope[j], end * this->LeastSlope[j]);
      const double most =
        frustum.Most[j][0] + std::max(begin * this->MostSlope[j], end * this->MostSlope[j]);
      const int across = j == 0 ? BlockMask::U[axis] : BlockMask::V[axis];
      const int count = level.Size[static_cast<std::size_t>(across)] * BlockMask::Edge;
      if (!(most >= 0.0 && least < count * edge))
      {
        return;
      }
      first[j] = static_cast<int>(std::max(least, 0.0) / edge);
      last[j] = static_cast<int>(std::min(most, (count - 0.5) * edge) / edge);
    }
    for (int i = 0; i < blocks.Count; ++i)
    {
      const int fromU = std::max(first[0] - blocks.U[i] * BlockMask::Edge, 0);
      const int toU = std::min(last[0] - blocks.U[i] * BlockMask::Edge, BlockMask::Edge - 1);
      const int fromV = std::max(first[1] - blocks.V[i] * BlockMask::Edge, 0);
      const int toV = std::min(last[1] - blocks.V[i] * BlockMask::Edge, BlockMask::Edge - 1);
      if (fromU > toU || fromV > toV)
      {
        continue;
      }
      Index3 block;
      block[static_cast<std::size_t>(axis)] = slice / BlockMask::Edge;
      block[static_cast<std::size_t>(BlockMask::U[axis])] = blocks.U[i];
      block[static_cast<std::size_t>(BlockMask::V[axis])] = blocks.V[i];
      const std::uint64_t columns = (0xFFU << fromU & 0xFFU & 0xFFU >> (7 - toU));
      const std::uint64_t rows =
        (~std::uint64_t{ 0 } << (8 * fromV)) & (~std::uint64_t{ 0 } >> (8 * (7 - toV)));
      std::uint64_t active = level.GetMask(block).Slices[axis][slice % BlockMask::Edge] & rows &
        (columns * 0x0101010101010101U);
      for (; active != 0; active &= active - 1)
      {
        const int bit = __builtin_ctzll(active);
        members.Add(
          blocks.U[i] * BlockMask::Edge + bit % 8, blocks.V[i] * BlockMask::Edge + bit / 8);
      }
    }
  }

  const BlockTree& Tree;
  const Frustum& TheFrustum;
  double LeastSlope[2];
  double MostSlope[2];
};

}

#endif
