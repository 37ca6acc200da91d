// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Whatever the layout, the corners of a cell must be the samples of the user; and only the bricks
// that are read may exist.

#include "Image/Samples/ApronBricks.h"
#include "Image/Samples/TwoLevelBricks.h"
#include "Image/Samples/Unbricked.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

const std::vector<Index3> Sizes = { { 2, 2, 2 }, { 3, 2, 7 }, { 8, 9, 7 }, { 15, 16, 17 },
  { 2, 33, 17 }, { 33, 3, 2 } };

/// Any bits that are a number, with the extremes among them.
template <typename T>
TestVolume<T> RandomVolume(RandomNumbers& random, const Index3& size, int stride)
{
  std::vector<T> samples(Count(size));
  for (T& sample : samples)
  {
    const std::uint64_t bits = random.Bits();
    std::memcpy(&sample, &bits, sizeof(T));
    if (random.Integer(0, 9) == 0 || sample != sample)
    {
      sample =
        random.Integer(0, 1) ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest();
    }
  }
  return TestVolume<T>(size, samples, stride);
}

Index3 CellsOf(const Index3& size)
{
  return { size[0] - 1, size[1] - 1, size[2] - 1 };
}

Index3 CornerOf(const Index3& cell, int corner)
{
  return { cell[0] + corner % 2, cell[1] + corner / 2 % 2, cell[2] + corner / 4 };
}

template <typename T, typename Reader>
bool HasSamplesOf(const TestVolume<T>& volume, Reader& reader, const Index3& cell)
{
  Stored<T> corners[8];
  reader.Load(cell, corners);
  for (int corner = 0; corner < 8; ++corner)
  {
    if (corners[corner] != static_cast<Stored<T>>(volume.At(CornerOf(cell, corner))))
    {
      return false;
    }
  }
  return true;
}

/// Reads all cells, first in order and then at random.
template <typename T, typename Layout>
void ExpectSamples(const TestVolume<T>& volume, Layout& layout, RandomNumbers& random)
{
  const Index3 cells = CellsOf(volume.Dimensions);
  typename Layout::Reader reader(layout);
  ForEachPlace(cells, [&](const Index3& cell) { ASSERT_TRUE(HasSamplesOf(volume, reader, cell)); });
  for (int i = 0; i < 200; ++i)
  {
    const Index3 cell = { random.Integer(0, cells[0] - 1), random.Integer(0, cells[1] - 1),
      random.Integer(0, cells[2] - 1) };
    ASSERT_TRUE(HasSamplesOf(volume, reader, cell));
  }
  ASSERT_EQ(layout.GetNumberOfBricks(), layout.GetMaximumNumberOfBricks());
}

template <typename T>
class VolumeLayoutOf : public testing::Test
{
};

TYPED_TEST_SUITE(VolumeLayoutOf, SampleTypes);

//------------------------------------------------------------------------------
TYPED_TEST(VolumeLayoutOf, ReturnsTheInputSamples)
{
  RandomNumbers random(601);
  std::size_t layouts = 0;
  for (const Index3& size : Sizes)
  {
    for (const int stride : { 1, 3 })
    {
      const auto volume = RandomVolume<TypeParam>(random, size, stride);
      const Samples<TypeParam> samples(volume.View());
      Unbricked<TypeParam> unbricked(samples);
      ASSERT_NO_FATAL_FAILURE(ExpectSamples(volume, unbricked, random));
      for (int brick = 1; brick <= 9; ++brick)
      {
        ApronBricks<TypeParam> apron(samples, brick);
        ASSERT_NO_FATAL_FAILURE(ExpectSamples(volume, apron, random)) << brick;
        TwoLevelBricks<TypeParam> twoLevel(samples, brick, brick % 5 + 1);
        ASSERT_NO_FATAL_FAILURE(ExpectSamples(volume, twoLevel, random)) << brick;
        layouts += 2;
      }
    }
  }
  std::cout << "[ tried    ] " << layouts << " layouts\n";
}

