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
#include "Math/ThreadsOfLoop.h"
#include "Math/ValueRange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <omp.h>

namespace vtkIsosurfaceRayTracing
{

/// Levels of macrocells over the cells of a volume, each with the range of all samples at the
/// corners of its cells (Parker et al. 1998, section 3). Level 0 is the finest.
///
/// They are built slab by slab, in the order of the samples in memory. Macrocells whose samples
/// have not been read have an empty range, which no surface passes.
template <typename T>
class MacrocellHierarchy
{
public:
  /// Branching, finest level first: the edge of the macrocells of a level in those of the level
  /// below; the finest are made of cells. No samples are read yet.
  MacrocellHierarchy(const Samples<T>& samples, const std::vector<int>& branching);

  /// Reads the next slab, in parallel. If the finest macrocells are in the store, which may be
  /// null, it reads none, and builds all. To be called until all is read.
  void ReadSlab(int threads, RangeStore* store = nullptr);

  /// How much is read, from 0 to 1: everything.
  double GetFractionRead() const;

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
  /// Rows of macrocells of a level, along x: from the first to before the last.
  struct Rows
  {
    int Begin;
    int End;
  };

  ValueRange<T> GetRangeAround(std::size_t level, std::size_t macrocell) const;
  int GetNumberOfRows() const;
  int GetRowsOfSlab() const;
  bool TakeFrom(RangeStore* store);
  void BuildFinestLevel(const Rows& rows, int threads);
  void BuildRow(const Index3& first, std::vector<T>& low, std::vector<T>& high);
  Rows AddToNextLevel(std::size_t level, const Rows& rows, int threads);

