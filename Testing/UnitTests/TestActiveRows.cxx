// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The samples next to surfaces, which are read ahead from a file: compared with what active
// macrocells say of each sample, and with the pages that the system has.

#include "Image/ImageField.h"
#include "Image/Macrocells/ActiveRows.h"
#include "RandomNumbers.h"
#include "TestRequest.h"
#include "TestVolume.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#ifdef __linux__
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Whether a sample is one of a macrocell, or next to it.
bool IsAround(int sample, int macrocell, int edge)
{
  return sample >= macrocell * edge - 1 && sample <= (macrocell + 1) * edge + 1;
}

/// What a row is by definition: from the first such sample to the last.
ActiveRows::Row FindRow(const ActiveMacrocells& active, const Index3& dimensions, int y, int z)
{
  const MacrocellLattice::Level& finest = active.GetLattice().Levels.front();
  ActiveRows::Row row;
  ForEachPlace(finest.Size,
    [&](const Index3& i)
    {
      if (!active.IsActive(0, i) || !IsAround(y, i[1], finest.Edge) ||
        !IsAround(z, i[2], finest.Edge))
      {
        return;
      }
      for (int x = 0; x < dimensions[0]; ++x)
      {
        if (IsAround(x, i[0], finest.Edge))
        {
          row.Include({ x, x });
        }
      }
    });
  return row;
}