//------------------------------------------------------------------------------
TYPED_TEST(VolumeLayoutOf, ValuesAreExactOrTheNearestDouble)
{
  RandomNumbers random(602);
  constexpr bool isExact = sizeof(TypeParam) < 8 || std::is_floating_point_v<TypeParam>;
  auto volume = RandomVolume<TypeParam>(random, { 20, 20, 20 }, 1);
  volume.Values[0] = std::numeric_limits<TypeParam>::max();
  volume.Values[1] = std::numeric_limits<TypeParam>::lowest();
  ApronBricks<TypeParam> layout(Samples<TypeParam>(volume.View()), 8);
  typename ApronBricks<TypeParam>::Reader reader(layout);
  ForEachPlace({ 19, 19, 19 },
    [&](const Index3& cell)
    {
      Stored<TypeParam> corners[8];
      reader.Load(cell, corners);
      const auto value = static_cast<long double>(volume.At(cell));
      const long double error = std::abs(static_cast<long double>(corners[0]) - value);
      ASSERT_LE(error, isExact ? 0.0L : std::abs(value) * 0x1p-53L);
    });
}

//------------------------------------------------------------------------------
TEST(VolumeLayout, CreatesOnlyTheBricksThatAreRead)
{
  RandomNumbers random(603);
  const Index3 size = { 33, 17, 25 };
  const auto volume = RandomVolume<std::uint16_t>(random, size, 1);
  const Samples<std::uint16_t> samples(volume.View());
  for (const int edge : { 2, 3, 8 })
  {
    ApronBricks<std::uint16_t> apron(samples, edge);
    TwoLevelBricks<std::uint16_t> twoLevel(samples, edge, 2);
    ApronBricks<std::uint16_t>::Reader apronReader(apron);
    TwoLevelBricks<std::uint16_t>::Reader twoLevelReader(twoLevel);
    std::set<Index3> cellBricks;
    std::set<Index3> sampleBricks;
    EXPECT_EQ(apron.GetNumberOfBricks(), 0U);
    EXPECT_EQ(twoLevel.GetNumberOfBricks(), 0U);
    const std::size_t emptyApron = apron.GetMemory();
    const std::size_t emptyTwoLevel = twoLevel.GetMemory();
    for (int i = 0; i < 100; ++i)
    {
      const Index3 cell = { random.Integer(0, 31), random.Integer(0, 15), random.Integer(0, 23) };
      cellBricks.insert({ cell[0] / edge, cell[1] / edge, cell[2] / edge });
      for (int corner = 0; corner < 8; ++corner)
      {
        const Index3 sample = CornerOf(cell, corner);
        sampleBricks.insert({ sample[0] / edge, sample[1] / edge, sample[2] / edge });
      }
      ASSERT_TRUE(HasSamplesOf(volume, apronReader, cell));
      ASSERT_TRUE(HasSamplesOf(volume, twoLevelReader, cell));
      ASSERT_EQ(apron.GetNumberOfBricks(), cellBricks.size());
      ASSERT_EQ(twoLevel.GetNumberOfBricks(), sampleBricks.size());
    }
    EXPECT_EQ(apron.GetMaximumNumberOfBricks(), Count(BlocksCovering(CellsOf(size), edge)));
    EXPECT_EQ(twoLevel.GetMaximumNumberOfBricks(), Count(BlocksCovering(size, edge)));
    const auto volumeOf = [](int n) { return static_cast<std::size_t>(n * n * n); };
    // Bricks of the apron layout begin at cache lines.
    EXPECT_EQ(apron.GetMemory() - emptyApron,
      cellBricks.size() * ((volumeOf(edge + 1) * 2 + 63) / 64 * 64));
    EXPECT_EQ(twoLevel.GetMemory() - emptyTwoLevel, sampleBricks.size() * volumeOf(edge) * 2);
  }
}

