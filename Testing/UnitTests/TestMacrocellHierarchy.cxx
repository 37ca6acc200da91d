// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The ranges and the active macrocells of hierarchies are compared with those found by looking at
// all samples of each macrocell.

#include "AllKernels.h"
#include "Image/Macrocells/MacrocellHierarchy.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

const std::vector<std::vector<int>> Branchings = { { 8, 8 }, { 2, 3, 5 }, { 64 }, { 1 },
  { 3, 1, 2 }, { 7 }, { 1 << 15, 1 << 15, 1 << 15 }, {} };

const std::vector<Index3> Sizes = { { 2, 2, 2 }, { 3, 2, 7 }, { 9, 8, 10 }, { 17, 16, 15 },
  { 2, 33, 17 }, { 35, 3, 2 } };

template <typename T>
TestVolume<T> RandomVolume(RandomNumbers& random, const Index3& size, int stride)
{
  std::vector<T> samples(Count(size));
  for (T& sample : samples)
  {
    sample = static_cast<T>(random.Integer(0, 100));
    if (std::is_floating_point_v<T> && random.Integer(0, 4) == 0)
    {
      const double bad[] = { std::nan(""), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity() };
      sample = static_cast<T>(bad[random.Integer(0, 2)]);
    }
    if (random.Integer(0, 9) == 0)
    {
      sample =
        random.Integer(0, 1) ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest();
    }
  }
  return TestVolume<T>(size, samples, stride);
}

/// The finite samples at the corners of the cells of a macrocell.
template <typename T>
std::vector<T> SamplesOf(const TestVolume<T>& volume, const Index3& macrocell, std::int64_t edge)
{
  std::vector<T> samples;
  ForEachPlace(volume.Dimensions,
    [&](const Index3& i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::int64_t first = macrocell[axis] * edge;
        if (i[axis] < first || i[axis] > first + edge)
        {
          return;
        }
      }
      const T value = volume.At(i);
      if (std::isfinite(static_cast<double>(value)))
      {
        samples.push_back(value);
      }
    });
  return samples;
}

/// The macrocells of a level by definition: the smallest number that covers all cells.
Index3 MacrocellsCovering(const Index3& dimensions, std::int64_t edge)
{
  Index3 count = { 0, 0, 0 };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    while (count[axis] * edge < dimensions[axis] - 1)
    {
      ++count[axis];
    }
  }
  return count;
}

/// One with all samples read.
template <typename T>
MacrocellHierarchy<T> Build(const Samples<T>& samples, const std::vector<int>& branching,
  int threads, RangeStore* store = nullptr)
{
  MacrocellHierarchy<T> hierarchy(samples, branching);
  while (hierarchy.GetFractionRead() < 1.0)
  {
    hierarchy.ReadSlab(threads, store);
  }
  return hierarchy;
}

template <typename T>
class MacrocellHierarchyOf : public testing::Test
{
};

TYPED_TEST_SUITE(MacrocellHierarchyOf, SampleTypes);

//------------------------------------------------------------------------------
template <typename T>
void CheckHierarchy(
  const TestVolume<T>& volume, const std::vector<int>& branching, int threads, std::size_t& checked)
{
  const auto hierarchy = Build(Samples<T>(volume.View()), branching, threads);
  const std::vector<double> isovalues = { 50.0, 99.5 };
  const ActiveMacrocells active = hierarchy.FindActive(isovalues, threads);
  std::int64_t edge = 1;
  for (std::size_t level = 0; level < branching.size(); ++level)
  {
    edge *= branching[level];
    const Index3 size = MacrocellsCovering(volume.Dimensions, edge);
    ASSERT_EQ(hierarchy.GetLattice().Levels[level].Size, size);
    ForEachPlace(size,
      [&](const Index3& macrocell)
      {
        ++checked;
        const std::vector<T> samples = SamplesOf(volume, macrocell, edge);
        const ValueRange<T>& range = hierarchy.GetRange(level, macrocell);
        if (samples.empty())
        {
          EXPECT_GT(range.Min, range.Max);
          EXPECT_FALSE(active.IsActive(level, macrocell));
          return;
        }
        const auto ends = std::minmax_element(samples.begin(), samples.end());
        EXPECT_EQ(range.Min, *ends.first);
        EXPECT_EQ(range.Max, *ends.second);
        bool expected = false;
        for (const double isovalue : isovalues)
        {
          const auto isInside = [isovalue](T v) { return static_cast<double>(v) >= isovalue; };
          expected = expected ||
            (std::any_of(samples.begin(), samples.end(), isInside) &&
              !std::all_of(samples.begin(), samples.end(), isInside));
        }
        EXPECT_EQ(active.IsActive(level, macrocell), expected);
      });
    ASSERT_FALSE(testing::Test::HasFailure()) << "level " << level;
  }
}

