// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The vectors of AVX-512. Included by Vectors.h only.

#include <immintrin.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int DoubleWidth = 8;

/// A truth value for each lane.
struct Mask
{
  __mmask8 Value;
};

/// Converts from double, so that arithmetic reads as for one number.
struct Doubles
{
  Doubles() = default;
  SIMD_INLINE Doubles(__m512d value)
    : Value(value)
  {
  }
  SIMD_INLINE Doubles(double value)
    : Value(_mm512_set1_pd(value))
  {
  }

  __m512d Value;
};

SIMD_INLINE Mask operator&(Mask a, Mask b)
{
  return { _kand_mask8(a.Value, b.Value) };
}
SIMD_INLINE Mask operator|(Mask a, Mask b)
{
  return { _kor_mask8(a.Value, b.Value) };
}
SIMD_INLINE Mask operator^(Mask a, Mask b)
{
  return { _kxor_mask8(a.Value, b.Value) };
}
SIMD_INLINE Mask AndNot(Mask a, Mask b)
{
  return { _kandn_mask8(b.Value, a.Value) };
}
SIMD_INLINE unsigned int ToBits(Mask a)
{
  return a.Value;
}
SIMD_INLINE Mask FirstLanes(int count)
{
  return { static_cast<__mmask8>((1U << count) - 1U) };
}

SIMD_INLINE Doubles Load(const double* a)
{
  return { _mm512_loadu_pd(a) };
}
SIMD_INLINE void Store(Doubles a, double* to)
{
  _mm512_storeu_pd(to, a.Value);
}
SIMD_INLINE Doubles LoadIntegers(const int* a)
{
  return { _mm512_cvtepi32_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(a))) };
}
/// Rounded towards zero.
SIMD_INLINE void StoreTruncated(Doubles a, int* to)
{
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvttpd_epi32(a.Value));
}
/// Not by the instruction of that name; see LoadWords.
SIMD_INLINE Doubles Gather(const double* from, const int* indices)
{
  return { _mm512_set_pd(from[indices[7]], from[indices[6]], from[indices[5]], from[indices[4]],
    from[indices[3]], from[indices[2]], from[indices[1]], from[indices[0]]) };
}
SIMD_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { _mm512_add_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { _mm512_sub_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { _mm512_mul_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { _mm512_div_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { _mm512_fmadd_pd(a.Value, b.Value, c.Value) };
}
SIMD_INLINE Doubles Sqrt(Doubles a)
{
  return { _mm512_sqrt_pd(a.Value) };
}
SIMD_INLINE Doubles Abs(Doubles a)
{
  return { _mm512_abs_pd(a.Value) };
}
SIMD_INLINE Doubles Floor(Doubles a)
{
  return { _mm512_floor_pd(a.Value) };
}
SIMD_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  const __m512i sign = _mm512_set1_epi64(static_cast<long long>(0x8000000000000000U));
  return { _mm512_castsi512_pd(_mm512_ternarylogic_epi64(
    sign, _mm512_castpd_si512(b.Value), _mm512_castpd_si512(a.Value), 0xCA)) };
}
/// Those of the bits that are in a mask are replaced by others.
SIMD_INLINE Doubles ReplaceBits(Doubles a, std::uint64_t mask, std::uint64_t bits)
{
  return { _mm512_castsi512_pd(
    _mm512_ternarylogic_epi64(_mm512_set1_epi64(static_cast<long long>(mask)),
      _mm512_set1_epi64(static_cast<long long>(bits)), _mm512_castpd_si512(a.Value), 0xCA)) };
}
SIMD_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_LT_OQ) };
}
SIMD_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_LE_OQ) };
}
SIMD_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_EQ_OQ) };
}
SIMD_INLINE Doubles Min(Doubles a, Doubles b)
{
  return { _mm512_min_pd(b.Value, a.Value) };
}
SIMD_INLINE Doubles Max(Doubles a, Doubles b)
{
  return { _mm512_max_pd(b.Value, a.Value) };
}
SIMD_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { _mm512_mask_mov_pd(no.Value, mask.Value, yes.Value) };
}

