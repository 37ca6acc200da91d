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
template <typename T>
constexpr bool IsSigned = static_cast<T>(-1) < 0;

/// One sample in each of the first lanes, at a place of the lane's row. The other lanes have what
/// the first has.
template <typename T>
LANES_INLINE Doubles LoadSamples(const void* const* rows, int lanes, std::ptrdiff_t place)
{
  double values[LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    const void* row = rows[lane < lanes ? lane : 0];
    values[lane] = static_cast<double>(static_cast<const T*>(row)[place]);
  }
  return Load(values);
}

// Words of 8 or 4 bytes, one in each lane, that hold some samples each: loaded from as many bytes
// behind the beginnings of the rows, and turned into vectors of sample k.
#if defined(LANES_AVX512)

template <typename T>
constexpr bool HasWords = true;

template <int Size>
LANES_INLINE auto LoadWords(const void* const* rows, int lanes, std::ptrdiff_t bytes)
{
  const __mmask8 mask = FirstLanes(lanes).Value;
  const __m512i addresses = _mm512_add_epi64(_mm512_loadu_si512(rows), _mm512_set1_epi64(bytes));
  if constexpr (Size == 8)
  {
    return _mm512_mask_i64gather_epi64(_mm512_setzero_si512(), mask, addresses, nullptr, 1);
  }
  else
  {
    return _mm512_mask_i64gather_epi32(_mm256_setzero_si256(), mask, addresses, nullptr, 1);
  }
}

template <typename T>
LANES_INLINE Doubles TakeFromWords(__m512i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m512i high = _mm512_sll_epi64(words, _mm_cvtsi32_si128(64 - bits * (k + 1)));
  if constexpr (IsFloating<T> && bits == 64)
  {
    return { _mm512_castsi512_pd(words) };
  }
  else if constexpr (IsFloating<T>)
  {
    const __m256i values = _mm512_cvtepi64_epi32(_mm512_srli_epi64(high, 32));
    return { _mm512_cvtps_pd(_mm256_castsi256_ps(values)) };
  }
  else if constexpr (IsSigned<T>)
  {
    return { _mm512_cvtepi64_pd(_mm512_srai_epi64(high, 64 - bits)) };
  }
  else
  {
    return { _mm512_cvtepu64_pd(_mm512_srli_epi64(high, 64 - bits)) };
  }
}

template <typename T>
LANES_INLINE Doubles TakeFromWords(__m256i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i high = _mm256_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1)));
  return { _mm512_cvtepi32_pd(
    IsSigned<T> ? _mm256_srai_epi32(high, 32 - bits) : _mm256_srli_epi32(high, 32 - bits)) };
}

#elif defined(LANES_AVX2)

// There is no conversion from integers of more than 31 bits.
template <typename T>
constexpr bool HasWords = sizeof(T) <= 2 || (sizeof(T) == 4 && IsSigned<T>);

template <typename Word>
LANES_INLINE Word LoadWord(const void* row, std::ptrdiff_t bytes)
{
  Word word;
  __builtin_memcpy(&word, static_cast<const char*>(row) + bytes, sizeof(word));
  return word;
}

template <int Size>
LANES_INLINE auto LoadWords(const void* const* rows, int lanes, std::ptrdiff_t bytes)
{
  const void* row[LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    row[lane] = rows[lane < lanes ? lane : 0];
  }
  if constexpr (Size == 8)
  {
    return _mm256_set_epi64x(LoadWord<long long>(row[3], bytes), LoadWord<long long>(row[2], bytes),
      LoadWord<long long>(row[1], bytes), LoadWord<long long>(row[0], bytes));
  }
  else
  {
    return _mm_set_epi32(LoadWord<int>(row[3], bytes), LoadWord<int>(row[2], bytes),
      LoadWord<int>(row[1], bytes), LoadWord<int>(row[0], bytes));
  }
}

