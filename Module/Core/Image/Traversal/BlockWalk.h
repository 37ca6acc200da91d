// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BlockWalk_h
#define BlockWalk_h

#include "Image/Macrocells/BlockTree.h"
#include "Kernels/Kernels.h"
#include "Math/Compiler.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Takes each ray of a frustum by itself through a tree of blocks, to the active macrocells that it
/// may pass: in rounds, in each of which every ray comes to one of them. Where few rays meet in a
/// macrocell this is faster than FrustumTraversal. What is near mostly comes first, but a ray may
/// come to one slice of macrocells and then to one before it.
class BlockWalk
{
public:
  /// A ray that comes to a block of some level; to a macrocell.
  struct Step
  {
    int Ray;
    Index3 Block;
  };

  /// All must outlive the walk. Rays that are removed from those that go on end.
  BlockWalk(const Kernels& kernels, const BlockTree& tree, const AlignedRays& aligned,
    const Frustum& frustum, const RaySet& going)
    : TheKernels(kernels)
    , Levels(tree.GetLevels())
    , Aligned(aligned)
    , Axis(frustum.Axis)
    , IsUp(frustum.IsUp)
    , Going(going)
  {
    this->Reached.fill(std::numeric_limits<int>::min());
    this->Last.fill(std::numeric_limits<int>::max());
  }

  /// Calls visit(steps, count) for each round.
  template <typename Visit>
  void ForEachRound(const Visit& visit) const
  {
    const std::size_t top = this->Levels.size() - 1;
    const Index3& size = this->Levels[top].Size;
    const auto axis = static_cast<std::size_t>(this->Axis);
    for (int slice = 0; slice < size[axis]; ++slice)
    {
      for (int v = 0; v < size[static_cast<std::size_t>(BlockMask::V[axis])]; ++v)
      {
        for (int u = 0; u < size[static_cast<std::size_t>(BlockMask::U[axis])]; ++u)
        {
          this->EnterTop(this->GetMember(this->IsUp ? slice : size[axis] - 1 - slice, u, v), visit);
        }
      }
    }
  }

  /// To be called with the steps of each round, and with the rays that have ended up to then at
  /// what they have come to: these go on to what may be nearer, and to nothing behind.
  void EndBehind(const RaySet& ended, const Step* steps, int count)
  {
    for (int i = 0; i < count; ++i)
    {
      int& reached = this->Reached[static_cast<std::size_t>(steps[i].Ray)];
      reached = std::max(reached, this->GetDepth(steps[i].Block, 0));
    }
    ForEachRay(ended,
      [this](int ray)
      {
        const auto number = static_cast<std::size_t>(ray);
        this->Last[number] = std::min(this->Last[number], this->Reached[number]);
      });
  }

private:
  /// The members of blocks that rays have still to come to: those of one ray in one block.
  struct MembersLeft
  {
    int Ray[RayPacket::Capacity];
    /// The first member of the block.
    Index3 First[RayPacket::Capacity];
    /// Slices across the axis that have any.
    unsigned int Slices[RayPacket::Capacity];
    std::uint64_t Members[RayPacket::Capacity][BlockMask::Edge];
  };

  /// In a slice across the axis.
  Index3 GetMember(int slice, int u, int v) const
  {
    Index3 member;
    member[static_cast<std::size_t>(this->Axis)] = slice;
    member[static_cast<std::size_t>(BlockMask::U[this->Axis])] = u;
    member[static_cast<std::size_t>(BlockMask::V[this->Axis])] = v;
    return member;
  }

  /// The slice of macrocells, along the rays, that a member at some level begins in.
  int GetDepth(const Index3& member, std::size_t level) const
  {
    const int edge = this->Levels[level].MemberEdge / BlockMask::Edge;
    const int first = member[static_cast<std::size_t>(this->Axis)] * edge;
    return this->IsUp ? first : 1 - first - edge;
  }

  template <typename Visit>
  void EnterTop(const Index3& block, const Visit& visit) const
  {
    Step steps[RayPacket::Capacity];
    int count = 0;
    ForEachRay(this->Going, [&steps, &count, &block](int ray) { steps[count++] = { ray, block }; });
    this->Enter(this->Levels.size() - 1, steps, count, visit);
  }

  /// Goes on with the members of blocks: with one of each ray at a time.
  template <typename Visit>
  void Enter(std::size_t level, const Step* steps, int count, const Visit& visit) const
  {
    MembersLeft members;
    int waiting[RayPacket::Capacity];
    int left = this->FindMembers(this->Levels[level], steps, count, members, waiting);
    while (left > 0)
    {
      Step next[RayPacket::Capacity];
      int going = 0;
      int kept = 0;
      for (int i = 0; i < left; ++i)
      {
        const int number = waiting[i];
        const int ray = members.Ray[number];
        if (!Has(this->Going, ray))
        {
          continue;
        }
        const Index3 member = this->TakeMember(members, number);
        // Those that follow are not nearer.
        if (this->GetDepth(member, level) <= this->Last[static_cast<std::size_t>(ray)])
        {
          next[going++] = { ray, member };
          waiting[kept] = number;
          kept += members.Slices[number] != 0 ? 1 : 0;
        }
      }
      left = kept;
      if (level > 0)
      {
        this->Enter(level - 1, next, going, visit);
      }
      else
      {
        visit(next, going);
      }
    }
  }

  /// Returns the number of rays in blocks that have any.
  int FindMembers(const BlockTree::Level& level, const Step* steps, int count, MembersLeft& members,
    int* waiting) const
  {
    int found = 0;
    for (int i = 0; i < count; ++i)
    {
      const Index3& block = steps[i].Block;
      const int edge = level.MemberEdge * BlockMask::Edge;
      const int first[3] = { block[0] * edge, block[1] * edge, block[2] * edge };
      members.Ray[found] = steps[i].Ray;
      members.First[found] = BlockMask::GetFirstCell(block);
      members.Slices[found] =
        this->TheKernels.FindMembersOfRay(this->Aligned, steps[i].Ray, this->Axis, first,
          level.MemberEdge, level.GetMask(block).Slices[this->Axis], members.Members[found]);
      waiting[found] = found;
      found += members.Slices[found] != 0 ? 1 : 0;
    }
    return found;
  }

  /// The next member of a ray in a block.
  Index3 TakeMember(MembersLeft& members, int number) const
  {
    unsigned int& slices = members.Slices[number];
    const int slice = this->IsUp ? LowestBit(slices) : HighestBit(slices);
    std::uint64_t& inSlice = members.Members[number][slice];
    const int bit = LowestBit(inSlice);
    inSlice &= inSlice - 1;
    slices &= ~(static_cast<unsigned int>(inSlice == 0) << slice);
    Index3 member = this->GetMember(slice, bit % BlockMask::Edge, bit / BlockMask::Edge);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      member[axis] += members.First[number][axis];
    }
    return member;
  }

  const Kernels& TheKernels;
  const std::vector<BlockTree::Level>& Levels;
  const AlignedRays& Aligned;
  int Axis;
  bool IsUp;
  const RaySet& Going;
  /// The largest depths that rays have come to, and those up to which they are needed.
  std::array<int, RayPacket::Capacity> Reached;
  std::array<int, RayPacket::Capacity> Last;
};

}

#endif