/// The smallest of the lanes.
SIMD_INLINE double ReduceMin(Doubles a)
{
  return _mm512_reduce_min_pd(a.Value);
}
/// From a bit for each lane.
SIMD_INLINE Mask ToMask(unsigned int bits)
{
  return { static_cast<__mmask8>(bits) };
}
/// Stores pairs in single precision.
SIMD_INLINE void StorePairs(Doubles first, Doubles second, float (*pairs)[2])
{
  const __m512i indices = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
  _mm512_storeu_ps(pairs,
    _mm512_permutex2var_ps(_mm512_castps256_ps512(_mm512_cvtpd_ps(first.Value)), indices,
      _mm512_castps256_ps512(_mm512_cvtpd_ps(second.Value))));
}
/// Appends the numbers of some lanes, counted from the first. There must be room for a vector.
SIMD_INLINE int AppendLanes(int first, unsigned int lanes, int* numbers)
{
  const __m256i all =
    _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(numbers),
    _mm256_maskz_compress_epi32(static_cast<__mmask8>(lanes), all));
  return __builtin_popcount(lanes);
}

/// Stores some lanes, one after the other. There must be room for a vector.
SIMD_INLINE void StoreLanes(Doubles a, unsigned int lanes, double* to)
{
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd(static_cast<__mmask8>(lanes), a.Value));
}

/// The same for integers in memory. Returns how many.
SIMD_INLINE int CopyLanes(const int* from, unsigned int lanes, int* to)
{
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
    _mm256_maskz_compress_epi32(
      static_cast<__mmask8>(lanes), _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from))));
  return __builtin_popcount(lanes);
}

/// Four numbers for each lane, each of them in a vector.
SIMD_INLINE void LoadFours(const double* const from[DoubleWidth], Doubles to[4])
{
  __m512d rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = _mm512_insertf64x4(
      _mm512_castpd256_pd512(_mm256_loadu_pd(from[i])), _mm256_loadu_pd(from[4 + i]), 1);
  }
  const __m512d low[2] = { _mm512_unpacklo_pd(rows[0], rows[1]),
    _mm512_unpacklo_pd(rows[2], rows[3]) };
  const __m512d high[2] = { _mm512_unpackhi_pd(rows[0], rows[1]),
    _mm512_unpackhi_pd(rows[2], rows[3]) };
  const __m512i first = _mm512_set_epi64(13, 12, 5, 4, 9, 8, 1, 0);
  const __m512i second = _mm512_set_epi64(15, 14, 7, 6, 11, 10, 3, 2);
  to[0] = { _mm512_permutex2var_pd(low[0], first, low[1]) };
  to[1] = { _mm512_permutex2var_pd(high[0], first, high[1]) };
  to[2] = { _mm512_permutex2var_pd(low[0], second, low[1]) };
  to[3] = { _mm512_permutex2var_pd(high[0], second, high[1]) };
}

/// Four numbers of each lane, in a row for each: rows are so many numbers apart.
SIMD_INLINE void StoreFours(const Doubles from[4], double* to, int stride)
{
  const __m512d low[2] = { _mm512_unpacklo_pd(from[0].Value, from[1].Value),
    _mm512_unpacklo_pd(from[2].Value, from[3].Value) };
  const __m512d high[2] = { _mm512_unpackhi_pd(from[0].Value, from[1].Value),
    _mm512_unpackhi_pd(from[2].Value, from[3].Value) };
  const __m512i first = _mm512_set_epi64(11, 10, 3, 2, 9, 8, 1, 0);
  const __m512i second = _mm512_set_epi64(15, 14, 7, 6, 13, 12, 5, 4);
  const __m512d pairs[4] = { _mm512_permutex2var_pd(low[0], first, low[1]),
    _mm512_permutex2var_pd(high[0], first, high[1]), _mm512_permutex2var_pd(low[0], second, low[1]),
    _mm512_permutex2var_pd(high[0], second, high[1]) };
  for (int i = 0; i < 4; ++i)
  {
    double* row = to + stride * (i / 2 * 4 + i % 2);
    _mm256_storeu_pd(row, _mm512_castpd512_pd256(pairs[i]));
    _mm256_storeu_pd(row + 2 * stride, _mm512_extractf64x4_pd(pairs[i], 1));
  }
}

