// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The lists of segments of neighbouring pixels, sorted and drawn side by side: a list in each lane.
// Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Calls exchange(i, k), i < k, for pairs of places so that all are in order at last if it puts
/// each pair in order. (Merge exchange: D. E. Knuth, The Art of Computer Programming, volume 3,
/// section 5.2.2, algorithm M.)
template <typename Exchange>
SIMD_INLINE void MergeExchange(int count, const Exchange& exchange)
{
  int most = 1;
  while (2 * most < count)
  {
    most *= 2;
  }
  for (int step = most; step > 0; step /= 2)
  {
    int rest = 0;
    int distance = step;
    for (int reach = most;; reach /= 2)
    {
      // Those places of which the bit of the step is that of the rest.
      for (int first = rest; first < count - distance; first += 2 * step)
      {
        const int end = SmallerOf(first + step, count - distance);
        for (int i = first; i < end; ++i)
        {
          exchange(i, i + distance);
        }
      }
      if (reach == step)
      {
        break;
      }
      distance = reach - step;
      rest = step;
    }
  }
}

/// Depths whose last bits number the places of segments, so that they are sorted together: as many
/// bits as the longest of some lists needs.
class DepthKeys
{
public:
  SIMD_INLINE explicit DepthKeys(int longest)
  {
    while (this->Bits + 1 < static_cast<std::uint64_t>(longest))
    {
      this->Bits = 2 * this->Bits + 1;
    }
  }

  SIMD_INLINE Doubles Make(const double* depths, int place) const
  {
    return ReplaceBits(Load(depths), this->Bits, static_cast<std::uint64_t>(place));
  }

  /// No segment that begins before a depth has a larger key.
  SIMD_INLINE double GetLargest(double depth) const
  {
    std::uint64_t word = 0;
    std::memcpy(&word, &depth, sizeof(word));
    word |= depth < Infinity ? this->Bits : 0;
    std::memcpy(&depth, &word, sizeof(word));
    return depth;
  }

  SIMD_INLINE void GetPlaces(const double* keys, int* places) const
  {
    std::uint64_t words[DoubleWidth];
    std::memcpy(words, keys, sizeof(words));
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      places[lane] = static_cast<int>(words[lane] & this->Bits);
    }
  }

private:
  std::uint64_t Bits = 0;
};

/// What is seen of a vector of rays.
struct RayColors
{
  Doubles Color[3];
  Doubles Transmittance;

  SIMD_INLINE RayColors(const TileLight& light, int pixel)
    : Transmittance(Load(&light.Transmittance[pixel]))
  {
    for (int i = 0; i < 3; ++i)
    {
      this->Color[i] = Load(&light.Color[i][pixel]);
    }
  }

  /// Adds what is seen on rays that are not opaque.
  SIMD_INLINE void Add(Mask lanes, const Doubles light[4])
  {
    const Mask isAdded = lanes & (NegligibleLight <= this->Transmittance);
    for (int i = 0; i < 3; ++i)
    {
      this->Color[i] =
        Select(isAdded, this->Color[i] + this->Transmittance * light[i], this->Color[i]);
    }
    this->Transmittance = Select(isAdded, this->Transmittance * light[3], this->Transmittance);
  }

  SIMD_INLINE void StoreLanes(Mask lanes, TileLight& light, int pixel) const
  {
    for (int i = 0; i < 3; ++i)
    {
      double* to = &light.Color[i][pixel];
      Store(Select(lanes, this->Color[i], Load(to)), to);
    }
    double* to = &light.Transmittance[pixel];
    Store(Select(lanes, this->Transmittance, Load(to)), to);
  }
};

/// A vector of floats: lists of neighbouring pixels.
class NeighbouringLists
{
public:
  SIMD_INLINE NeighbouringLists(const SegmentLists& lists, int pixel)
    : Lists(lists)
    , Pixel(pixel)
    , Longest(FindLongest(lists.Count + pixel))
    , Keys(this->Longest)
  {
  }

  SIMD_INLINE bool AreEmpty() const { return this->Longest == 0; }

  /// Puts the keys in order.
  SIMD_INLINE void Sort() const
  {
    double* keys = this->Lists.Keys;
    for (int half = 0; half < 2; ++half)
    {
      const Doubles counts = LoadIntegers(this->Lists.Count + this->Pixel + half * DoubleWidth);
      for (int i = 0; i < this->Longest; ++i)
      {
        const double* depths =
          this->Lists.Depth + this->Lists.GetIndex(this->Pixel + half * DoubleWidth, i);
        const Doubles place = i;
        Store(Select(place < counts, this->Keys.Make(depths, i), Doubles(Infinity)),
          keys + i * FloatWidth + half * DoubleWidth);
      }
    }
    MergeExchange(this->Longest,
      [keys](int i, int k)
      {
        for (int half = 0; half < 2; ++half)
        {
          double* one = keys + i * FloatWidth + half * DoubleWidth;
          double* other = keys + k * FloatWidth + half * DoubleWidth;
          const Doubles a = Load(one);
          const Doubles b = Load(other);
          Store(Min(a, b), one);
          Store(Max(a, b), other);
        }
      });
  }

