// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of all levels are compared with those found by looking at every macrocell.

#include "Image/Macrocells/BlockTree.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <cstddef>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Macrocells of 8^3 cells; of the last ones there is only one layer of cells.
ActiveMacrocells MakeActive(const Index3& macrocells, const std::vector<bool>& isActive)
{
  ActiveMacrocells active(MacrocellLattice(
    { 8 * macrocells[0] - 6, 8 * macrocells[1] - 6, 8 * macrocells[2] - 6 }, { 8, 8 }));
  EXPECT_EQ(active.GetLattice().Levels[0].Size, macrocells);
  active.Fill(0, 1, [&isActive](std::size_t i) { return isActive[i]; });
  return active;
}

void CheckTree(const Index3& macrocells, const std::vector<bool>& isActive, int threads)
{
  const BlockTree tree(MakeActive(macrocells, isActive), threads);
  std::set<Index3> members;
  ForEachPlace(macrocells,
    [&](const Index3& i)
    {
      if (isActive[Offset(i, macrocells)])
      {
        members.insert(i);
      }
    });
  Index3 size = macrocells;
  int edge = 1;
  ASSERT_FALSE(tree.GetLevels().empty());
  for (const BlockTree::Level& level : tree.GetLevels())
  {
    edge *= 8;
    ASSERT_EQ(level.MemberEdge, edge);
    size = { (size[0] + 7) / 8, (size[1] + 7) / 8, (size[2] + 7) / 8 };
    ASSERT_EQ(level.Size, size);
    ASSERT_EQ(level.Masks.size(), Count(size));
    std::set<Index3> blocks;
    ForEachPlace({ 8 * size[0], 8 * size[1], 8 * size[2] },
      [&](const Index3& i)
      {
        const Index3 block = { i[0] / 8, i[1] / 8, i[2] / 8 };
        const Index3 member = { i[0] % 8, i[1] % 8, i[2] % 8 };
        const bool expected = members.count(i) != 0;
        ASSERT_EQ(level.GetMask(block).Has(member), expected);
        for (int axis = 0; axis < 3; ++axis)
        {
          const auto coordinate = [&](int a) { return member[static_cast<std::size_t>(a)]; };
          const std::uint64_t slice = level.GetMask(block).Slices[axis][coordinate(axis)];
          const int bit = coordinate(BlockMask::U[axis]) + 8 * coordinate(BlockMask::V[axis]);
          ASSERT_EQ(slice >> bit & 1, expected ? 1U : 0U);
        }
        if (expected)
        {
          blocks.insert(block);
        }
      });
    // The tree ends where a level is small, and not before.
    ASSERT_EQ(Count(size) <= 8, &level == &tree.GetLevels().back());
    members = blocks;
  }
}

//------------------------------------------------------------------------------
TEST(BlockTree, HoldsActiveMacrocellsAndTheirAncestors)
{
  RandomNumbers random(811);
  const std::vector<Index3> sizes = { { 1, 1, 1 }, { 2, 1, 3 }, { 7, 8, 9 }, { 10, 15, 16 },
    { 17, 18, 1 }, { 31, 2, 26 }, { 64, 9, 2 }, { 65, 2, 3 }, { 2, 66, 10 }, { 1, 17, 63 },
    { 33, 33, 34 }, { 513, 1, 9 }, { 3, 1, 600 } };
  std::size_t largest = 0;
  for (const Index3& size : sizes)
  {
    std::vector<bool> isActive(Count(size));
    for (const int percent : { 0, 1, 10, 50, 100 })
    {
      for (std::size_t i = 0; i < isActive.size(); ++i)
      {
        isActive[i] = random.Integer(1, 100) <= percent;
      }
      if (percent == 1)
      {
        isActive.back() = true;
      }
      for (const int threads : { 1, 2 })
      {
        ASSERT_NO_FATAL_FAILURE(CheckTree(size, isActive, threads))
          << size[0] << " x " << size[1] << " x " << size[2] << ", " << percent << " %";
      }
    }
    largest = std::max(largest, BlockTree(MakeActive(size, isActive), 2).GetLevels().size());
  }
  EXPECT_EQ(largest, 3U);
}

//------------------------------------------------------------------------------
TEST(BlockTree, DepthFollowsTheNumberOfMacrocells)
{
  const auto depthOf = [](const Index3& size) {
    return BlockTree(MakeActive(size, std::vector<bool>(Count(size), true)), 1).GetLevels().size();
  };
  EXPECT_EQ(depthOf({ 64, 1, 1 }), 1U);
  EXPECT_EQ(depthOf({ 65, 1, 1 }), 2U);
  EXPECT_EQ(depthOf({ 16, 16, 16 }), 1U);
  EXPECT_EQ(depthOf({ 17, 16, 16 }), 2U);
  EXPECT_EQ(depthOf({ 512, 1, 1 }), 2U);
  EXPECT_EQ(depthOf({ 513, 1, 1 }), 3U);
}

}
}