constexpr int FloatWidth = 16;

struct FloatMask
{
  __mmask16 Value;
};

/// Converts from float, so that arithmetic reads as for one number.
struct Floats
{
  Floats() = default;
  SIMD_INLINE Floats(__m512 value)
    : Value(value)
  {
  }
  SIMD_INLINE Floats(float value)
    : Value(_mm512_set1_ps(value))
  {
  }

  __m512 Value;
};

SIMD_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { _kand_mask16(a.Value, b.Value) };
}
SIMD_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { _kor_mask16(a.Value, b.Value) };
}
SIMD_INLINE unsigned int ToBits(FloatMask a)
{
  return a.Value;
}
SIMD_INLINE Floats LoadFloats(const float* a)
{
  return { _mm512_loadu_ps(a) };
}
SIMD_INLINE void StoreFloats(Floats a, float* to)
{
  _mm512_storeu_ps(to, a.Value);
}
SIMD_INLINE Floats Select(FloatMask mask, Floats yes, Floats no)
{
  return { _mm512_mask_mov_ps(no.Value, mask.Value, yes.Value) };
}
/// What two vectors of doubles hold, rounded.
SIMD_INLINE Floats Round(Doubles low, Doubles high)
{
  return { _mm512_insertf32x8(
    _mm512_castps256_ps512(_mm512_cvtpd_ps(low.Value)), _mm512_cvtpd_ps(high.Value), 1) };
}
/// In single precision.
SIMD_INLINE void StoreRounded(Doubles a, float* to)
{
  _mm256_storeu_ps(to, _mm512_cvtpd_ps(a.Value));
}
SIMD_INLINE Doubles LoadWidened(const float* a)
{
  return { _mm512_cvtps_pd(_mm256_loadu_ps(a)) };
}
SIMD_INLINE Floats operator+(Floats a, Floats b)
{
  return { _mm512_add_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator-(Floats a, Floats b)
{
  return { _mm512_sub_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator*(Floats a, Floats b)
{
  return { _mm512_mul_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator/(Floats a, Floats b)
{
  return { _mm512_div_ps(a.Value, b.Value) };
}
/// a b + c, rounded once or twice.
SIMD_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { _mm512_fmadd_ps(a.Value, b.Value, c.Value) };
}
SIMD_INLINE Floats Abs(Floats a)
{
  return { _mm512_abs_ps(a.Value) };
}
SIMD_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { _mm512_cmp_ps_mask(a.Value, b.Value, _CMP_LT_OQ) };
}
SIMD_INLINE Floats Min(Floats a, Floats b)
{
  return { _mm512_min_ps(b.Value, a.Value) };
}
SIMD_INLINE Floats Max(Floats a, Floats b)
{
  return { _mm512_max_ps(b.Value, a.Value) };
}
/// The smallest of the lanes.
SIMD_INLINE float ReduceMin(Floats a)
{
  return _mm512_reduce_min_ps(a.Value);
}
/// The larger of two magnitudes.
SIMD_INLINE Floats MaxAbs(Floats a, Floats b)
{
  return { _mm512_range_ps(a.Value, b.Value, 0x0B) };
}
SIMD_INLINE Floats CopySign(Floats a, Floats b)
{
  const __m512i sign = _mm512_set1_epi32(static_cast<int>(0x80000000U));
  return { _mm512_castsi512_ps(_mm512_ternarylogic_epi32(
    sign, _mm512_castps_si512(b.Value), _mm512_castps_si512(a.Value), 0xCA)) };
}
/// Of the bits alone: zeros have a sign too.
SIMD_INLINE FloatMask HaveDifferentSigns(Floats a, Floats b)
{
  return { _mm512_movepi32_mask(
    _mm512_xor_si512(_mm512_castps_si512(a.Value), _mm512_castps_si512(b.Value))) };
}
SIMD_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { _kandn_mask16(b.Value, a.Value) };
}
/// 1 / a to some twenty bits.
SIMD_INLINE Floats ApproximateReciprocal(Floats a)
{
  const __m512 first = _mm512_rcp14_ps(a.Value);
  return { _mm512_mul_ps(first, _mm512_fnmadd_ps(a.Value, first, _mm512_set1_ps(2.0F))) };
}
/// Some bits of each word.
SIMD_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  return { _mm512_cvtepi32_ps(
    _mm512_and_si512(_mm512_srl_epi32(_mm512_loadu_si512(words), _mm_cvtsi32_si128(shift)),
      _mm512_set1_epi32(static_cast<int>(mask)))) };
}
SIMD_INLINE Floats LoadBytes(const std::uint8_t* a)
{
  return { _mm512_cvtepi32_ps(
    _mm512_cvtepu8_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a)))) };
}
/// Of each four lanes, takes the first of the rows to the first vector, and so on.
SIMD_INLINE void TransposeFours(const Floats rows[4], Floats to[4])
{
  const __m512d low[2] = { _mm512_castps_pd(_mm512_unpacklo_ps(rows[0].Value, rows[1].Value)),
    _mm512_castps_pd(_mm512_unpacklo_ps(rows[2].Value, rows[3].Value)) };
  const __m512d high[2] = { _mm512_castps_pd(_mm512_unpackhi_ps(rows[0].Value, rows[1].Value)),
    _mm512_castps_pd(_mm512_unpackhi_ps(rows[2].Value, rows[3].Value)) };
  to[0] = { _mm512_castpd_ps(_mm512_unpacklo_pd(low[0], low[1])) };
  to[1] = { _mm512_castpd_ps(_mm512_unpackhi_pd(low[0], low[1])) };
  to[2] = { _mm512_castpd_ps(_mm512_unpacklo_pd(high[0], high[1])) };
  to[3] = { _mm512_castpd_ps(_mm512_unpackhi_pd(high[0], high[1])) };
}
/// Four numbers for each lane, each of them in a vector: from one on.
SIMD_INLINE void LoadFours(const float* const from[FloatWidth], Floats to[4], int at = 0)
{
  Floats rows[4];
  for (int i = 0; i < 4; ++i)
  {
    __m512 row = _mm512_castps128_ps512(_mm_loadu_ps(from[i] + at));
    row = _mm512_insertf32x4(row, _mm_loadu_ps(from[4 + i] + at), 1);
    row = _mm512_insertf32x4(row, _mm_loadu_ps(from[8 + i] + at), 2);
    rows[i] = { _mm512_insertf32x4(row, _mm_loadu_ps(from[12 + i] + at), 3) };
  }
  TransposeFours(rows, to);
}
/// Four numbers of each lane, those of the first lane first.
SIMD_INLINE void StoreFours(const Floats from[4], float* to)
{
  Floats rows[4];
  TransposeFours(from, rows);
  for (int i = 0; i < 4; ++i)
  {
    _mm_storeu_ps(to + 4 * i, _mm512_castps512_ps128(rows[i].Value));
    _mm_storeu_ps(to + 16 + 4 * i, _mm512_extractf32x4_ps(rows[i].Value, 1));
    _mm_storeu_ps(to + 32 + 4 * i, _mm512_extractf32x4_ps(rows[i].Value, 2));
    _mm_storeu_ps(to + 48 + 4 * i, _mm512_extractf32x4_ps(rows[i].Value, 3));
  }
}