  Samples<T> TheSamples;
  MacrocellLattice Lattice;
  std::vector<std::vector<ValueRange<T>>> Ranges;
  ValueRange<T> Range;
  /// The rows of the finest macrocells that are built.
  int RowsRead = 0;
  /// If there are to be no levels, those that find the range of all samples until all are read.
  std::unique_ptr<MacrocellHierarchy> OfRange;
};

//------------------------------------------------------------------------------
template <typename T>
MacrocellHierarchy<T>::MacrocellHierarchy(
  const Samples<T>& samples, const std::vector<int>& branching)
  : TheSamples(samples)
  , Lattice(samples.GetDimensions(), branching)
{
  for (const MacrocellLattice::Level& level : this->Lattice.Levels)
  {
    this->Ranges.emplace_back(Count(level.Size));
  }
  if (this->Ranges.empty())
  {
    const Index3& cells = this->Lattice.Cells;
    const std::vector<int> ofRange = { 8, std::max({ cells[0], cells[1], cells[2] }) };
    this->OfRange = std::make_unique<MacrocellHierarchy>(samples, ofRange);
  }
}

//------------------------------------------------------------------------------
template <typename T>
int MacrocellHierarchy<T>::GetNumberOfRows() const
{
  const Index3& size = this->Lattice.Levels[0].Size;
  return size[1] * size[2];
}

//------------------------------------------------------------------------------
/// As many as have 16 MiB of samples, or one: a disk reads them in a tenth of a second, and threads
/// that wait for each other at the end of a slab lose little time of it.
template <typename T>
int MacrocellHierarchy<T>::GetRowsOfSlab() const
{
  constexpr double bytesOfSlab = 16 << 20;
  const double edge = this->Lattice.Levels[0].Edge;
  const double bytesOfRow =
    edge * edge * sizeof(T) * static_cast<double>(this->TheSamples.GetStride(1));
  return static_cast<int>(
    std::clamp(bytesOfSlab / bytesOfRow, 1.0, static_cast<double>(this->GetNumberOfRows())));
}

//------------------------------------------------------------------------------
template <typename T>
double MacrocellHierarchy<T>::GetFractionRead() const
{
  if (this->Ranges.empty())
  {
    return this->OfRange ? this->OfRange->GetFractionRead() : 1.0;
  }
  return static_cast<double>(this->RowsRead) / this->GetNumberOfRows();
}

//------------------------------------------------------------------------------
template <typename T>
void MacrocellHierarchy<T>::ReadSlab(int threads, RangeStore* store)
{
  if (this->OfRange)
  {
    this->OfRange->ReadSlab(threads, store);
    this->Range = this->OfRange->GetRange();
    if (this->OfRange->GetFractionRead() == 1.0)
    {
      this->OfRange.reset();
    }
    return;
  }
  const int count = this->GetNumberOfRows();
  Rows rows = { this->RowsRead, count };
  if (this->RowsRead > 0 || !this->TakeFrom(store))
  {
    rows.End = std::min(rows.Begin + this->GetRowsOfSlab(), count);
    ExpectReading(Reading::InOrder, this->TheSamples);
    this->BuildFinestLevel(rows, threads);
    if (rows.End == count && store)
    {
      const std::vector<ValueRange<T>>& ranges = this->Ranges[0];
      store->Write(
        this->Lattice.Levels[0].Edge, ranges.data(), ranges.size() * sizeof(ValueRange<T>));
    }
  }
  this->RowsRead = rows.End;
  // From here on, what is next to surfaces.
  ExpectReading(Reading::Scattered, this->TheSamples);
  for (std::size_t level = 1; level < this->Ranges.size(); ++level)
  {
    rows = this->AddToNextLevel(level, rows, threads);
  }
  const std::vector<ValueRange<T>>& coarsest = this->Ranges.back();
  const int length = this->Lattice.Levels.back().Size[0];
  std::for_each(coarsest.begin() + static_cast<std::ptrdiff_t>(rows.Begin) * length,
    coarsest.begin() + static_cast<std::ptrdiff_t>(rows.End) * length,
    [this](const ValueRange<T>& range) { this->Range.Include(range.Min, range.Max); });
}

//------------------------------------------------------------------------------
/// Takes the finest macrocells from a store, which may be null. Returns whether they are there.
template <typename T>
bool MacrocellHierarchy<T>::TakeFrom(RangeStore* store)
{
  std::vector<ValueRange<T>>& ranges = this->Ranges[0];
  if (!store)
  {
    return false;
  }
  const bool isThere =
    store->Read(this->Lattice.Levels[0].Edge, ranges.data(), ranges.size() * sizeof(ValueRange<T>));
  if (!isThere)
  {
    std::fill(ranges.begin(), ranges.end(), ValueRange<T>()); // What is damaged may be there.
  }
  return isThere;
}

//------------------------------------------------------------------------------
template <typename T>
void MacrocellHierarchy<T>::BuildFinestLevel(const Rows& rows, int threads)
{
  const Index3 size = this->Lattice.Levels[0].Size;
  const int edge = this->Lattice.Levels[0].Edge;
  const auto length =
    static_cast<std::size_t>(this->TheSamples.GetBefore() + this->TheSamples.GetDimensions()[0]);

  // Of each thread, allocated here: no exception may leave a parallel region.
  std::vector<std::vector<T>> lows(static_cast<std::size_t>(threads), std::vector<T>(length));
  std::vector<std::vector<T>> highs = lows;

  const double samplesOfRow = static_cast<double>(edge) * edge * static_cast<double>(length);
  const auto count = static_cast<std::size_t>(rows.End - rows.Begin);
#pragma omp parallel num_threads(GetThreadsOfLoop(count, 0.2 * samplesOfRow, threads))
  {
    std::vector<T>& low = lows[static_cast<std::size_t>(omp_get_thread_num())];
    std::vector<T>& high = highs[static_cast<std::size_t>(omp_get_thread_num())];
#pragma omp for schedule(dynamic)
    for (int row = rows.Begin; row < rows.End; ++row)
    {
      this->BuildRow({ 0, row % size[1], row / size[1] }, low, high);
    }
  }
}

//------------------------------------------------------------------------------
/// Makes a row of macrocells along x, given the first of them and room for the values of a row of
/// samples: the minimum and maximum over y and z of whole rows of samples, which is a stream of
/// vector instructions, and then those over x.
template <typename T>
void MacrocellHierarchy<T>::BuildRow(const Index3& first, std::vector<T>& low, std::vector<T>& high)
{
  const Samples<T>& samples = this->TheSamples;
  const Index3 dimensions = samples.GetDimensions();
  const Index3 size = this->Lattice.Levels[0].Size;
  const int edge = this->Lattice.Levels[0].Edge;
  const std::ptrdiff_t stride = samples.GetStride(0);
  const int before = samples.GetBefore();
  const auto includeRow = GetBestKernels().IncludeRow[static_cast<int>(ScalarTypeOf<T>())];
  std::fill(low.begin(), low.end(), ValueRange<T>().Min);
  std::fill(high.begin(), high.end(), ValueRange<T>().Max);
  // A macrocell of n cells has n + 1 samples along an edge, shared with its neighbours. The first
  // have those before the volume, too.
  const auto firstOf = [before, edge](int macrocell)
  { return macrocell == 0 ? -before : macrocell * edge; };
  const int yEnd = std::min((first[1] + 1) * edge, dimensions[1] - 1);
  const int zEnd = std::min((first[2] + 1) * edge, dimensions[2] - 1);
  for (int z = firstOf(first[2]); z <= zEnd; ++z)
  {
    for (int y = firstOf(first[1]); y <= yEnd; ++y)
    {
      const T* sample = samples.At({ -before, y, z });
      if (stride == 1)
      {
        includeRow(sample, low.data(), high.data(), static_cast<int>(low.size()));
        continue;
      }
      for (std::size_t x = 0; x < low.size(); ++x)
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
    for (int x = firstOf(i); x <= xEnd; ++x)
    {
      const auto index = static_cast<std::size_t>(before + x);
      ranges[i].Include(low[index], high[index]);
    }
  }
}

//------------------------------------------------------------------------------
/// Adds rows of the level below. Returns the rows that may have changed.
template <typename T>
typename MacrocellHierarchy<T>::Rows MacrocellHierarchy<T>::AddToNextLevel(
  std::size_t level, const Rows& rows, int threads)
{
  const Index3 size = this->Lattice.Levels[level].Size;
  const Index3 childSize = this->Lattice.Levels[level - 1].Size;
  const int branching = this->Lattice.Levels[level].Branching;
  const auto layerOf = [&childSize, branching](int row) { return row / childSize[1] / branching; };
  const Rows changed = { layerOf(rows.Begin) * size[1], (layerOf(rows.End - 1) + 1) * size[1] };
  const auto below = static_cast<std::size_t>(std::int64_t{ rows.End - rows.Begin } * childSize[0]);
#pragma omp parallel for schedule(dynamic) num_threads(GetThreadsOfLoop(below, 1.0, threads))
  for (int row = changed.Begin; row < changed.End; ++row)
  {
    const int y = row % size[1];
    const int z = row / size[1];
    ValueRange<T>* ranges = &this->Ranges[level][Offset({ 0, y, z }, size)];
    const int yEnd = std::min((y + 1) * branching, childSize[1]);
    const int zEnd = std::min((z + 1) * branching, childSize[2]);
    for (int childZ = z * branching; childZ < zEnd; ++childZ)
    {
      const int begin = std::max(y * branching, rows.Begin - childZ * childSize[1]);
      const int end = std::min(yEnd, rows.End - childZ * childSize[1]);
      for (int childY = begin; childY < end; ++childY)
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
  return changed;
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
