// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MacrocellHierarchy_h
#define MacrocellHierarchy_h

#include "Image/Macrocells/ActiveMacrocells.h"
#include "Image/Macrocells/RangeStore.h"
#include "Image/Samples/FilePages.h"
#include "Image/Samples/VolumeView.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Math/ValueRange.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <omp.h>

namespace vtkIsosurfaceRayTracing
{

/// Levels of macrocells over the cells of a volume, each with the range of all samples at the
/// corners of its cells (Parker et al. 1998, section 3). Level 0 is the finest.
template <typename T>
class MacrocellHierarchy
{
public:
  /// Branching, finest level first: the edge of the macrocells of a level in those of the level
  /// below; the finest are made of cells. Builds all levels, in parallel. The finest are those of
  /// the store, unless there is none (null), or nothing in it.
  MacrocellHierarchy(const Samples<T>& samples, const std::vector<int>& branching, int threads,
    RangeStore* store = nullptr);

  const MacrocellLattice& GetLattice() const { return this->Lattice; }

  const ValueRange<T>& GetRange(std::size_t level, const Index3& macrocell) const
  {
    return this->Ranges[level][Offset(macrocell, this->Lattice.Levels[level].Size)];
  }

  /// The range of all samples.
  const ValueRange<T>& GetRange() const { return this->Range; }

  /// In bytes.
  std::size_t GetMemory() const;

  /// Finds the macrocells whose range holds one of the isovalues.
  ActiveMacrocells FindActive(const std::vector<double>& isovalues, int threads) const;

  /// The same for an interpolant whose cells depend on the samples one cell further on every side,
  /// and may exceed their range, by a multiple of its length.
  ActiveMacrocells FindActive(
    const std::vector<double>& isovalues, double overshoot, int threads) const;

private:
  ValueRange<T> GetRangeAround(std::size_t level, std::size_t macrocell) const;
  void FindFinestLevel(const Samples<T>& samples, int threads, RangeStore* store);
  void BuildFinestLevel(const Samples<T>& samples, int threads);
  void BuildLevel(std::size_t level, int threads);