/// Of samples that are the highest bits of their words.
template <typename T>
LANES_INLINE Doubles ToDoubles(__m128i high)
{
  constexpr int bits = 8 * sizeof(T);
  if constexpr (IsFloating<T>)
  {
    return { _mm256_cvtps_pd(_mm_castsi128_ps(high)) };
  }
  else
  {
    return { _mm256_cvtepi32_pd(
      IsSigned<T> ? _mm_srai_epi32(high, 32 - bits) : _mm_srli_epi32(high, 32 - bits)) };
  }
}

template <typename T>
LANES_INLINE Doubles TakeFromWords(__m256i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i high = _mm256_sll_epi64(words, _mm_cvtsi32_si128(64 - bits * (k + 1)));
  const __m256i upperHalves = _mm256_set_epi32(7, 5, 3, 1, 7, 5, 3, 1);
  return ToDoubles<T>(_mm256_castsi256_si128(_mm256_permutevar8x32_epi32(high, upperHalves)));
}

template <typename T>
LANES_INLINE Doubles TakeFromWords(__m128i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  return ToDoubles<T>(_mm_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1))));
}

#endif

/// Neighbours along x in each of the first lanes, from a place of the lane's row on. Reads nothing
/// beside them.
template <typename T, int Count>
LANES_INLINE void LoadRow(const void* const* rows, int lanes, std::ptrdiff_t place,
  std::ptrdiff_t stride, Doubles values[Count])
{
#if defined(LANES_AVX512) || defined(LANES_AVX2)
  constexpr int size = Count * sizeof(T);
  if constexpr (HasWords<T> && size > 8)
  {
    LoadRow<T, Count / 2>(rows, lanes, place, stride, values);
    LoadRow<T, Count / 2>(rows, lanes, place + Count / 2 * stride, stride, values + Count / 2);
    return;
  }
  else if constexpr (HasWords<T> && size >= 4)
  {
    if (stride == 1)
    {
      const auto words =
        LoadWords<size>(rows, lanes, place * static_cast<std::ptrdiff_t>(sizeof(T)));
      for (int k = 0; k < Count; ++k)
      {
        values[k] = TakeFromWords<T>(words, k);
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

/// Two neighbours along x in each lane, in single precision. There must be a row for every lane.
template <typename T>
LANES_INLINE void LoadRoughPair(
  const void* const* rows, std::ptrdiff_t place, std::ptrdiff_t stride, Floats pair[2])
{
#if defined(LANES_AVX512)
  if constexpr (sizeof(T) == 2 || (IsFloating<T> && sizeof(T) == 4))
  {
    if (stride == 1)
    {
      constexpr int size = 2 * sizeof(T);
      const std::ptrdiff_t bytes = place * static_cast<std::ptrdiff_t>(sizeof(T));
      const auto low = LoadWords<size>(rows, LaneCount, bytes);
      const auto high = LoadWords<size>(rows + LaneCount, LaneCount, bytes);
      if constexpr (size == 4)
      {
        const __m512i words = _mm512_inserti32x8(_mm512_castsi256_si512(low), high, 1);
        const __m512i first = _mm512_slli_epi32(words, 16);
        pair[0] = { _mm512_cvtepi32_ps(
          IsSigned<T> ? _mm512_srai_epi32(first, 16) : _mm512_srli_epi32(first, 16)) };
        pair[1] = { _mm512_cvtepi32_ps(
          IsSigned<T> ? _mm512_srai_epi32(words, 16) : _mm512_srli_epi32(words, 16)) };
      }
      else
      {
        const __m512i even =
          _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
        const __m512i odd = _mm512_or_si512(even, _mm512_set1_epi32(1));
        const __m512 first = _mm512_castsi512_ps(low);
        const __m512 second = _mm512_castsi512_ps(high);
        pair[0] = { _mm512_permutex2var_ps(first, even, second) };
        pair[1] = { _mm512_permutex2var_ps(first, odd, second) };
      }
      return;
    }
  }
#endif
  Doubles low[2];
  Doubles high[2];
  LoadRow<T, 2>(rows, LaneCount, place, stride, low);
  LoadRow<T, 2>(rows + LaneCount, LaneCount, place, stride, high);
  pair[0] = Round(low[0], high[0]);
  pair[1] = Round(low[1], high[1]);
}

}
}