//------------------------------------------------------------------------------
/// Whether samples of a type are loaded in words of 8, 4 or 2 bytes, one in each lane, that hold
/// some of them.
template <typename T>
constexpr bool HasWords = true;

/// Words of so many bytes, from as many bytes behind the beginnings of the rows. Instructions that
/// gather them are slower: by 5 % of a trace on AMD's Zen 5, and by far on Intel's processors with
/// the mitigation of Gather Data Sampling.
template <int Size>
SIMD_INLINE auto LoadWords(const void* const* rows, std::ptrdiff_t bytes)
{
  using Word = WordOf<Size>;
  if constexpr (Size == 8)
  {
    return _mm512_set_epi64(LoadWord<Word>(rows[7], bytes), LoadWord<Word>(rows[6], bytes),
      LoadWord<Word>(rows[5], bytes), LoadWord<Word>(rows[4], bytes),
      LoadWord<Word>(rows[3], bytes), LoadWord<Word>(rows[2], bytes),
      LoadWord<Word>(rows[1], bytes), LoadWord<Word>(rows[0], bytes));
  }
  else
  {
    return _mm256_set_epi32(LoadWord<Word>(rows[7], bytes), LoadWord<Word>(rows[6], bytes),
      LoadWord<Word>(rows[5], bytes), LoadWord<Word>(rows[4], bytes),
      LoadWord<Word>(rows[3], bytes), LoadWord<Word>(rows[2], bytes),
      LoadWord<Word>(rows[1], bytes), LoadWord<Word>(rows[0], bytes));
  }
}