TYPED_TEST(MacrocellHierarchyOf, RangesAndActivityMatchTheSamples)
{
  RandomNumbers random(501);
  std::size_t checked = 0;
  for (const Index3& size : Sizes)
  {
    for (const int stride : { 1, 3 })
    {
      const auto volume = RandomVolume<TypeParam>(random, size, stride);
      for (const std::vector<int>& branching : Branchings)
      {
        ASSERT_NO_FATAL_FAILURE(CheckHierarchy(volume, branching, stride, checked));
      }
    }
  }
  std::cout << "[ tried    ] " << checked << " macrocells\n";
  EXPECT_GT(checked, 10000U);
}

//------------------------------------------------------------------------------
void ExpectSameRanges(
  const MacrocellHierarchy<float>& hierarchy, const MacrocellHierarchy<float>& reference)
{
  for (std::size_t level = 0; level < 2; ++level)
  {
    ForEachPlace(reference.GetLattice().Levels[level].Size,
      [&](const Index3& macrocell)
      {
        const auto& a = hierarchy.GetRange(level, macrocell);
        const auto& b = reference.GetRange(level, macrocell);
        ASSERT_TRUE(a.Min == b.Min && a.Max == b.Max);
      });
  }
}

TEST(MacrocellHierarchy, IdenticalForAnyNumberOfThreads)
{
  RandomNumbers random(502);
  const auto volume = RandomVolume<float>(random, { 37, 26, 41 }, 1);
  const Samples<float> samples(volume.View());
  const std::vector<int> branching = { 2, 3 };
  const auto reference = Build(samples, branching, 1);
  for (const int threads : { 2, 3, 7, 16 })
  {
    const auto hierarchy = Build(samples, branching, threads);
    ExpectSameRanges(hierarchy, reference);
    const ActiveMacrocells expected = reference.FindActive({ 17.0 }, 1);
    const ActiveMacrocells active = hierarchy.FindActive({ 17.0 }, threads);
    for (std::size_t level = 0; level < 2; ++level)
    {
      ForEachPlace(reference.GetLattice().Levels[level].Size,
        [&](const Index3& macrocell)
        { ASSERT_EQ(active.IsActive(level, macrocell), expected.IsActive(level, macrocell)); });
    }
  }
}

//------------------------------------------------------------------------------
/// The ranges of the macrocells of 8^3 cells, found sample by sample.
std::vector<ValueRange<double>> FindRanges(const TestVolume<double>& volume, const Index3& size)
{
  std::vector<ValueRange<double>> ranges(Count(size));
  ForEachPlace(volume.Dimensions,
    [&](const Index3& i)
    {
      // One between two macrocells is of both.
      const Index3 first = { (i[0] - 1) / 8, (i[1] - 1) / 8, (i[2] - 1) / 8 };
      ForEachPlace({ 2, 2, 2 },
        [&](const Index3& next)
        {
          const Index3 macrocell = { first[0] + next[0], first[1] + next[1], first[2] + next[2] };
          bool isCorner = true;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            isCorner = isCorner && macrocell[axis] < size[axis] && 8 * macrocell[axis] <= i[axis];
          }
          if (isCorner)
          {
            ranges[Offset(macrocell, size)].Include(volume.At(i), volume.At(i));
          }
        });
    });
  return ranges;
}

