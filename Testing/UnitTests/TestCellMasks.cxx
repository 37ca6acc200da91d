// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The masks are compared, cell by cell, with the rule they follow.

#include "Image/Macrocells/CellMasks.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

const std::vector<Index3> Sizes = { { 2, 2, 2 }, { 9, 9, 9 }, { 10, 8, 17 }, { 18, 10, 3 },
  { 2, 33, 11 } };

/// Mostly one value, so that there are cells without a surface; others that test the rule.
template <typename T>
TestVolume<T> NewVolume(RandomNumbers& random, const Index3& size, int stride)
{
  std::vector<T> rare = { std::numeric_limits<T>::max(), std::numeric_limits<T>::lowest() };
  for (const int value : { 0, 1, 49, 50, 51, 100 })
  {
    rare.push_back(static_cast<T>(value));
  }
  if constexpr (std::is_signed_v<T>)
  {
    rare.insert(rare.end(), { static_cast<T>(-1), static_cast<T>(-3), static_cast<T>(-4) });
  }
  if constexpr (sizeof(T) == 8)
  {
    // Beside each other as integers, not all as doubles.
    rare.insert(rare.end(), { static_cast<T>(9007199254740991), static_cast<T>(9007199254740993) });
    rare.push_back(static_cast<T>(std::numeric_limits<T>::max() - 1));
  }
  if constexpr (std::is_floating_point_v<T>)
  {
    const T infinity = std::numeric_limits<T>::infinity();
    rare.insert(rare.end(), { std::numeric_limits<T>::quiet_NaN(), infinity, -infinity });
    rare.insert(rare.end(), { std::numeric_limits<T>::denorm_min(), static_cast<T>(-0.0) });
    rare.insert(rare.end(), { static_cast<T>(49.5), std::nextafter(static_cast<T>(0.1), T{}) });
    rare.insert(rare.end(), { static_cast<T>(0.1), std::nextafter(static_cast<T>(50), infinity) });
  }
  const T common = rare[random.Bits() % rare.size()];
  std::vector<T> samples(Count(size), common);
  for (T& sample : samples)
  {
    sample = random.Integer(0, 19) == 0 ? rare[random.Bits() % rare.size()] : sample;
  }
  return TestVolume<T>(size, samples, stride);
}

/// Equal to samples, between them, beyond all of them; one and several.
std::vector<std::vector<double>> IsovaluesToTry()
{
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> sets;
  for (const double isovalue : { 0.0, -0.0, 0.5, 1.0, 50.0, std::nextafter(50.0, 49.0),
         std::nextafter(50.0, 51.0), 49.5, 99.7, -0.5, -3.0, -3.25, 0.1, 127.0, 127.5, 128.0,
         -128.0, 255.0, 255.5, 300.0, -300.0, 32767.5, 65535.0, 70000.0, 2147483647.0, 4294967295.0,
         5e9, -5e9, 0x1p53, 0x1p53 + 2.0, 0x1p62, 0x1p63, -0x1p63, 0x1p64, 1e30, -1e30, 1e300,
         -1e300, 5e-324, -5e-324, infinity, -infinity, std::nan("") })
  {
    sets.push_back({ isovalue });
  }
  sets.push_back({ -3.25, 49.5, 50.0 });
  sets.push_back({ 0.5, 300.0 });
  sets.push_back({ -1e300, 1.0, 1e300 });
  sets.push_back({});
  return sets;
}

/// The rule: a surface passes where some corner < isovalue <= some corner, and all are finite.
template <typename T>
bool HasSurface(
  const TestVolume<T>& volume, const Index3& cell, const std::vector<double>& isovalues)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int i = 0; i < 8; ++i)
  {
    const auto value = static_cast<double>(
      volume.At({ cell[0] + (i & 1), cell[1] + (i >> 1 & 1), cell[2] + (i >> 2) }));
    if (!std::isfinite(value))
    {
      return false;
    }
    low = std::min(low, value);
    high = std::max(high, value);
  }
  return std::any_of(isovalues.begin(), isovalues.end(),
    [low, high](double isovalue) { return low < isovalue && isovalue <= high; });
}

struct MaskCounts
{
  std::size_t Cells = 0;
  std::size_t Surfaces = 0;
};

template <typename T>
void CheckMask(const TestVolume<T>& volume, const std::vector<double>& isovalues,
  const Index3& block, const BlockMask& mask, MaskCounts& counts)
{
  ForEachPlace({ 8, 8, 8 },
    [&](const Index3& i)
    {
      const Index3 cell = { 8 * block[0] + i[0], 8 * block[1] + i[1], 8 * block[2] + i[2] };
      const Index3& size = volume.Dimensions;
      const bool isInVolume =
        cell[0] < size[0] - 1 && cell[1] < size[1] - 1 && cell[2] < size[2] - 1;
      const bool expected = isInVolume && HasSurface(volume, cell, isovalues);
      ASSERT_EQ(mask.Has(i), expected) << "cell " << cell[0] << ", " << cell[1] << ", " << cell[2]
                                       << ", isovalue " << (isovalues.empty() ? 0.0 : isovalues[0]);
      ASSERT_EQ((mask.Slices[0][i[0]] >> (i[1] + 8 * i[2]) & 1) != 0, expected);
      ASSERT_EQ((mask.Slices[1][i[1]] >> (i[0] + 8 * i[2]) & 1) != 0, expected);
      counts.Cells += isInVolume ? 1 : 0;
      counts.Surfaces += expected ? 1 : 0;
    });
}