  MacrocellLattice Lattice;
  std::vector<std::vector<ValueRange<T>>> Ranges;
  ValueRange<T> Range;
};

//------------------------------------------------------------------------------
template <typename T>
MacrocellHierarchy<T>::MacrocellHierarchy(
  const Samples<T>& samples, const std::vector<int>& branching, int threads, RangeStore* store)
  : Lattice(samples.GetDimensions(), branching)
  , Ranges(branching.size())
{
  for (std::size_t level = 0; level < this->Ranges.size(); ++level)
  {
    this->Ranges[level].resize(Count(this->Lattice.Levels[level].Size));
    if (level == 0)
    {
      this->FindFinestLevel(samples, threads, store);
    }
    else
    {
      this->BuildLevel(level, threads);
    }
  }
  if (this->Ranges.empty())
  {
    // One macrocell of all cells, which is not kept.
    const Index3& cells = this->Lattice.Cells;
    this->Range = MacrocellHierarchy<T>(
      samples, { 8, std::max({ cells[0], cells[1], cells[2] }) }, threads, store)
                    .GetRange();
    return;
  }
  for (const ValueRange<T>& range : this->Ranges.back())
  {
    this->Range.Include(range.Min, range.Max);
  }
}

//------------------------------------------------------------------------------
template <typename T>
void MacrocellHierarchy<T>::FindFinestLevel(
  const Samples<T>& samples, int threads, RangeStore* store)
{
  std::vector<ValueRange<T>>& ranges = this->Ranges[0];
  const int edge = this->Lattice.Levels[0].Edge;
  const std::size_t size = ranges.size() * sizeof(ValueRange<T>);
  if (!store || !store->Read(edge, ranges.data(), size))
  {
    ExpectReading(Reading::InOrder, samples);
    this->BuildFinestLevel(samples, threads);
    if (store)
    {
      store->Write(edge, ranges.data(), size);
    }
  }
  // From here on, what is next to surfaces.
  ExpectReading(Reading::Scattered, samples);
}

//------------------------------------------------------------------------------
// One task makes one row of macrocells along x. It first takes the minimum and maximum over y and z
// of whole rows of samples, which is a stream of vector instructions, and then those over x.
template <typename T>
void MacrocellHierarchy<T>::BuildFinestLevel(const Samples<T>& samples, int threads)
{
  const Index3 dimensions = samples.GetDimensions();
  const Index3 size = this->Lattice.Levels[0].Size;
  const int edge = this->Lattice.Levels[0].Edge;
  const std::ptrdiff_t stride = samples.GetStride(0);
  const int rows = size[1] * size[2];
  const auto length = static_cast<std::size_t>(dimensions[0]);
  const auto includeRow = GetBestKernels().IncludeRow[static_cast<int>(ScalarTypeOf<T>())];

  // Of each thread, allocated here: no exception may leave a parallel region.
  std::vector<std::vector<T>> lows(static_cast<std::size_t>(threads), std::vector<T>(length));
  std::vector<std::vector<T>> highs = lows;

#pragma omp parallel num_threads(threads)
  {
    std::vector<T>& low = lows[static_cast<std::size_t>(omp_get_thread_num())];
    std::vector<T>& high = highs[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(dynamic)
    for (int row = 0; row < rows; ++row)
    {
      const Index3 first = { 0, row % size[1], row / size[1] };
      std::fill(low.begin(), low.end(), ValueRange<T>().Min);
      std::fill(high.begin(), high.end(), ValueRange<T>().Max);
      // A macrocell of n cells has n + 1 samples along an edge, shared with its neighbours.
      const int yEnd = std::min((first[1] + 1) * edge, dimensions[1] - 1);
      const int zEnd = std::min((first[2] + 1) * edge, dimensions[2] - 1);
      for (int z = first[2] * edge; z <= zEnd; ++z)
      {
        for (int y = first[1] * edge; y <= yEnd; ++y)
        {
          const T* sample = samples.At({ 0, y, z });
          if (stride == 1)
          {
            includeRow(sample, low.data(), high.data(), dimensions[0]);
            continue;
          }
          for (std::size_t x = 0; x < length; ++x)
          {
            const T value = sample[static_cast<std::ptrdiff_t>(x) * stride];
            IncludeLow(value, low[x]);
            IncludeHigh(value, high[x]);
          }
        }
      }
      ValueRange<T>* ranges = &this->Ranges[0][Offset(first, size)];
      for (int i = 0; i < size[0]; ++i)
      {
        const int xEnd = std::min((i + 1) * edge, dimensions[0] - 1);
        ranges[i] = {};
        for (int x = i * edge; x <= xEnd; ++x)
        {
          const auto index = static_cast<std::size_t>(x);
          ranges[i].Include(low[index], high[index]);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
template <typename T>
void MacrocellHierarchy<T>::BuildLevel(std::size_t level, int threads)
{
  const Index3 size = this->Lattice.Levels[level].Size;
  const Index3 childSize = this->Lattice.Levels[level - 1].Size;
  const int branching = this->Lattice.Levels[level].Branching;
  const int rows = size[1] * size[2];
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (int row = 0; row < rows; ++row)
  {
    const int y = row % size[1];
    const int z = row / size[1];
    ValueRange<T>* ranges = &this->Ranges[level][Offset({ 0, y, z }, size)];
    const int yEnd = std::min((y + 1) * branching, childSize[1]);
    const int zEnd = std::min((z + 1) * branching, childSize[2]);
    for (int childZ = z * branching; childZ < zEnd; ++childZ)
    {
      for (int childY = y * branching; childY < yEnd; ++childY)
      {
        const ValueRange<T>* children =
          &this->Ranges[level - 1][Offset({ 0, childY, childZ }, childSize)];
        for (int childX = 0; childX < childSize[0]; ++childX)
        {
          ranges[childX / branching].Include(children[childX].Min, children[childX].Max);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
template <typename T>
std::size_t MacrocellHierarchy<T>::GetMemory() const
{
  std::size_t count = 0;
  for (const auto& ranges : this->Ranges)
  {
    count += ranges.size();
  }
  return count * sizeof(ValueRange<T>);
}

//------------------------------------------------------------------------------
/// The range of a macrocell and its neighbours.
template <typename T>
ValueRange<T> MacrocellHierarchy<T>::GetRangeAround(std::size_t level, std::size_t macrocell) const
{
  const Index3& size = this->Lattice.Levels[level].Size;
  Index3 first;
  Index3 last;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto length = static_cast<std::size_t>(size[axis]);
    const int position = static_cast<int>(macrocell % length);
    macrocell /= length;
    first[axis] = std::max(position - 1, 0);
    last[axis] = std::min(position + 1, size[axis] - 1);
  }
  ValueRange<T> range;
  for (int z = first[2]; z <= last[2]; ++z)
  {
    for (int y = first[1]; y <= last[1]; ++y)
    {
      for (int x = first[0]; x <= last[0]; ++x)
      {
        const ValueRange<T>& own = this->GetRange(level, { x, y, z });
        range.Include(own.Min, own.Max);
      }
    }
  }
  return range;
}

//------------------------------------------------------------------------------
template <typename T>
ActiveMacrocells MacrocellHierarchy<T>::FindActive(
  const std::vector<double>& isovalues, double overshoot, int threads) const
{
  ActiveMacrocells active(this->Lattice);
  for (std::size_t level = 0; level < this->Ranges.size(); ++level)
  {
    active.Fill(level, threads,
      [this, level, &isovalues, overshoot](std::size_t macrocell)
      {
        const ValueRange<T> range = this->GetRangeAround(level, macrocell);
        return std::any_of(isovalues.begin(), isovalues.end(),
          [&range, overshoot](double isovalue) { return range.Straddles(isovalue, overshoot); });
      });
  }
  return active;
}

//------------------------------------------------------------------------------
template <typename T>
ActiveMacrocells MacrocellHierarchy<T>::FindActive(
  const std::vector<double>& isovalues, int threads) const
{
  ActiveMacrocells active(this->Lattice);
  for (std::size_t level = 0; level < this->Ranges.size(); ++level)
  {
    const std::vector<ValueRange<T>>& ranges = this->Ranges[level];
    active.Fill(level, threads,
      [&ranges, &isovalues](std::size_t macrocell)
      {
        return std::any_of(isovalues.begin(), isovalues.end(),
          [&ranges, macrocell](double isovalue) { return ranges[macrocell].Straddles(isovalue); });
      });
  }
  return active;
}

}

#endif
