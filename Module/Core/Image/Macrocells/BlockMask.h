// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BlockMask_h
#define BlockMask_h

#include "Math/Vector.h"

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// One bit for each member of a block of 8^3: cells, or bricks of them. The same bits are kept
/// three times, once for each major axis of a ray, so that a slice of the block across that axis is
/// one word.
struct alignas(64) BlockMask
{
  static constexpr int Edge = 8;
  /// The two axes of a slice across an axis: U counts bits within a byte, V counts bytes.
  static constexpr int U[3] = { 1, 0, 0 };
  static constexpr int V[3] = { 2, 2, 1 };

  std::uint64_t Slices[3][Edge];

  static Index3 GetFirstCell(const Index3& block)
  {
    return { block[0] * Edge, block[1] * Edge, block[2] * Edge };
  }

  bool IsEmpty() const
  {
    std::uint64_t any = 0;
    for (const std::uint64_t word : this->Slices[2])
    {
      any |= word;
    }
    return any == 0;
  }

  bool Has(const Index3& member) const
  {
    return (this->Slices[2][member[2]] >> (member[0] + Edge * member[1]) & 1) != 0;
  }

  /// Makes the slices across x and y from those across z.
  void CompleteSlices();
};

/// Transposes the 8 x 8 bits of a word: bit i of byte j becomes bit j of byte i. (H. S. Warren:
/// Hacker's Delight, section 7-3.)
inline std::uint64_t TransposeBits(std::uint64_t w)
{
  std::uint64_t t = (w ^ (w >> 7)) & 0x00AA00AA00AA00AAU;
  w ^= t ^ (t << 7);
  t = (w ^ (w >> 14)) & 0x0000CCCC0000CCCCU;
  w ^= t ^ (t << 14);
  t = (w ^ (w >> 28)) & 0x00000000F0F0F0F0U;
  return w ^ t ^ (t << 28);
}

/// One of three steps of a transposition: swaps the parts of words that lie Distance words and
/// bytes apart.
template <int Distance>
inline void SwapBytes(std::uint64_t words[8], std::uint64_t mask)
{
  for (int i = 0; i < 8; ++i)
  {
    if ((i & Distance) == 0)
    {
      std::uint64_t& low = words[i];
      std::uint64_t& high = words[i + Distance];
      const std::uint64_t t = ((low >> (8 * Distance)) ^ high) & mask;
      low ^= t << (8 * Distance);
      high ^= t;
    }
  }
}

/// Transposes the 8 x 8 bytes of eight words: byte i of word j becomes byte j of word i.
inline void TransposeBytes(std::uint64_t words[8])
{
  SwapBytes<1>(words, 0x00FF00FF00FF00FFU);
  SwapBytes<2>(words, 0x0000FFFF0000FFFFU);
  SwapBytes<4>(words, 0x00000000FFFFFFFFU);
}

inline void BlockMask::CompleteSlices()
{
  for (int z = 0; z < Edge; ++z)
  {
    this->Slices[1][z] = this->Slices[2][z];
    this->Slices[0][z] = TransposeBits(this->Slices[2][z]);
  }
  TransposeBytes(this->Slices[1]);
  TransposeBytes(this->Slices[0]);
}

}

#endif