/// Sample k of each word.
template <typename T>
SIMD_INLINE Doubles TakeFromWords(__m512i words, int k)
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
SIMD_INLINE Doubles TakeFromWords(__m256i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i high = _mm256_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1)));
  return { _mm512_cvtepi32_pd(
    IsSigned<T> ? _mm256_srai_epi32(high, 32 - bits) : _mm256_srli_epi32(high, 32 - bits)) };
}

/// Sample k of each word, in single precision: of two integers...
template <typename T>
SIMD_INLINE Floats TakeFromWords(__m256i low, __m256i high, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m512i words = _mm512_inserti32x8(_mm512_castsi256_si512(low), high, 1);
  const __m512i highest = _mm512_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1)));
  return { _mm512_cvtepi32_ps(
    IsSigned<T> ? _mm512_srai_epi32(highest, 32 - bits) : _mm512_srli_epi32(highest, 32 - bits)) };
}

/// ...or of two floats.
template <typename T>
SIMD_INLINE Floats TakeFromWords(__m512i low, __m512i high, int k)
{
  const __m512i even = _mm512_set_epi32(30, 28, 26, 24, 22, 20, 18, 16, 14, 12, 10, 8, 6, 4, 2, 0);
  return { _mm512_permutex2var_ps(_mm512_castsi512_ps(low),
    _mm512_or_si512(even, _mm512_set1_epi32(k)), _mm512_castsi512_ps(high)) };
}

//------------------------------------------------------------------------------
/// The eight slices of a block of cells, with a bit for each cell.
using SliceMasks = __m512i;

SIMD_INLINE SliceMasks LoadSlices(const std::uint64_t slices[8])
{
  return _mm512_loadu_si512(slices);
}

/// Finds the cells of one ray in a block, of those in the masks: slice by slice the rectangle of
/// cells between the crossings with the two planes of the slice, and a margin around it. The ray is
/// given by its coordinates across the axis in the middle plane of the block, counted from the
/// first cell, and its slopes. Returns which slices have any.
SIMD_INLINE unsigned int FindCellsOfRay(const float middle[2], const float slope[2], float margin,
  SliceMasks slices, std::uint64_t cells[8])
{
  // All slices at once: in the lower half of a register for u, in the upper half for v.
  const __m512 planes = _mm512_set_ps(3.0F, 2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F, 3.0F,
    2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F);
  const __m512 margins = _mm512_set1_ps(margin);
  const auto spread = [](const float pair[2])
  { return _mm512_mask_blend_ps(0xFF00, _mm512_set1_ps(pair[0]), _mm512_set1_ps(pair[1])); };
  const __m512 slopes = spread(slope);
  const __m512 near = _mm512_fmadd_ps(planes, slopes, spread(middle));
  const __m512 far = _mm512_add_ps(near, slopes);
  const __m512 least = _mm512_sub_ps(_mm512_min_ps(near, far), margins);
  const __m512 most = _mm512_add_ps(_mm512_max_ps(near, far), margins);
  const __m512i seven = _mm512_set1_epi32(7);
  const __m512i low = _mm512_max_epi32(_mm512_cvttps_epi32(least), _mm512_setzero_si512());
  const __m512i high = _mm512_sub_epi32(seven,
    _mm512_min_epi32(
      _mm512_cvt_roundps_epi32(most, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC), seven));

  const __m512i byte = _mm512_set1_epi32(0xFF);
  const __m512i bits = _mm512_ternarylogic_epi32(
    _mm512_sllv_epi32(byte, low), _mm512_srlv_epi32(byte, high), byte, 0x80);
  const __m512i columns = _mm512_shuffle_epi8(_mm512_cvtepu32_epi64(_mm512_castsi512_si256(bits)),
    _mm512_set4_epi32(0x08080808, 0x08080808, 0x00000000, 0x00000000));
  const __m128i rowBits = _mm256_cvtepi32_epi8(_mm512_extracti64x4_epi64(bits, 1));
  const __mmask64 rows = static_cast<__mmask64>(_mm_cvtsi128_si64(rowBits));
  const __m512i found = _mm512_maskz_mov_epi8(rows, _mm512_and_si512(slices, columns));
  _mm512_storeu_si512(cells, found);
  return _mm512_test_epi64_mask(found, found);
}

