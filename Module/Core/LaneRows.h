// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rows of samples of any type, one in each lane of a vector, gathered as doubles. Included by
// Kernels.inl only, after Lanes.h and under the same rules.

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename T>
constexpr bool IsFloating = static_cast<T>(0.5) != 0;

/// One sample in each of the first lanes, at a place of the lane's row.
template <typename T>
LANES_INLINE Doubles LoadSamples(const void* const* rows, int lanes, std::ptrdiff_t place)
{
  double values[LaneCount] = {};
  for (int lane = 0; lane < lanes; ++lane)
  {
    values[lane] = static_cast<double>(static_cast<const T*>(rows[lane])[place]);
  }
  return Load(values);
}

#if defined(LANES_AVX512)
/// Neighbour k in words of 8 or 4 bytes that hold some each.
template <typename T>
LANES_INLINE Doubles TakeFromWords(__m512i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  if constexpr (IsFloating<T> && bits == 64)
  {
    return { _mm512_castsi512_pd(words) };
  }
  const __m512i high = _mm512_sll_epi64(words, _mm_cvtsi32_si128(64 - bits * (k + 1)));
  if constexpr (IsFloating<T>)
  {
    return { _mm512_cvtps_pd(
      _mm256_castsi256_ps(_mm512_cvtepi64_epi32(_mm512_srli_epi64(high, 32)))) };
  }
  if constexpr (static_cast<T>(-1) < 0)
  {
    return { _mm512_cvtepi64_pd(_mm512_srai_epi64(high, 64 - bits)) };
  }
  return { _mm512_cvtepu64_pd(_mm512_srli_epi64(high, 64 - bits)) };
}

template <typename T>
LANES_INLINE Doubles TakeFromWords(__m256i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i high = _mm256_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1)));
  return { _mm512_cvtepi32_pd(static_cast<T>(-1) < 0 ? _mm256_srai_epi32(high, 32 - bits)
                                                     : _mm256_srli_epi32(high, 32 - bits)) };
}
#endif

/// Neighbours along x in each of the first lanes, from a place of the lane's row on. Reads nothing
/// beside them.
template <typename T, int Count>
LANES_INLINE void LoadRow(const void* const* rows, int lanes, std::ptrdiff_t place,
  std::ptrdiff_t stride, Doubles values[Count])
{
#if defined(LANES_AVX512)
  if constexpr (Count * sizeof(T) > 8)
  {
    LoadRow<T, Count / 2>(rows, lanes, place, stride, values);
    LoadRow<T, Count / 2>(rows, lanes, place + Count / 2 * stride, stride, values + Count / 2);
    return;
  }
  else if constexpr (Count * sizeof(T) >= 4)
  {
    if (stride == 1)
    {
      const __mmask8 mask = FirstLanes(lanes).Value;
      const __m512i addresses = _mm512_add_epi64(_mm512_loadu_si512(rows),
        _mm512_set1_epi64(place * static_cast<std::ptrdiff_t>(sizeof(T))));
      if constexpr (Count * sizeof(T) == 8)
      {
        const __m512i words =
          _mm512_mask_i64gather_epi64(_mm512_setzero_si512(), mask, addresses, nullptr, 1);
        for (int k = 0; k < Count; ++k)
        {
          values[k] = TakeFromWords<T>(words, k);
        }
      }
      else
      {
        const __m256i words =
          _mm512_mask_i64gather_epi32(_mm256_setzero_si256(), mask, addresses, nullptr, 1);
        for (int k = 0; k < Count; ++k)
        {
          values[k] = TakeFromWords<T>(words, k);
        }
      }
      return;
    }
  }
#endif
  for (int k = 0; k < Count; ++k)
  {
    values[k] = LoadSamples<T>(rows, lanes, place + k * stride);
  }
}

}
}