//------------------------------------------------------------------------------
/// Bricks form groups, and no two samples have one address.
void CheckAddresses(const Index3& size, int edge, int group)
{
  const TestVolume<std::uint8_t> volume(size, std::vector<std::uint8_t>(Count(size)));
  const TwoLevelBricks<std::uint8_t> layout(Samples<std::uint8_t>(volume.View()), edge, group);
  std::size_t brickVolume = 1;
  std::size_t groupVolume = 1;
  std::size_t all = 1;
  Index3 groupEdges;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int bricks = (size[axis] + edge - 1) / edge;
    const int bricksOfGroup = std::min(group, bricks);
    groupEdges[axis] = bricksOfGroup * edge;
    brickVolume *= static_cast<std::size_t>(edge);
    groupVolume *= static_cast<std::size_t>(groupEdges[axis]);
    all *=
      static_cast<std::size_t>((bricks + bricksOfGroup - 1) / bricksOfGroup * groupEdges[axis]);
  }
  std::set<std::size_t> used;
  ForEachPlace(size,
    [&](const Index3& i)
    {
      const std::size_t address = layout.GetAddress(i);
      const Index3 firstOfBrick = { i[0] / edge * edge, i[1] / edge * edge, i[2] / edge * edge };
      Index3 firstOfGroup;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        firstOfGroup[axis] = i[axis] / groupEdges[axis] * groupEdges[axis];
      }
      ASSERT_LT(address, all);
      ASSERT_EQ(address / brickVolume, layout.GetAddress(firstOfBrick) / brickVolume);
      ASSERT_EQ(address / groupVolume, layout.GetAddress(firstOfGroup) / groupVolume);
      ASSERT_TRUE(used.insert(address).second);
    });
}

TEST(VolumeLayout, AddressesAreUnique)
{
  std::size_t layouts = 0;
  for (const Index3& size : Sizes)
  {
    for (int edge = 1; edge <= 9; ++edge)
    {
      for (int group = 1; group <= 5; ++group)
      {
        ASSERT_NO_FATAL_FAILURE(CheckAddresses(size, edge, group));
        ++layouts;
      }
    }
  }
  std::cout << "[ tried    ] " << layouts << " layouts\n";
}

//------------------------------------------------------------------------------
/// Reads cells at random, always the same ones. Returns how many had other samples than the volume.
template <typename Layout, typename T>
std::size_t CountWrongCells(const TestVolume<T>& volume, Layout& layout)
{
  RandomNumbers random(604);
  const Index3 cells = CellsOf(volume.Dimensions);
  typename Layout::Reader reader(layout);
  std::size_t wrong = 0;
  for (int i = 0; i < 3000; ++i)
  {
    const Index3 cell = { random.Integer(0, cells[0] - 1), random.Integer(0, cells[1] - 1),
      random.Integer(0, cells[2] - 1) };
    wrong += HasSamplesOf(volume, reader, cell) ? 0 : 1;
  }
  return wrong;
}

/// Many threads read the same cells at once: all get the right values, and no brick counts twice.
template <typename Layout, typename T>
void ReadByManyThreads(const TestVolume<T>& volume, Layout& layout, Layout& readByOne)
{
  std::size_t wrong = CountWrongCells(volume, readByOne);
#pragma omp parallel num_threads(8) reduction(+ : wrong)
  {
    wrong += CountWrongCells(volume, layout);
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(layout.GetNumberOfBricks(), readByOne.GetNumberOfBricks());
  EXPECT_GE(layout.GetNumberOfBricks(), 100U);
}

TEST(VolumeLayout, ConcurrentReads)
{
  RandomNumbers random(605);
  const auto volume = RandomVolume<std::int32_t>(random, { 33, 34, 35 }, 1);
  const Samples<std::int32_t> samples(volume.View());
  for (int i = 0; i < 5; ++i)
  {
    ApronBricks<std::int32_t> apron(samples, 8);
    ApronBricks<std::int32_t> apronOfOne(samples, 8);
    ReadByManyThreads(volume, apron, apronOfOne);
    TwoLevelBricks<std::int32_t> twoLevel(samples, 8, 2);
    TwoLevelBricks<std::int32_t> twoLevelOfOne(samples, 8, 2);
    ReadByManyThreads(volume, twoLevel, twoLevelOfOne);
  }
}

}
}
