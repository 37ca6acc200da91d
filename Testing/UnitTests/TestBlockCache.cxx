// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The memory of bricks and masks: what is kept, what is evicted, and that pictures do not depend on
// it.

#include "Image/ImageField.h"
#include "Image/Lattice/Ray.h"
#include "Image/Samples/BlockCache.h"
#include "RandomNumbers.h"
#include "TestRequest.h"
#include "TestVolume.h"
#include "TraceLine.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <vector>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr std::size_t Unlimited = std::numeric_limits<std::size_t>::max();
constexpr std::size_t SlotSize = 64;

/// A cache whose blocks hold their number, and how often one was made.
class NumberedBlocks
{
public:
  explicit NumberedBlocks(std::size_t blocks)
    : Cache(blocks, SlotSize)
  {
  }

  /// Whether a block is there, or was made now, and has the right contents.
  bool Has(std::size_t block)
  {
    const void* slot = this->Cache.Get(block,
      [this, block](void* memory)
      {
        *static_cast<std::size_t*>(memory) = block;
        ++this->Made;
      });
    if (slot)
    {
      EXPECT_EQ(*static_cast<const std::size_t*>(slot), block);
    }
    return slot != nullptr;
  }

  BlockCache Cache;
  int Made = 0;
};

//------------------------------------------------------------------------------
TEST(BlockCache, CreatesABlockOnce)
{
  NumberedBlocks blocks(100000);
  blocks.Cache.BeginFrame(Unlimited);
  const std::size_t empty = blocks.Cache.GetMemory();
  for (int round = 0; round < 2; ++round)
  {
    for (std::size_t block = 0; block < 100000; block += 9)
    {
      ASSERT_TRUE(blocks.Has(block));
    }
  }
  EXPECT_EQ(blocks.Made, 11112);
  EXPECT_EQ(blocks.Cache.GetNumberOfBlocks(), 11112U);
  EXPECT_EQ(blocks.Cache.GetMemory() - empty, 11112U * SlotSize);
}

//------------------------------------------------------------------------------
TEST(BlockCache, IsEmptyAfterClear)
{
  NumberedBlocks blocks(10);
  blocks.Cache.BeginFrame(Unlimited);
  EXPECT_TRUE(blocks.Has(3) && blocks.Has(4));
  blocks.Cache.Clear();
  EXPECT_EQ(blocks.Cache.GetNumberOfBlocks(), 0U);
  EXPECT_TRUE(blocks.Has(4));
  EXPECT_EQ(blocks.Made, 3);
}

//------------------------------------------------------------------------------
TEST(BlockCache, EvictsBlocksThatTheLastFrameDidNotUse)
{
  NumberedBlocks blocks(100);
  const auto beginFrame = [&blocks] { blocks.Cache.BeginFrame(10 * SlotSize + 1); };
  beginFrame();
  for (std::size_t block = 0; block < 10; ++block)
  {
    EXPECT_TRUE(blocks.Has(block));
  }
  EXPECT_FALSE(blocks.Has(10)); // no room within the frame
  EXPECT_TRUE(blocks.Has(0));   // what is there stays

  // All were used, so there is still no room.
  beginFrame();
  EXPECT_FALSE(blocks.Has(11));
  EXPECT_TRUE(blocks.Has(7) && blocks.Has(8));

  // Now eight are evicted.
  beginFrame();
  EXPECT_EQ(blocks.Cache.GetNumberOfBlocks(), 2U);
  blocks.Made = 0;
  for (std::size_t block = 20; block < 28; ++block)
  {
    EXPECT_TRUE(blocks.Has(block));
  }
  EXPECT_TRUE(blocks.Has(7) && blocks.Has(8));
  EXPECT_EQ(blocks.Made, 8);
  EXPECT_FALSE(blocks.Has(0));

  // As long as there is room for all, nothing is evicted.
  NumberedBlocks few(100);
  for (std::size_t frame = 0; frame < 5; ++frame)
  {
    few.Cache.BeginFrame(10 * SlotSize);
    EXPECT_TRUE(few.Has(frame));
  }
  EXPECT_EQ(few.Cache.GetNumberOfBlocks(), 5U);
}

//------------------------------------------------------------------------------
TEST(BlockCache, LowerLimitTakesEffectAtOnce)
{
  NumberedBlocks blocks(20000);
  blocks.Cache.BeginFrame(Unlimited);
  for (std::size_t block = 0; block < 20000; ++block)
  {
    ASSERT_TRUE(blocks.Has(block));
  }
  for (const std::size_t ceiling : { 9000U, 5000U, 1U, 0U })
  {
    blocks.Cache.BeginFrame(ceiling * SlotSize);
    EXPECT_LE(blocks.Cache.GetNumberOfBlocks(), ceiling);
    std::size_t there = 0;
    for (std::size_t block = 0; block < 20000; ++block)
    {
      there += blocks.Has(block) ? 1U : 0U;
    }
    EXPECT_EQ(there, ceiling);
  }
  blocks.Cache.BeginFrame(Unlimited);
  for (std::size_t block = 0; block < 20000; ++block)
  {
    ASSERT_TRUE(blocks.Has(block));
  }
}

//------------------------------------------------------------------------------
TEST(BlockCache, DoesNotChangeHits)
{
  RandomNumbers random(1301);
  const auto volume = TestVolume<float>::Of(
    { 70, 50, 60 }, [&random](const AnalyticFields::Point&) { return random.Uniform(-1.0, 1.0); });
  const auto unlimited = ImageField::New(volume.View(), {}, 2);
  const auto limited = ImageField::New(volume.View(), {}, 2);
  TestRequest request;
  request.Surfaces = { { 0.9, 1.0 } };
  const std::size_t ceilings[] = { 0, 20000, 100000, 100000, 300000, 40000, Unlimited };
  for (const std::size_t ceiling : ceilings)
  {
    std::vector<std::optional<Ray>> rays;
    for (int i = 0; i < 1000; ++i)
    {
      const Vector3 origin = { random.Uniform(0.0, 69.0), random.Uniform(0.0, 49.0), -5.0 };
      const Vector3 direction = { random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), 1.0 };
      rays.push_back(ClipToVolume(origin, direction, 0.0, 100.0, { 70, 50, 60 }));
    }
    request.Budget.CacheBytes = Unlimited;
    Select(*unlimited, request, 2);
    request.Budget.CacheBytes = ceiling;
    Select(*limited, request, 2);
    RayHits expected;
    RayHits hits;
    Trace(*unlimited, rays, expected);
    Trace(*limited, rays, hits);
    ASSERT_EQ(hits.First, expected.First);
    for (std::size_t i = 0; i < hits.Hits.size(); ++i)
    {
      ASSERT_EQ(hits.Hits[i].T, expected.Hits[i].T);
      ASSERT_EQ(hits.Hits[i].Cell, expected.Hits[i].Cell);
      ASSERT_EQ(hits.Hits[i].Parametric, expected.Hits[i].Parametric);
    }
    // Beside the bricks there are two tables of two numbers for each of the 9 x 7 x 8 blocks.
    const std::size_t tables = 9 * 7 * 8 * 16;
    EXPECT_LE(
      limited->GetStatistics().CacheMemory, ceiling == Unlimited ? Unlimited : ceiling + tables);
  }
}

}
}