template <typename T>
void CheckMasks(const TestVolume<T>& volume, const std::vector<double>& isovalues,
  CellMasks<T>& masks, MaskCounts& counts)
{
  const Index3& size = volume.Dimensions;
  ForEachPlace(BlocksCovering({ size[0] - 1, size[1] - 1, size[2] - 1 }, 8),
    [&](const Index3& block)
    {
      BlockMask own;
      CheckMask(volume, isovalues, block, masks.Get(block, own), counts);
    });
}

template <typename T>
class CellMasksOf : public testing::Test
{
};

TYPED_TEST_SUITE(CellMasksOf, SampleTypes);

//------------------------------------------------------------------------------
// One object makes the masks for all isovalues in turn: it must discard the old ones.
TYPED_TEST(CellMasksOf, MarkTheCellsThatASurfaceIntersects)
{
  using T = TypeParam;
  RandomNumbers random(821);
  MaskCounts counts;
  for (const int stride : { 1, 3 })
  {
    for (const Index3& size : Sizes)
    {
      for (int repeat = 0; repeat < 3; ++repeat)
      {
        const auto volume = NewVolume<T>(random, size, stride);
        CellMasks<T> masks{ Samples<T>(volume.View()) };
        for (const std::vector<double>& isovalues : IsovaluesToTry())
        {
          masks.Select(isovalues);
          // The second time they are kept.
          ASSERT_NO_FATAL_FAILURE(CheckMasks(volume, isovalues, masks, counts));
          ASSERT_NO_FATAL_FAILURE(CheckMasks(volume, isovalues, masks, counts));
        }
      }
    }
  }
  std::cout << "[ tried    ] " << counts.Cells << " cells, " << counts.Surfaces
            << " with a surface\n";
  EXPECT_GT(counts.Surfaces, counts.Cells / 50);
  EXPECT_LT(counts.Surfaces, counts.Cells / 2);
}

//------------------------------------------------------------------------------
// All threads go through the same blocks at the same time.
TYPED_TEST(CellMasksOf, IdenticalForAllThreads)
{
  using T = TypeParam;
  RandomNumbers random(822);
  const Index3 size = { 34, 35, 36 };
  const auto volume = NewVolume<T>(random, size, 1);
  CellMasks<T> masks{ Samples<T>(volume.View()) };
  const std::vector<double> isovalues = { 1.0, 49.5 };
  for (int repeat = 0; repeat < 5; ++repeat)
  {
    masks.Select(isovalues);
    std::size_t failures = 0;
#pragma omp parallel num_threads(2) reduction(+ : failures)
    {
      MaskCounts counts;
      CheckMasks(volume, isovalues, masks, counts);
      failures += counts.Cells == Count({ 33, 34, 35 }) ? 0 : 1;
    }
    EXPECT_EQ(failures, 0U);
    ASSERT_FALSE(this->HasFailure());
  }
}

//------------------------------------------------------------------------------
// Where there is no memory to keep them, they are made each time.
TYPED_TEST(CellMasksOf, IdenticalWithLittleMemory)
{
  using T = TypeParam;
  RandomNumbers random(823);
  const auto volume = NewVolume<T>(random, { 18, 26, 20 }, 1);
  const std::vector<double> isovalues = { 1.0, 49.5 };
  for (const std::size_t kept : { 0, 1, 7 })
  {
    CellMasks<T> masks{ Samples<T>(volume.View()) };
    masks.BeginFrame(kept * sizeof(BlockMask));
    masks.Select(isovalues);
    MaskCounts counts;
    ASSERT_NO_FATAL_FAILURE(CheckMasks(volume, isovalues, masks, counts));
    ASSERT_NO_FATAL_FAILURE(CheckMasks(volume, isovalues, masks, counts));
    EXPECT_LT(masks.GetMemory(), (kept + 3) * sizeof(BlockMask)); // of 36
  }
}

//------------------------------------------------------------------------------
TEST(CellMasks, MemoryIsAllocatedForRequestedBlocksOnly)
{
  const auto volume = TestVolume<float>::Of(
    { 34, 35, 36 }, [](const AnalyticFields::Point& p) { return static_cast<float>(p[0]); });
  CellMasks<float> masks{ Samples<float>(volume.View()) };
  masks.Select({ 3.5 });
  const std::size_t before = masks.GetMemory();
  EXPECT_LT(before, 100 * sizeof(BlockMask)); // of 125
  BlockMask own;
  const BlockMask* first = &masks.Get({ 0, 0, 0 }, own);
  const std::size_t withOne = masks.GetMemory();
  EXPECT_GE(withOne, before + sizeof(BlockMask));
  EXPECT_EQ(&masks.Get({ 0, 0, 0 }, own), first);
  EXPECT_NE(first, &own);
  EXPECT_EQ(masks.GetMemory(), withOne);
  ForEachPlace({ 5, 5, 5 }, [&](const Index3& block) { masks.Get(block, own); });
  EXPECT_GE(masks.GetMemory(), before + 125 * sizeof(BlockMask));
  masks.Select({ 4.5 });
  EXPECT_LT(masks.GetMemory(), withOne);
}

}
}