  /// Draws those that begin before a depth, of some lanes. Returns which of them it could not,
  /// because the order is not sure.
  SIMD_INLINE unsigned int Draw(double before, unsigned int lanes, TileLight& light) const
  {
    RayColors rays[2] = { { light, this->Pixel }, { light, this->Pixel + DoubleWidth } };
    const Mask areAsked[2] = { ToMask(lanes & Half), ToMask(lanes >> DoubleWidth) };
    Mask areUnsure[2] = { FirstLanes(0), FirstLanes(0) };
    Doubles last[2] = { -Infinity, -Infinity };
    const Doubles largest = this->Keys.GetLargest(before);
    for (int i = 0; i < this->Longest; ++i)
    {
      const double* keys = this->Lists.Keys + i * FloatWidth;
      if (!Any(areAsked[0] & (Load(keys) <= largest)) &&
        !Any(areAsked[1] & (Load(keys + DoubleWidth) <= largest)))
      {
        break;
      }
      int at[FloatWidth];
      this->FindIndices(keys, at);
      float numbers[4][FloatWidth];
      this->LoadLights(at, numbers);
      for (int half = 0; half < 2; ++half)
      {
        const int lane = half * DoubleWidth;
        const Doubles depth = Gather(this->Lists.Depth, at + lane);
        const Mask isBefore = areAsked[half] & (depth < before) & (Load(keys + lane) < Infinity);
        // On rays that are opaque, too: an earlier one might have made them so.
        areUnsure[half] = areUnsure[half] | AndNot(isBefore, last[half] < depth);
        last[half] = depth;
        Doubles added[4];
        for (int k = 0; k < 4; ++k)
        {
          added[k] = LoadWidened(numbers[k] + lane);
        }
        rays[half].Add(isBefore, added);
      }
    }
    const unsigned int unsure = ToBits(areUnsure[0]) | ToBits(areUnsure[1]) << DoubleWidth;
    const unsigned int drawn = lanes & ~unsure;
    rays[0].StoreLanes(ToMask(drawn & Half), light, this->Pixel);
    rays[1].StoreLanes(ToMask(drawn >> DoubleWidth), light, this->Pixel + DoubleWidth);
    return unsure;
  }

private:
  static constexpr unsigned int Half = (1U << DoubleWidth) - 1U;

  SIMD_INLINE static int FindLongest(const int* counts)
  {
    int longest = 0;
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      longest = LargerOf(longest, counts[lane]);
    }
    return longest;
  }

  SIMD_INLINE void FindIndices(const double* keys, int* at) const
  {
    const int first = this->Lists.GetIndex(this->Pixel, 0);
    for (int half = 0; half < 2; ++half)
    {
      this->Keys.GetPlaces(keys + half * DoubleWidth, at + half * DoubleWidth);
    }
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      at[lane] = first + lane + at[lane] * CloudTile::Edge;
    }
  }

  SIMD_INLINE void LoadLights(const int* at, float (*numbers)[FloatWidth]) const
  {
    const float* rows[FloatWidth];
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      rows[lane] = this->Lists.Light[at[lane]].Color;
    }
    Floats loaded[4];
    LoadFours(rows, loaded);
    for (int k = 0; k < 4; ++k)
    {
      StoreFloats(loaded[k], numbers[k]);
    }
  }

  const SegmentLists& Lists;
  int Pixel;
  int Longest;
  DepthKeys Keys;
};

void KeepSegments(const SegmentLists& lists, int row, double from, unsigned int columns)
{
  const int pixel = row * CloudTile::Edge;
  int* counts = lists.Count + pixel;
  int longest = 0;
  int before[CloudTile::Edge];
  for (int column = 0; column < CloudTile::Edge; ++column)
  {
    before[column] = (columns >> column & 1U) != 0 ? counts[column] : 0;
    longest = LargerOf(longest, before[column]);
    counts[column] = 0;
  }
  for (int i = 0; i < longest; ++i)
  {
    const int first = lists.GetIndex(pixel, i);
    const Doubles place = i;
    unsigned int kept = 0;
    for (int column = 0; column < CloudTile::Edge; column += DoubleWidth)
    {
      const Mask isKept =
        (from <= Load(lists.Depth + first + column)) & (place < LoadIntegers(before + column));
      kept |= ToBits(isKept) << column;
    }
    // Few are, most often.
    for (; kept != 0; kept &= kept - 1)
    {
      const int column = LowestBit(kept);
      const int to = lists.GetIndex(pixel + column, counts[column]++);
      lists.Depth[to] = lists.Depth[first + column];
      lists.Light[to] = lists.Light[first + column];
    }
  }
}

unsigned int DrawSegments(
  const SegmentLists& lists, int row, double before, unsigned int columns, TileLight& light)
{
  constexpr unsigned int all = (1U << FloatWidth) - 1U;
  unsigned int unsure = 0;
  for (int first = 0; first < CloudTile::Edge; first += FloatWidth)
  {
    const NeighbouringLists some(lists, row * CloudTile::Edge + first);
    if ((columns >> first & all) != 0 && !some.AreEmpty())
    {
      some.Sort();
      unsure |= some.Draw(before, columns >> first & all, light) << first;
    }
  }
  return unsure;
}

}
}