/// Whenever a slab is read, the macrocells of all rows so far have their ranges, on all levels, and
/// no others have any.
TEST(MacrocellHierarchy, BuiltSlabBySlab)
{
  RandomNumbers random(504);
  const Index3 dimensions = { 100, 90, 700 }; // 50 MB
  std::vector<double> samples(Count(dimensions));
  std::generate(samples.begin(), samples.end(), [&random] { return random.Uniform(0.0, 1.0); });
  const TestVolume<double> volume(dimensions, samples);
  MacrocellHierarchy<double> hierarchy(Samples<double>(volume.View()), { 8, 8 });
  const Index3 size = hierarchy.GetLattice().Levels[0].Size;
  const std::vector<ValueRange<double>> expected = FindRanges(volume, size);
  const int rows = size[1] * size[2];
  int slabs = 0;
  int rowsBefore = 0;
  EXPECT_EQ(hierarchy.GetFractionRead(), 0.0);
  while (rowsBefore < rows)
  {
    hierarchy.ReadSlab(2);
    ++slabs;
    const auto rowsRead = static_cast<int>(std::lround(hierarchy.GetFractionRead() * rows));
    ASSERT_GT(rowsRead, rowsBefore);
    rowsBefore = rowsRead;
    std::vector<ValueRange<double>> coarse(Count(hierarchy.GetLattice().Levels[1].Size));
    ValueRange<double> all;
    ForEachPlace(size,
      [&](const Index3& i)
      {
        const ValueRange<double>& found = hierarchy.GetRange(0, i);
        if (i[1] + i[2] * size[1] >= rowsRead)
        {
          ASSERT_GT(found.Min, found.Max);
          return;
        }
        const ValueRange<double>& range = expected[Offset(i, size)];
        ASSERT_TRUE(found.Min == range.Min && found.Max == range.Max);
        coarse[Offset({ i[0] / 8, i[1] / 8, i[2] / 8 }, hierarchy.GetLattice().Levels[1].Size)]
          .Include(range.Min, range.Max);
        all.Include(range.Min, range.Max);
      });
    ForEachPlace(hierarchy.GetLattice().Levels[1].Size,
      [&](const Index3& i)
      {
        const ValueRange<double>& range = coarse[Offset(i, hierarchy.GetLattice().Levels[1].Size)];
        const ValueRange<double>& found = hierarchy.GetRange(1, i);
        ASSERT_TRUE(found.Min == range.Min && found.Max == range.Max);
      });
    EXPECT_EQ(hierarchy.GetRange().Min, all.Min);
    EXPECT_EQ(hierarchy.GetRange().Max, all.Max);
  }
  EXPECT_EQ(hierarchy.GetFractionRead(), 1.0);
  EXPECT_GE(slabs, 3);
}

//------------------------------------------------------------------------------
/// One that may find out that it is damaged when ranges have been overwritten.
struct RangesInMemory : RangeStore
{
  bool IsDamaged = false;
  std::vector<unsigned char> Bytes;

  bool Read(int edge, void* ranges, std::size_t size) override
  {
    EXPECT_EQ(edge, 4);
    if (size == this->Bytes.size())
    {
      std::memcpy(ranges, this->Bytes.data(), size);
      return !this->IsDamaged;
    }
    return false;
  }

  void Write(int edge, const void* ranges, std::size_t size) override
  {
    EXPECT_EQ(edge, 4);
    const auto* bytes = static_cast<const unsigned char*>(ranges);
    this->Bytes.assign(bytes, bytes + size);
  }
};

TEST(MacrocellHierarchy, IdenticalFromAStore)
{
  RandomNumbers random(503);
  const Index3 size = { 37, 26, 41 };
  const auto volume = RandomVolume<float>(random, size, 1);
  const auto other = RandomVolume<float>(random, size, 1);
  const std::vector<int> branching = { 4, 3 };
  RangesInMemory store;
  const auto expectSame = [&](const TestVolume<float>& built, const TestVolume<float>& expected)
  {
    const auto hierarchy = Build(Samples<float>(built.View()), branching, 2, &store);
    const auto reference = Build(Samples<float>(expected.View()), branching, 1);
    ExpectSameRanges(hierarchy, reference);
  };
  expectSame(volume, volume);
  expectSame(other, volume); // The samples are not looked at.
  store.IsDamaged = true;
  expectSame(other, other);
  store.IsDamaged = false;
  expectSame(volume, other);
}

