// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellMasks_h
#define CellMasks_h

#include "BlockMask.h"
#include "VolumeView.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// For blocks of 8^3 cells, which of the cells a surface passes: those with corners on both sides
/// of an isovalue and none that is NaN or infinite. The mask of a block is made by the first ray
/// that comes to it.
template <typename T>
class CellMasks
{
public:
  explicit CellMasks(const Samples<T>& samples)
    : TheSamples(samples)
    , Blocks(BlocksCovering({ samples.GetDimensions()[0] - 1, samples.GetDimensions()[1] - 1,
                              samples.GetDimensions()[2] - 1 },
        BlockMask::Edge))
    , States(Count(this->Blocks))
    // Not touched before use: what no ray sees takes no memory.
    , Masks(static_cast<BlockMask*>(::operator new(
        this->States.size() * sizeof(BlockMask), std::align_val_t(alignof(BlockMask)))))
  {
  }

  /// Forgets all masks, and takes other isovalues from now on.
  void Select(const std::vector<double>& isovalues)
  {
    this->Isovalues = isovalues;
    if (this->Made.exchange(0) > 0)
    {
      for (std::atomic<State>& state : this->States)
      {
        state.store(State::Missing, std::memory_order_relaxed);
      }
    }
  }

  /// The mask of a block: the one that is kept, or one made in the place given, when another thread
  /// is about to make it. No thread ever waits.
  const BlockMask& Get(const Index3& block, BlockMask& own)
  {
    const std::size_t place = Offset(block, this->Blocks);
    BlockMask& kept = this->Masks.get()[place];
    State state = this->States[place].load(std::memory_order_acquire);
    if (state == State::Ready)
    {
      return kept;
    }
    if (state == State::Missing &&
      this->States[place].compare_exchange_strong(state, State::BeingMade))
    {
      this->Make(block, kept);
      this->States[place].store(State::Ready, std::memory_order_release);
      this->Made.fetch_add(1, std::memory_order_relaxed);
      return kept;
    }
    this->Make(block, own);
    return own;
  }

  /// In bytes.
  std::size_t GetMemory() const
  {
    return this->Made.load() * sizeof(BlockMask) + this->States.size() * sizeof(State);
  }

private:
  enum class State : std::uint8_t
  {
    Missing,
    BeingMade,
    Ready
  };

  struct Free
  {
    void operator()(BlockMask* masks) const
    {
      ::operator delete(masks, std::align_val_t(alignof(BlockMask)));
    }
  };

  // 64-bit integers are traced as doubles, so they are compared as doubles.
  using Compared = std::conditional_t<sizeof(T) == 8, double, T>;

  /// The smallest value that is inside.
  static Compared GetThreshold(double isovalue)
  {
    if constexpr (std::is_same_v<Compared, double>)
    {
      return isovalue;
    }
    else if constexpr (std::is_same_v<Compared, float>)
    {
      const auto nearest = static_cast<float>(isovalue);
      return static_cast<double>(nearest) < isovalue
        ? std::nextafter(nearest, std::numeric_limits<float>::infinity())
        : nearest;
    }
    else
    {
      return static_cast<Compared>(std::ceil(isovalue));
    }
  }

  /// What eight values around a cell have in common, gathered one axis after the other.
  struct Corners
  {
    std::uint64_t Any = 0;
    std::uint64_t All = 0;

    Corners Join(const Corners& other) const
    {
      return { this->Any | other.Any, this->All & other.All };
    }
  };

  /// For the cells of a plane of samples, whether any and whether all of the four samples around
  /// them pass a test.
  template <typename Test>
  static Corners JoinInPlane(
    const T* plane, const Index3& count, const Samples<T>& samples, const Test& test)
  {
    const std::ptrdiff_t stride = samples.GetStride(0);
    Corners low;
    Corners high;
    for (int y = 0; y <= count[1]; ++y)
    {
      const T* row = plane + y * samples.GetStride(1);
      std::uint64_t bits = 0;
      for (int x = 0; x <= count[0]; ++x)
      {
        bits |= static_cast<std::uint64_t>(test(row[x * stride])) << x;
      }
      const Corners joined = { (bits | bits >> 1) & 0xFFU, bits & bits >> 1 };
      if (y < count[1])
      {
        low.Any |= joined.Any << (8 * y);
        low.All |= joined.All << (8 * y);
      }
      if (y > 0)
      {
        high.Any |= joined.Any << (8 * (y - 1));
        high.All |= joined.All << (8 * (y - 1));
      }
    }
    return low.Join(high);
  }

  void Make(const Index3& block, BlockMask& mask) const
  {
    const Index3 first = { block[0] * BlockMask::Edge, block[1] * BlockMask::Edge,
      block[2] * BlockMask::Edge };
    const Index3& dimensions = this->TheSamples.GetDimensions();
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      count[axis] = std::min(BlockMask::Edge, dimensions[axis] - 1 - first[axis]);
    }
    const std::uint64_t row = (1U << count[0]) - 1U;
    std::uint64_t cells = 0;
    for (int y = 0; y < count[1]; ++y)
    {
      cells |= row << (8 * y);
    }
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    const auto forEachSlice = [&](const auto& test, const auto& use)
    {
      const T* sample = this->TheSamples.At(first);
      Corners below = JoinInPlane(sample, count, this->TheSamples, test);
      for (int z = 0; z < count[2]; ++z)
      {
        sample += this->TheSamples.GetStride(2);
        const Corners above = JoinInPlane(sample, count, this->TheSamples, test);
        use(mask.Slices[2][z], below.Join(above));
        below = above;
      }
    };
    for (const double isovalue : this->Isovalues)
    {
      // What no value reaches, or all do, may not be a number of the type either.
      constexpr std::numeric_limits<Compared> limits;
      if (!(isovalue > static_cast<double>(limits.lowest()) &&
            isovalue <= static_cast<double>(limits.max())))
      {
        continue;
      }
      const Compared threshold = GetThreshold(isovalue);
      forEachSlice([threshold](T value) { return static_cast<Compared>(value) >= threshold; },
        [cells](std::uint64_t& slice, const Corners& inside)
        { slice |= inside.Any & ~inside.All & cells; });
    }
    if constexpr (std::is_floating_point_v<T>)
    {
      forEachSlice([](T value) { return std::isfinite(value); },
        [](std::uint64_t& slice, const Corners& finite) { slice &= finite.All; });
    }
    mask.CompleteSlices();
  }

  Samples<T> TheSamples;
  Index3 Blocks;
  std::vector<double> Isovalues;
  std::vector<std::atomic<State>> States;
  std::unique_ptr<BlockMask, Free> Masks;
  std::atomic<std::size_t> Made{ 0 };
};

}

#endif
