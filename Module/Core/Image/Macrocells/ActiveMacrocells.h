// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ActiveMacrocells_h
#define ActiveMacrocells_h

#include "Math/ThreadsOfLoop.h"
#include "Math/Vector.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// How the cells of a volume form macrocells, and these larger ones.
struct MacrocellLattice
{
  struct Level
  {
    /// The number of macrocells.
    Index3 Size;
    /// The edge of a macrocell, in cells and in macrocells of the level below.
    int Edge;
    int Branching;
  };

  MacrocellLattice(const Index3& dimensions, const std::vector<int>& branching)
    : Cells{ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }
  {
    Index3 size = this->Cells;
    int edge = 1;
    for (const int branches : branching)
    {
      size = BlocksCovering(size, branches);
      // Larger than any volume is large enough, and its planes still have int coordinates.
      edge = static_cast<int>(std::min<std::int64_t>(std::int64_t{ edge } * branches, 1 << 30));
      this->Levels.push_back({ size, edge, branches });
    }
  }

  Index3 Cells;
  /// Finest first.
  std::vector<Level> Levels;
};

/// One bit for every macrocell: whether a surface of the selected isovalues may pass it. This is
/// all that a ray needs to know of the hierarchy, whatever the type of the samples.
class ActiveMacrocells
{
public:
  explicit ActiveMacrocells(const MacrocellLattice& lattice)
    : Lattice(lattice)
  {
    for (const MacrocellLattice::Level& level : lattice.Levels)
    {
      this->Bits.emplace_back((Count(level.Size) + 63) / 64);
    }
  }

  const MacrocellLattice& GetLattice() const { return this->Lattice; }

  bool IsActive(std::size_t level, const Index3& macrocell) const
  {
    const std::size_t bit = Offset(macrocell, this->Lattice.Levels[level].Size);
    return (this->Bits[level][bit / 64] >> (bit % 64) & 1) != 0;
  }

  /// Whether any is; without macrocells there may be surfaces anywhere.
  bool IsAnyActive() const
  {
    return this->Bits.empty() ||
      std::any_of(this->Bits.back().begin(), this->Bits.back().end(),
        [](std::uint64_t word) { return word != 0; });
  }

  /// The bits of the eight finest macrocells from first on along x, or of as many as there are.
  std::uint64_t GetRow(const Index3& first) const
  {
    const Index3& size = this->Lattice.Levels[0].Size;
    const std::size_t bit = Offset(first, size);
    const std::size_t shift = bit % 64;
    std::uint64_t row = this->Bits[0][bit / 64] >> shift;
    if (shift > 56 && bit / 64 + 1 < this->Bits[0].size())
    {
      row |= this->Bits[0][bit / 64 + 1] << (64 - shift);
    }
    return row & ((1U << std::min(8, size[0] - first[0])) - 1U);
  }

  /// Sets the bits of a level, in parallel, to what predicate says of each macrocell's number.
  template <typename Predicate>
  void Fill(std::size_t level, int threads, const Predicate& predicate)
  {
    std::vector<std::uint64_t>& bits = this->Bits[level];
    const auto words = static_cast<std::int64_t>(bits.size());
    const std::size_t count = Count(this->Lattice.Levels[level].Size);
#pragma omp parallel for num_threads(GetThreadsOfLoop(bits.size(), 100.0, threads))
    for (std::int64_t i = 0; i < words; ++i)
    {
      const auto word = static_cast<std::size_t>(i);
      std::uint64_t value = 0;
      for (std::size_t bit = 0; bit < 64 && word * 64 + bit < count; ++bit)
      {
        value |= static_cast<std::uint64_t>(predicate(word * 64 + bit)) << bit;
      }
      bits[word] = value;
    }
  }

private:
  MacrocellLattice Lattice;
  std::vector<std::vector<std::uint64_t>> Bits;
};

}

#endif
