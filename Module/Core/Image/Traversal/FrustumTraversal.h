// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FrustumTraversal_h
#define FrustumTraversal_h

#include "Image/Lattice/UnevenPlanes.h"
#include "Image/Macrocells/BlockTree.h"
#include "Kernels/Kernels.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Traverses a tree of blocks with a frustum of rays, slice by slice across its axis, to the active
/// macrocells it may pass. Those of one slice come together, in no order; everything that a ray
/// meets in a later slice is behind everything it meets in an earlier one.
class FrustumTraversal
{
public:
  /// Members of a slice. Between even planes there are never more than have room without
  /// allocating memory, which would be slow for each slice.
  class Members
  {
  public:
    int GetCount() const { return this->Count; }

    const Index3& Get(int i) const
    {
      const auto number = static_cast<std::size_t>(i);
      return number < Room ? this->First[number] : this->Others[number - Room];
    }

    void Add(const Index3& member)
    {
      const auto number = static_cast<std::size_t>(this->Count++);
      if (number < Room)
      {
        this->First[number] = member;
      }
      else
      {
        this->Others.push_back(member);
      }
    }

  private:
    static constexpr std::size_t Room = 256;

    int Count = 0;
    std::array<Index3, Room> First;
    std::vector<Index3> Others;
  };

  /// The maximum width of a frustum, in cells (uneven: of mean size).
  static constexpr double LargestWidth = 400.0;

  /// Planes are null where they stand at whole numbers. All must outlive the traversal.
  FrustumTraversal(const BlockTree& tree, const UnevenPlanes* planes, const Frustum& frustum)
    : Tree(tree)
    , Planes(planes)
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

  /// Calls visit(macrocells) for the macrocells of every slice that has any, until visit returns
  /// true.
  template <typename Visit>
  void ForEachSlice(const Visit& visit) const
  {
    const std::size_t top = this->Tree.GetLevels().size() - 1;
    const Index3& size = this->Tree.GetLevels()[top].Size;
    const auto axis = static_cast<std::size_t>(this->TheFrustum.Axis);
    Members all;
    for (int v = 0; v < size[static_cast<std::size_t>(BlockMask::V[axis])]; ++v)
    {
      for (int u = 0; u < size[static_cast<std::size_t>(BlockMask::U[axis])]; ++u)
      {
        all.Add(this->GetMember(0, u, v));
      }
    }
    this->ForEachMember(
      0, size[axis], [&](int block) { return this->EnterBlocks(top, block, all, visit); });
  }

private:
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
    if (this->Planes)
    {
      this->FindMembers<true>(level, slice, blocks, members);
    }
    else
    {
      this->FindMembers<false>(level, slice, blocks, members);
    }
    if (members.GetCount() == 0)
    {
      return false;
    }
    return level > 0 ? this->EnterBlocks(level - 1, slice, members, visit) : visit(members);
  }

  /// In a slice across the axis.
  Index3 GetMember(int slice, int u, int v) const
  {
    const int axis = this->TheFrustum.Axis;
    Index3 member;
    member[static_cast<std::size_t>(axis)] = slice;
    member[static_cast<std::size_t>(BlockMask::U[axis])] = u;
    member[static_cast<std::size_t>(BlockMask::V[axis])] = v;
    return member;
  }

  template <bool AreUneven>
  double GetPlane(int axis, int plane) const
  {
    return AreUneven ? this->Planes->Get(static_cast<std::size_t>(axis), plane) : plane;
  }

  /// The member of a level that has a coordinate, which is in the volume.
  template <bool AreUneven>
  int FindMember(int axis, double coordinate, std::size_t level) const
  {
    static_assert(BlockMask::Edge == 1 << 3);
    return AreUneven ? this->Planes->FindBlock(static_cast<std::size_t>(axis), coordinate,
                         3 * (static_cast<int>(level) + 1))
                     : static_cast<int>(coordinate / this->Tree.GetLevels()[level].MemberEdge);
  }

  template <bool AreUneven>
  void FindMembers(
    std::size_t levelNumber, int slice, const Members& blocks, Members& members) const
  {
    const BlockTree::Level& level = this->Tree.GetLevels()[levelNumber];
    const Frustum& frustum = this->TheFrustum;
    const int axis = frustum.Axis;
    const int edge = level.MemberEdge;
    const double begin =
      std::max(this->GetPlane<AreUneven>(axis, slice * edge), frustum.Low) - frustum.Low;
    const double end =
      std::min(this->GetPlane<AreUneven>(axis, (slice + 1) * edge), frustum.High) - frustum.Low;
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
      first[j] = this->FindMember<AreUneven>(across, std::max(least, 0.0), levelNumber);
      last[j] =
        this->FindMember<AreUneven>(across, std::min(most, (count - 0.5) * edge), levelNumber);
    }
    const int u = BlockMask::U[axis];
    const int v = BlockMask::V[axis];
    for (int i = 0; i < blocks.GetCount(); ++i)
    {
      Index3 block = blocks.Get(i);
      block[static_cast<std::size_t>(axis)] = slice / BlockMask::Edge;
      const int firstU = block[static_cast<std::size_t>(u)] * BlockMask::Edge;
      const int firstV = block[static_cast<std::size_t>(v)] * BlockMask::Edge;
      const int fromU = std::max(first[0] - firstU, 0);
      const int toU = std::min(last[0] - firstU, BlockMask::Edge - 1);
      const int fromV = std::max(first[1] - firstV, 0);
      const int toV = std::min(last[1] - firstV, BlockMask::Edge - 1);
      if (fromU > toU || fromV > toV)
      {
        continue;
      }
      const std::uint64_t columns = (0xFFU << fromU & 0xFFU & 0xFFU >> (7 - toU));
      const std::uint64_t rows =
        (~std::uint64_t{ 0 } << (8 * fromV)) & (~std::uint64_t{ 0 } >> (8 * (7 - toV)));
      std::uint64_t active = level.GetMask(block).Slices[axis][slice % BlockMask::Edge] & rows &
        (columns * 0x0101010101010101U);
      for (; active != 0; active &= active - 1)
      {
        const int bit = LowestBit(active);
        members.Add(this->GetMember(slice, firstU + bit % 8, firstV + bit / 8));
      }
    }
  }

  const BlockTree& Tree;
  const UnevenPlanes* Planes;
  const Frustum& TheFrustum;
  double LeastSlope[2];
  double MostSlope[2];
};

}

#endif
