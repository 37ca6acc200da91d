// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellMasks_h
#define CellMasks_h

#include "Image/Macrocells/BlockMask.h"
#include "Image/Samples/BlockCache.h"
#include "Image/Samples/VolumeView.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// For blocks of 8^3 cells, which of the cells a surface passes: those with corners on both sides
/// of an isovalue and none that is NaN or infinite, if they are not hidden. The mask of a block is
/// made by the first ray that needs it.
template <typename T>
class CellMasks
{
public:
  explicit CellMasks(const Samples<T>& samples)
    : TheSamples(samples)
    , Blocks(BlocksCovering({ samples.GetDimensions()[0] - 1, samples.GetDimensions()[1] - 1,
                              samples.GetDimensions()[2] - 1 },
        BlockMask::Edge))
    , Masks(Count(this->Blocks), sizeof(BlockMask))
  {
  }

  void BeginFrame(std::size_t maximumMemory) { this->Masks.BeginFrame(maximumMemory); }

  /// Makes the mask of a block by another rule.
  using Maker = std::function<void(const Index3& block, BlockMask& mask)>;

  /// Discards all masks, and sets the isovalues for new ones; hidden cells (see Visibility), and
  /// another rule, if there are any.
  void Select(const std::vector<double>& isovalues, const unsigned char* hiddenCells = nullptr,
    Maker maker = nullptr)
  {
    this->Isovalues = isovalues;
    this->HiddenCells = hiddenCells;
    this->MakeOther = std::move(maker);
    this->Masks.Clear();
  }

  void Prefetch(const Index3& block) const { this->Masks.Prefetch(Offset(block, this->Blocks)); }

  /// The mask of a block: the one that is kept or, where it cannot be kept, one made in own.
  const BlockMask& Get(const Index3& block, BlockMask& own)
  {
    const void* kept = this->Masks.Get(Offset(block, this->Blocks),
      [this, &block](void* memory) { this->Make(block, *new (memory) BlockMask); });
    if (kept)
    {
      return *static_cast<const BlockMask*>(kept);
    }
    this->Make(block, own);
    return own;
  }

  /// Finds the cells of a block with corners on both sides of an isovalue, in the slices across z
  /// alone. A corner that is NaN is outside.
  void FindStraddling(const Index3& block, BlockMask& mask) const
  {
    const BlockCells cells = this->GetCells(block);
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    for (const double isovalue : this->Isovalues)
    {
      // A bound that no value reaches, or that all reach, may not be a number of the type; nor is
      // NaN.
      constexpr std::numeric_limits<Compared> limits;
      if (!(isovalue > static_cast<double>(limits.lowest()) &&
            isovalue <= static_cast<double>(limits.max())))
      {
        continue;
      }
      this->ForEachSlice(cells, IsAtLeast{ GetThreshold(isovalue) }, mask,
        [&cells](std::uint64_t& slice, const Corners& inside)
        { slice |= inside.Any & ~inside.All & cells.Slice; });
    }
  }

  /// Finds the cells of a block with a corner above (or below) a value and none that is NaN or
  /// infinite. The mask is not kept.
  void FindBeyond(const Index3& block, double value, bool isAbove, BlockMask& mask) const
  {
    const BlockCells cells = this->GetCells(block);
    const double bound =
      isAbove ? std::nextafter(value, std::numeric_limits<double>::infinity()) : value;
    constexpr std::numeric_limits<Compared> limits;
    const bool areAllInside = !(bound > static_cast<double>(limits.lowest()));
    std::fill_n(mask.Slices[2], BlockMask::Edge, 0U);
    if (areAllInside || bound > static_cast<double>(limits.max()))
    {
      std::fill_n(mask.Slices[2], cells.Count[2], areAllInside == isAbove ? cells.Slice : 0U);
    }
    else
    {
      this->ForEachSlice(cells, IsAtLeast{ GetThreshold(bound) }, mask,
        [&cells, isAbove](std::uint64_t& slice, const Corners& inside)
        { slice = (isAbove ? inside.Any : ~inside.All) & cells.Slice; });
    }
    this->RemoveInfinite(cells, mask);
    mask.CompleteSlices();
  }

  /// In bytes.
  std::size_t GetMemory() const { return this->Masks.GetMemory(); }

private:
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

  /// What eight values around a cell have in common, combined one axis after the other.
  struct Corners
  {
    std::uint64_t Any = 0;
    std::uint64_t All = 0;

    Corners Join(const Corners& other) const
    {
      return { this->Any | other.Any, this->All & other.All };
    }
  };

  // Tests of a sample, and of eight at once, whose answers are 0 or -1 each.
  struct IsAtLeast
  {
    Compared Threshold;

    bool operator()(Compared value) const { return value >= this->Threshold; }

    template <typename Values, typename Answers>
    void Test(const Values& values, Answers& answers) const
    {
      Convert(values >= this->Threshold, answers);
    }
  };

  struct IsFinite
  {
    bool operator()(Compared value) const { return value - value == 0; }

    template <typename Values, typename Answers>
    void Test(const Values& values, Answers& answers) const
    {
      Convert(values - values == 0, answers);
    }
  };

