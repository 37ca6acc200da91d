// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Macrocells/BlockMask.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

using Members = std::array<bool, 512>;

const Index3 Edges = { BlockMask::Edge, BlockMask::Edge, BlockMask::Edge };

BlockMask MakeMask(const Members& members)
{
  BlockMask mask;
  std::fill_n(&mask.Slices[0][0], 3 * BlockMask::Edge, 0xDEADBEEFDEADBEEFU);
  for (int z = 0; z < BlockMask::Edge; ++z)
  {
    mask.Slices[2][z] = 0;
    for (int bit = 0; bit < 64; ++bit)
    {
      mask.Slices[2][z] |= std::uint64_t{ members[static_cast<std::size_t>(64 * z + bit)] } << bit;
    }
  }
  mask.CompleteSlices();
  return mask;
}

void CheckMask(const Members& members)
{
  const BlockMask mask = MakeMask(members);
  ASSERT_EQ(mask.IsEmpty(), std::count(members.begin(), members.end(), true) == 0);
  ForEachPlace(Edges,
    [&](const Index3& i)
    {
      const bool expected = members[Offset(i, Edges)];
      ASSERT_EQ(mask.Has(i), expected);
      // Across each axis the other two count bits and bytes, the lower of them bits.
      ASSERT_EQ(mask.Slices[0][i[0]] >> (i[1] + 8 * i[2]) & 1, expected ? 1U : 0U);
      ASSERT_EQ(mask.Slices[1][i[1]] >> (i[0] + 8 * i[2]) & 1, expected ? 1U : 0U);
      ASSERT_EQ(mask.Slices[2][i[2]] >> (i[0] + 8 * i[1]) & 1, expected ? 1U : 0U);
    });
}

//------------------------------------------------------------------------------
TEST(BlockMask, TransverseAxesAreInOrder)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(BlockMask::U[axis], axis == 0 ? 1 : 0);
    EXPECT_EQ(BlockMask::V[axis], axis == 2 ? 1 : 2);
  }
}

//------------------------------------------------------------------------------
TEST(BlockMask, SingleCells)
{
  ASSERT_NO_FATAL_FAILURE(CheckMask({}));
  for (std::size_t i = 0; i < 512; ++i)
  {
    Members members = {};
    members[i] = true;
    ASSERT_NO_FATAL_FAILURE(CheckMask(members));
  }
}

//------------------------------------------------------------------------------
TEST(BlockMask, SlicesAcrossAllAxesHoldTheSameCells)
{
  RandomNumbers random(801);
  for (int i = 0; i < 300; ++i)
  {
    Members members;
    for (bool& member : members)
    {
      member = random.Integer(0, 299) < i;
    }
    ASSERT_NO_FATAL_FAILURE(CheckMask(members));
  }
}

}
}