TEST(ActiveRows, AreThoseOfMacrocellsAndTheirNeighbours)
{
  RandomNumbers random(505);
  int empty = 0;
  int found = 0;
  for (const int edge : { 1, 2, 3, 8, 50 })
  {
    for (const int share : { 2, 10, 60 })
    {
      const Index3 dimensions = { random.Integer(2, 40), random.Integer(2, 30),
        random.Integer(2, 30) };
      ActiveMacrocells active(MacrocellLattice(dimensions, { edge, 4 }));
      active.Fill(0, 1, [&](std::size_t) { return random.Integer(0, share) == 0; });
      const ActiveRows rows(active);
      for (int z = 0; z < dimensions[2]; ++z)
      {
        const std::vector<ActiveRows::Row> slice = rows.GetSlice(z);
        ASSERT_EQ(slice.size(), static_cast<std::size_t>(dimensions[1]));
        for (int y = 0; y < dimensions[1]; ++y)
        {
          const ActiveRows::Row expected = FindRow(active, dimensions, y, z);
          const ActiveRows::Row& row = slice[static_cast<std::size_t>(y)];
          ASSERT_EQ(row.First, expected.First) << edge << ": " << y << ", " << z;
          ASSERT_EQ(row.Last, expected.Last) << edge << ": " << y << ", " << z;
          ++(row.IsEmpty() ? empty : found);
        }
      }
    }
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(found, 1000);
}

//------------------------------------------------------------------------------
/// The first and last samples of some rows of macrocells along x, one behind the other.
TEST(ActiveRows, AreTakenOutIfOthersHaveThem)
{
  const Index3 dimensions = { 101, 2, 41 };
  const auto of = [&dimensions](const std::vector<std::size_t>& macrocells)
  {
    ActiveMacrocells active(MacrocellLattice(dimensions, { 10 }));
    active.Fill(0, 1,
      [&macrocells](std::size_t macrocell)
      { return std::find(macrocells.begin(), macrocells.end(), macrocell) != macrocells.end(); });
    return ActiveRows(active);
  };
  const auto expectRow = [](const ActiveRows& rows, int z, int first, int last)
  {
    const ActiveRows::Row row = rows.GetSlice(z)[0];
    EXPECT_EQ(row.First, first) << z;
    EXPECT_EQ(row.Last, last) << z;
  };
  const ActiveRows::Row none;
  ActiveRows rows = of({ 2, 12, 13, 22 });
  ActiveRows others = of({ 1, 3, 13 });
  rows.Remove(others);
  expectRow(rows, 5, none.First, none.Last);
  expectRow(rows, 15, 19, 41);
  expectRow(rows, 25, 19, 31);
  expectRow(rows, 35, none.First, none.Last);
  others.Include(rows);
  expectRow(others, 5, 9, 41);
  expectRow(others, 15, 19, 41);
  expectRow(others, 25, 19, 31);
  expectRow(others, 35, none.First, none.Last);
}

#ifdef __linux__

//------------------------------------------------------------------------------
/// Slices of samples in a file that is mapped: 0 in the first half, 100 in the second.
class MappedSlices
{
public:
  static constexpr int Slices = 64;
  static constexpr int Edge = 256;
  static constexpr std::size_t SizeOfSlice = std::size_t{ Edge } * Edge;

  MappedSlices()
    : File(std::tmpfile())
  {
    const std::vector<std::uint8_t> low(SizeOfSlice, 0);
    const std::vector<std::uint8_t> high(SizeOfSlice, 100);
    for (int z = 0; z < Slices; ++z)
    {
      std::fwrite((z < Slices / 2 ? low : high).data(), 1, SizeOfSlice, this->File);
    }
    std::fflush(this->File);
    fsync(fileno(this->File));
    this->Bytes =
      mmap(nullptr, Slices * SizeOfSlice, PROT_READ, MAP_PRIVATE, fileno(this->File), 0);
  }
  ~MappedSlices()
  {
    munmap(this->Bytes, Slices * SizeOfSlice);
    std::fclose(this->File);
  }
  MappedSlices(const MappedSlices&) = delete;
  MappedSlices& operator=(const MappedSlices&) = delete;

  VolumeView View() const
  {
    return { this->Bytes, ScalarType::UInt8, { Edge, Edge, Slices }, 1, true };
  }

  /// Has the system forget what it has read.
  void Drop() const
  {
    madvise(this->Bytes, Slices * SizeOfSlice, MADV_DONTNEED);
    posix_fadvise(fileno(this->File), 0, 0, POSIX_FADV_DONTNEED);
  }

  /// The share of the pages of slices that the system has.
  double GetShareRead(int begin, int end) const
  {
    const auto pageSize = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t size = static_cast<std::size_t>(end - begin) * SizeOfSlice;
    std::vector<unsigned char> pages(size / pageSize);
    mincore(static_cast<char*>(this->Bytes) + static_cast<std::size_t>(begin) * SizeOfSlice, size,
      pages.data());
    const auto count =
      std::count_if(pages.begin(), pages.end(), [](unsigned char page) { return (page & 1) != 0; });
    return static_cast<double>(count) / static_cast<double>(pages.size());
  }

private:
  std::FILE* File;
  void* Bytes;
};

/// Selecting an isovalue has the system read what is next to its surface, and nothing else.
TEST(ActiveRows, AreReadAheadFromAFile)
{
  const MappedSlices slices;
  const auto field = ImageField::New(slices.View(), {}, 1);
  slices.Drop();
  if (slices.GetShareRead(0, MappedSlices::Slices) > 0.0)
  {
    GTEST_SKIP() << "The system does not forget files of the temporary folder.";
  }
  Select(*field, TestRequest({ { 200.0, 1.0 } }), 1);
  EXPECT_EQ(slices.GetShareRead(0, MappedSlices::Slices), 0.0);

  Select(*field, TestRequest({ { 50.0, 1.0 } }), 1);
  // The surface is in the macrocells of the slices 24 to 32.
  const auto isRead = [&slices] { return slices.GetShareRead(23, 34) == 1.0; };
  for (int i = 0; i < 100 && !isRead(); ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  EXPECT_TRUE(isRead());
  EXPECT_EQ(slices.GetShareRead(0, 16), 0.0);
  EXPECT_EQ(slices.GetShareRead(42, MappedSlices::Slices), 0.0);

  // Once.
  slices.Drop();
  Select(*field, TestRequest({ { 60.0, 1.0 } }), 1);
  EXPECT_EQ(slices.GetShareRead(0, MappedSlices::Slices), 0.0);
}

#endif

}
}