  /// One bit for each of a row of samples that passes a test: of nine, or of less at the border of
  /// the volume.
  template <typename Test>
  static unsigned int TestRow(const T* row, std::ptrdiff_t stride, int count, const Test& test)
  {
    unsigned int bits = 0;
    if constexpr (std::is_same_v<Compared, T> && sizeof(T) <= 4)
    {
      if (stride == 1 && count == BlockMask::Edge)
      {
        typename ShortVector<T, 8>::Type values;
        std::memcpy(&values, row, sizeof(values));
        ShortVector<signed char, 8>::Type answers;
        test.Test(values, answers);
        unsigned char bytes[8];
        std::memcpy(bytes, &answers, sizeof(bytes));
        // The product gathers the lowest bits of the bytes in the highest byte.
        bits = static_cast<unsigned int>(
          (ToWord(bytes) & 0x0101010101010101U) * 0x0102040810204080U >> 56);
        return bits | static_cast<unsigned int>(test(row[8])) << 8;
      }
    }
    for (int x = 0; x <= count; ++x)
    {
      bits |= static_cast<unsigned int>(test(static_cast<Compared>(row[x * stride]))) << x;
    }
    return bits;
  }

  /// For the cells of a plane of samples, whether any and whether all of the four samples around
  /// them pass a test.
  template <typename Test>
  static Corners JoinInPlane(
    const T* plane, const Index3& count, const Samples<T>& samples, const Test& test)
  {
    // A byte for every row.
    unsigned char any[BlockMask::Edge + 1] = {};
    unsigned char all[BlockMask::Edge + 1] = {};
    for (int y = 0; y <= count[1]; ++y)
    {
      const unsigned int bits =
        TestRow(plane + y * samples.GetStride(1), samples.GetStride(0), count[0], test);
      any[y] = static_cast<unsigned char>(bits | bits >> 1);
      all[y] = static_cast<unsigned char>(bits & bits >> 1);
    }
    return { ToWord(any) | ToWord(any + 1), ToWord(all) & ToWord(all + 1) };
  }

  /// Eight bytes as a word, the first one lowest.
  static std::uint64_t ToWord(const unsigned char* bytes)
  {
    std::uint64_t word;
    std::memcpy(&word, bytes, sizeof(word));
    return FromLittleEndian(word);
  }

  /// The cells of a block: less than 8^3 at the border of the volume.
  struct BlockCells
  {
    Index3 First;
    Index3 Count;
    /// Those of a slice across z.
    std::uint64_t Slice;
  };

  BlockCells GetCells(const Index3& block) const
  {
    BlockCells cells;
    cells.First = BlockMask::GetFirstCell(block);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cells.Count[axis] =
        std::min(BlockMask::Edge, this->TheSamples.GetDimensions()[axis] - 1 - cells.First[axis]);
    }
    const std::uint64_t row = (1U << cells.Count[0]) - 1U;
    cells.Slice = 0;
    for (int y = 0; y < cells.Count[1]; ++y)
    {
      cells.Slice |= row << (8 * y);
    }
    return cells;
  }

  /// Calls use(slice, corners) for the slices across z, with what the corners of their cells have
  /// in common by a test.
  template <typename Test, typename Use>
  void ForEachSlice(
    const BlockCells& cells, const Test& test, BlockMask& mask, const Use& use) const
  {
    const T* sample = this->TheSamples.At(cells.First);
    Corners below = JoinInPlane(sample, cells.Count, this->TheSamples, test);
    for (int z = 0; z < cells.Count[2]; ++z)
    {
      sample += this->TheSamples.GetStride(2);
      const Corners above = JoinInPlane(sample, cells.Count, this->TheSamples, test);
      use(mask.Slices[2][z], below.Join(above));
      below = above;
    }
  }

  void RemoveInfinite(const BlockCells& cells, BlockMask& mask) const
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      this->ForEachSlice(cells, IsFinite{}, mask,
        [](std::uint64_t& slice, const Corners& finite) { slice &= finite.All; });
    }
  }

  void Make(const Index3& block, BlockMask& mask) const
  {
    if (this->MakeOther)
    {
      this->MakeOther(block, mask);
      this->Hide(block, mask);
      mask.CompleteSlices();
      return;
    }
    this->FindStraddling(block, mask);
    this->RemoveInfinite(this->GetCells(block), mask);
    this->Hide(block, mask);
    mask.CompleteSlices();
  }

  /// Takes hidden cells out of the slices across z.
  void Hide(const Index3& block, BlockMask& mask) const
  {
    if (!this->HiddenCells)
    {
      return;
    }
    const Index3& points = this->TheSamples.GetDimensions();
    const Index3 cells = { points[0] - 1, points[1] - 1, points[2] - 1 };
    const Index3 first = BlockMask::GetFirstCell(block);
    for (int z = 0; z < BlockMask::Edge; ++z)
    {
      std::uint64_t& slice = mask.Slices[2][z];
      for (std::uint64_t left = slice; left != 0; left &= left - 1)
      {
        const int bit = LowestBit(left);
        const Index3 cell = { first[0] + bit % BlockMask::Edge, first[1] + bit / BlockMask::Edge,
          first[2] + z };
        if (this->HiddenCells[Offset(cell, cells)] != 0)
        {
          slice &= ~(std::uint64_t{ 1 } << bit);
        }
      }
    }
  }

  Samples<T> TheSamples;
  Index3 Blocks;
  std::vector<double> Isovalues;
  const unsigned char* HiddenCells = nullptr;
  Maker MakeOther;
  BlockCache Masks;
};

}

#endif