SIMD_INLINE __m512 LoadEightTwice(const float* from)
{
  const __m256 eight = _mm256_loadu_ps(from);
  return _mm512_insertf32x8(_mm512_castps256_ps512(eight), eight, 1);
}

/// The cells between planes that the ranges of eight slices meet, a byte for each slice. The ranges
/// are in eight lanes from the first on.
SIMD_INLINE __mmask64 FindMetCells(__m512 least, __m512 most, int first, const float planes[9])
{
  const __m512 lower = LoadEightTwice(planes);
  const __m512 upper = LoadEightTwice(planes + 1);
  const __m512i firstTwo = _mm512_set_epi32(1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0);
  __mmask16 met[4];
  for (int i = 0; i < 4; ++i)
  {
    const __m512i slices = _mm512_add_epi32(firstTwo, _mm512_set1_epi32(first + 2 * i));
    met[i] = _mm512_mask_cmp_ps_mask(
      _mm512_cmp_ps_mask(_mm512_permutexvar_ps(slices, least), upper, _CMP_LE_OQ), lower,
      _mm512_permutexvar_ps(slices, most), _CMP_LE_OQ);
  }
  return _mm512_kunpackd(_mm512_kunpackw(met[3], met[2]), _mm512_kunpackw(met[1], met[0]));
}

/// The same as FindCellsOfRay between planes at any places: along the axis and the two across. The
/// ray is given by its coordinates across the axis where planes are counted from.
SIMD_INLINE unsigned int FindCellsBetweenPlanes(const float line[2], const float slope[2],
  float margin, const float* const planes[3], SliceMasks slices, std::uint64_t cells[8])
{
  // As in FindCellsOfRay, u is in the lower half of a register, v in the upper half.
  const __m512 margins = _mm512_set1_ps(margin);
  const auto spread = [](const float pair[2])
  { return _mm512_mask_blend_ps(0xFF00, _mm512_set1_ps(pair[0]), _mm512_set1_ps(pair[1])); };
  const __m512 lines = spread(line);
  const __m512 slopes = spread(slope);
  const __m512 near = _mm512_fmadd_ps(LoadEightTwice(planes[0]), slopes, lines);
  const __m512 far = _mm512_fmadd_ps(LoadEightTwice(planes[0] + 1), slopes, lines);
  const __m512 least = _mm512_sub_ps(_mm512_min_ps(near, far), margins);
  const __m512 most = _mm512_add_ps(_mm512_max_ps(near, far), margins);
  const __mmask64 columns = FindMetCells(least, most, 0, planes[1]);
  const __mmask64 rows = FindMetCells(least, most, 8, planes[2]);
  // The columns of each slice in all bytes of its word that are rows of it.
  const __m512i ofSlices =
    _mm512_set_epi64(0x0707070707070707, 0x0606060606060606, 0x0505050505050505, 0x0404040404040404,
      0x0303030303030303, 0x0202020202020202, 0x0101010101010101, 0);
  const __m512i met =
    _mm512_maskz_shuffle_epi8(rows, _mm512_set1_epi64(static_cast<long long>(columns)), ofSlices);
  const __m512i found = _mm512_and_si512(slices, met);
  _mm512_storeu_si512(cells, found);
  return _mm512_test_epi64_mask(found, found);
}

}
}
