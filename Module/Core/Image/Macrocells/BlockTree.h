// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BlockTree_h
#define BlockTree_h

#include "Image/Macrocells/ActiveMacrocells.h"
#include "Image/Macrocells/BlockMask.h"
#include "Math/ThreadsOfLoop.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The active macrocells of 8^3 cells, in blocks of 8^3, these in blocks of 8^3, and so on to a
/// level that is small. A frustum of rays reads a whole slice of a block at once.
class BlockTree
{
public:
  /// A level of blocks: each with a mask of its members on the level below, or of macrocells.
  struct Level
  {
    Index3 Size;
    /// The edge of a member, in cells.
    int MemberEdge;
    std::vector<BlockMask> Masks;

    const BlockMask& GetMask(const Index3& block) const
    {
      return this->Masks[Offset(block, this->Size)];
    }
  };

  BlockTree() = default;

  /// Copies the bits of the finest macrocells, which must have an edge of 8.
  BlockTree(const ActiveMacrocells& active, int threads);

  /// Finest first.
  const std::vector<Level>& GetLevels() const { return this->Levels; }

private:
  template <typename GetRow>
  void AddLevel(const Index3& memberCount, int threads, const GetRow& getRow);

  std::vector<Level> Levels;
};

//------------------------------------------------------------------------------
inline BlockTree::BlockTree(const ActiveMacrocells& active, int threads)
{
  this->AddLevel(active.GetLattice().Levels[0].Size, threads,
    [&active](const Index3& first) { return active.GetRow(first); });
  while (Count(this->Levels.back().Size) > 8)
  {
    const std::size_t below = this->Levels.size() - 1;
    this->AddLevel(this->Levels[below].Size, threads,
      [this, below](const Index3& first)
      {
        const Level& level = this->Levels[below];
        std::uint64_t row = 0;
        for (int x = 0; x < BlockMask::Edge && first[0] + x < level.Size[0]; ++x)
        {
          const bool isActive = !level.GetMask({ first[0] + x, first[1], first[2] }).IsEmpty();
          row |= static_cast<std::uint64_t>(isActive) << x;
        }
        return row;
      });
  }
}

//------------------------------------------------------------------------------
// getRow(first) gives the bits of the eight members from first on along x, or as many as there are.
template <typename GetRow>
void BlockTree::AddLevel(const Index3& memberCount, int threads, const GetRow& getRow)
{
  Level level;
  level.Size = BlocksCovering(memberCount, BlockMask::Edge);
  level.MemberEdge =
    this->Levels.empty() ? BlockMask::Edge : this->Levels.back().MemberEdge * BlockMask::Edge;
  level.Masks.resize(Count(level.Size));
  const auto count = static_cast<std::int64_t>(level.Masks.size());
  const int worth = GetThreadsOfLoop(level.Masks.size(), 200.0, threads);
#pragma omp parallel for schedule(static) num_threads(worth)
  for (std::int64_t i = 0; i < count; ++i)
  {
    const auto block = static_cast<int>(i);
    const Index3 first = { block % level.Size[0] * BlockMask::Edge,
      block / level.Size[0] % level.Size[1] * BlockMask::Edge,
      block / level.Size[0] / level.Size[1] * BlockMask::Edge };
    BlockMask& mask = level.Masks[static_cast<std::size_t>(i)];
    for (int z = 0; z < BlockMask::Edge; ++z)
    {
      std::uint64_t word = 0;
      for (int y = 0; y < BlockMask::Edge; ++y)
      {
        const Index3 position = { first[0], first[1] + y, first[2] + z };
        if (position[1] < memberCount[1] && position[2] < memberCount[2])
        {
          word |= getRow(position) << (BlockMask::Edge * y);
        }
      }
      mask.Slices[2][z] = word;
    }
    mask.CompleteSlices();
  }
  this->Levels.push_back(std::move(level));
}

}

#endif