//------------------------------------------------------------------------------
// Two values, 3 and 4: equal to the isovalue is inside.
TEST(MacrocellHierarchy, ActiveByTheSignRule)
{
  TestVolume<std::uint8_t> volume({ 3, 2, 2 }, { 3, 3, 4, 3, 3, 4, 3, 3, 4, 3, 3, 4 });
  const auto hierarchy = Build(Samples<std::uint8_t>(volume.View()), { 1 }, 1);
  const auto isActive = [&](double isovalue, int cell) {
    return hierarchy.FindActive({ isovalue }, 1).IsActive(0, { cell, 0, 0 });
  };
  for (const double isovalue : { 2.0, 2.9, 3.0, 4.1, 5.0, std::nan("") })
  {
    EXPECT_FALSE(isActive(isovalue, 0)) << isovalue;
    EXPECT_FALSE(isActive(isovalue, 1)) << isovalue;
  }
  for (const double isovalue : { 3.0000001, 3.5, 4.0 })
  {
    EXPECT_FALSE(isActive(isovalue, 0)) << isovalue;
    EXPECT_TRUE(isActive(isovalue, 1)) << isovalue;
  }
  EXPECT_FALSE(hierarchy.FindActive({}, 1).IsActive(0, { 1, 0, 0 }));
}

//------------------------------------------------------------------------------
TEST(MacrocellHierarchy, MemoryIsSmall)
{
  const Index3 size = { 256, 256, 108 };
  const TestVolume<std::int16_t> volume(size, std::vector<std::int16_t>(Count(size)));
  const auto hierarchy = Build(Samples<std::int16_t>(volume.View()), { 8, 8 }, 2);
  const double share =
    static_cast<double>(hierarchy.GetMemory()) / (2.0 * static_cast<double>(Count(size)));
  std::cout << "[ tried    ] 256 x 256 x 108 samples; overhead " << 100.0 * share << " %\n";
  EXPECT_GE(hierarchy.GetMemory(), std::size_t{ 32 * 32 * 14 * 4 });
  EXPECT_LE(share, 0.005);
}

//------------------------------------------------------------------------------
/// Any value of a type; for floats also NaN and infinity.
template <typename T>
T AnyValue(RandomNumbers& random)
{
  constexpr std::numeric_limits<T> limits;
  if constexpr (std::is_floating_point_v<T>)
  {
    const T values[] = { limits.quiet_NaN(), limits.infinity(), -limits.infinity(),
      limits.denorm_min(), -limits.denorm_min(), limits.max(), limits.lowest(), T{ 0 }, -T{ 0 },
      static_cast<T>(random.Uniform(-1.0, 1.0)) };
    return values[random.Integer(0, 9)];
  }
  else
  {
    const T values[] = { limits.max(), limits.lowest(), T{ 0 }, static_cast<T>(random.Bits()) };
    return values[random.Integer(0, 3)];
  }
}

class RangeKernels : public WithKernels
{
protected:
  /// Includes rows one after the other; behind the end of a row nothing changes.
  template <typename T>
  void CheckRows()
  {
    RandomNumbers random(871);
    const auto includeRow = this->TheKernels.IncludeRow[static_cast<int>(ScalarTypeOf<T>())];
    for (std::size_t count = 0; count < 150; ++count)
    {
      const std::size_t size = count + 70;
      std::vector<T> low(size, ValueRange<T>().Min);
      std::vector<T> high(size, ValueRange<T>().Max);
      std::vector<T> expectedLow = low;
      std::vector<T> expectedHigh = high;
      for (int row = 0; row < 10; ++row)
      {
        std::vector<T> values(size);
        std::generate(values.begin(), values.end(), [&] { return AnyValue<T>(random); });
        for (std::size_t i = 0; i < count; ++i)
        {
          IncludeLow(values[i], expectedLow[i]);
          IncludeHigh(values[i], expectedHigh[i]);
        }
        includeRow(values.data(), low.data(), high.data(), static_cast<std::ptrdiff_t>(count));
        ASSERT_EQ(std::memcmp(low.data(), expectedLow.data(), size * sizeof(T)), 0) << count;
        ASSERT_EQ(std::memcmp(high.data(), expectedHigh.data(), size * sizeof(T)), 0) << count;
      }
    }
  }
};
INSTANTIATE_TEST_SUITE_P(All, RangeKernels, AllKernels(), NameOfKernels);

TEST_P(RangeKernels, ExtendRangesByRowsOfSamples)
{
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::int8_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::uint8_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::int16_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::uint16_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::int32_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::uint32_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::int64_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<std::uint64_t>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<float>());
  ASSERT_NO_FATAL_FAILURE(this->CheckRows<double>());
}

}
}
