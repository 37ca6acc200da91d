// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The vectors of AVX2 with FMA. Included by Vectors.h only; see VectorsAvx512.h for what the
// functions do.

#include <immintrin.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int DoubleWidth = 4;

struct Mask
{
  __m256d Value;
};

/// Converts from double, so that arithmetic reads as for one number.
struct Doubles
{
  Doubles() = default;
  SIMD_INLINE Doubles(__m256d value)
    : Value(value)
  {
  }
  SIMD_INLINE Doubles(double value)
    : Value(_mm256_set1_pd(value))
  {
  }

  __m256d Value;
};

SIMD_INLINE Mask operator&(Mask a, Mask b)
{
  return { _mm256_and_pd(a.Value, b.Value) };
}
SIMD_INLINE Mask operator|(Mask a, Mask b)
{
  return { _mm256_or_pd(a.Value, b.Value) };
}
SIMD_INLINE Mask operator^(Mask a, Mask b)
{
  return { _mm256_xor_pd(a.Value, b.Value) };
}
SIMD_INLINE Mask AndNot(Mask a, Mask b)
{
  return { _mm256_andnot_pd(b.Value, a.Value) };
}
SIMD_INLINE unsigned int ToBits(Mask a)
{
  return static_cast<unsigned int>(_mm256_movemask_pd(a.Value));
}
SIMD_INLINE Mask FirstLanes(int count)
{
  return { _mm256_castsi256_pd(
    _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_set_epi64x(3, 2, 1, 0))) };
}

SIMD_INLINE Doubles Load(const double* a)
{
  return { _mm256_loadu_pd(a) };
}
SIMD_INLINE void Store(Doubles a, double* to)
{
  _mm256_storeu_pd(to, a.Value);
}
SIMD_INLINE Doubles LoadIntegers(const int* a)
{
  return { _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a))) };
}
SIMD_INLINE void StoreTruncated(Doubles a, int* to)
{
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(a.Value));
}
SIMD_INLINE Doubles Gather(const double* from, const int* indices)
{
  return { _mm256_set_pd(from[indices[3]], from[indices[2]], from[indices[1]], from[indices[0]]) };
}
SIMD_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { _mm256_add_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { _mm256_sub_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { _mm256_mul_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { _mm256_div_pd(a.Value, b.Value) };
}
SIMD_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { _mm256_fmadd_pd(a.Value, b.Value, c.Value) };
}
SIMD_INLINE Doubles Sqrt(Doubles a)
{
  return { _mm256_sqrt_pd(a.Value) };
}
SIMD_INLINE Doubles Floor(Doubles a)
{
  return { _mm256_floor_pd(a.Value) };
}
SIMD_INLINE Doubles Abs(Doubles a)
{
  return { _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.Value) };
}
SIMD_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  const __m256d sign = _mm256_set1_pd(-0.0);
  return { _mm256_or_pd(_mm256_and_pd(sign, b.Value), _mm256_andnot_pd(sign, a.Value)) };
}
/// Those of the bits that are in a mask are replaced by others.
SIMD_INLINE Doubles ReplaceBits(Doubles a, std::uint64_t mask, std::uint64_t bits)
{
  const __m256i kept = _mm256_andnot_si256(
    _mm256_set1_epi64x(static_cast<long long>(mask)), _mm256_castpd_si256(a.Value));
  return { _mm256_castsi256_pd(
    _mm256_or_si256(kept, _mm256_set1_epi64x(static_cast<long long>(bits)))) };
}
SIMD_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_LT_OQ) };
}
SIMD_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_LE_OQ) };
}
SIMD_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_EQ_OQ) };
}
SIMD_INLINE Doubles Min(Doubles a, Doubles b)
{
  return { _mm256_min_pd(b.Value, a.Value) };
}
SIMD_INLINE Doubles Max(Doubles a, Doubles b)
{
  return { _mm256_max_pd(b.Value, a.Value) };
}
SIMD_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { _mm256_blendv_pd(no.Value, yes.Value, mask.Value) };
}

SIMD_INLINE double ReduceMin(Doubles a)
{
  const __m128d two =
    _mm_min_pd(_mm256_castpd256_pd128(a.Value), _mm256_extractf128_pd(a.Value, 1));
  return _mm_cvtsd_f64(_mm_min_sd(two, _mm_unpackhi_pd(two, two)));
}

SIMD_INLINE Mask ToMask(unsigned int bits)
{
  const __m256i ofLanes = _mm256_set_epi64x(8, 4, 2, 1);
  const __m256i all = _mm256_set1_epi64x(bits);
  return { _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all, ofLanes), ofLanes)) };
}
SIMD_INLINE void StorePairs(Doubles first, Doubles second, float (*pairs)[2])
{
  const __m128 a = _mm256_cvtpd_ps(first.Value);
  const __m128 b = _mm256_cvtpd_ps(second.Value);
  _mm_storeu_ps(pairs[0], _mm_unpacklo_ps(a, b));
  _mm_storeu_ps(pairs[2], _mm_unpackhi_ps(a, b));
}

/// For each set of lanes, its members in order, and lane 0 behind them.
struct LanesInOrder
{
  alignas(16) int Members[1 << DoubleWidth][DoubleWidth];

  constexpr LanesInOrder()
    : Members{}
  {
    for (int lanes = 0; lanes < 1 << DoubleWidth; ++lanes)
    {
      int count = 0;
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        this->Members[lanes][count] = lanes >> lane & 1 ? lane : 0;
        count += lanes >> lane & 1;
      }
    }
  }
};

SIMD_INLINE __m128i GetLanesInOrder(unsigned int lanes)
{
  static constexpr LanesInOrder inOrder;
  return _mm_load_si128(reinterpret_cast<const __m128i*>(inOrder.Members[lanes]));
}
SIMD_INLINE int AppendLanes(int first, unsigned int lanes, int* numbers)
{
  _mm_storeu_si128(reinterpret_cast<__m128i*>(numbers),
    _mm_add_epi32(_mm_set1_epi32(first), GetLanesInOrder(lanes)));
  return __builtin_popcount(lanes);
}
SIMD_INLINE void StoreLanes(Doubles a, unsigned int lanes, double* to)
{
  // Each lane is two of floats.
  const __m256i first = _mm256_slli_epi64(_mm256_cvtepi32_epi64(GetLanesInOrder(lanes)), 1);
  const __m256i second = _mm256_slli_epi64(_mm256_add_epi64(first, _mm256_set1_epi64x(1)), 32);
  _mm256_storeu_ps(reinterpret_cast<float*>(to),
    _mm256_permutevar8x32_ps(_mm256_castpd_ps(a.Value), _mm256_or_si256(first, second)));
}
SIMD_INLINE int CopyLanes(const int* from, unsigned int lanes, int* to)
{
  const __m128 all = _mm_loadu_ps(reinterpret_cast<const float*>(from));
  _mm_storeu_ps(reinterpret_cast<float*>(to), _mm_permutevar_ps(all, GetLanesInOrder(lanes)));
  return __builtin_popcount(lanes);
}

/// Of each lane, takes the first of the rows to the first vector, and so on.
SIMD_INLINE void TransposeFours(const Doubles rows[4], Doubles to[4])
{
  const __m256d low[2] = { _mm256_unpacklo_pd(rows[0].Value, rows[1].Value),
    _mm256_unpacklo_pd(rows[2].Value, rows[3].Value) };
  const __m256d high[2] = { _mm256_unpackhi_pd(rows[0].Value, rows[1].Value),
    _mm256_unpackhi_pd(rows[2].Value, rows[3].Value) };
  to[0] = { _mm256_permute2f128_pd(low[0], low[1], 0x20) };
  to[1] = { _mm256_permute2f128_pd(high[0], high[1], 0x20) };
  to[2] = { _mm256_permute2f128_pd(low[0], low[1], 0x31) };
  to[3] = { _mm256_permute2f128_pd(high[0], high[1], 0x31) };
}
SIMD_INLINE void LoadFours(const double* const from[DoubleWidth], Doubles to[4])
{
  Doubles rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = Load(from[i]);
  }
  TransposeFours(rows, to);
}
SIMD_INLINE void StoreFours(const Doubles from[4], double* to, int stride)
{
  Doubles rows[4];
  TransposeFours(from, rows);
  for (int i = 0; i < 4; ++i)
  {
    _mm256_storeu_pd(to + stride * i, rows[i].Value);
  }
}

constexpr int FloatWidth = 8;

struct FloatMask
{
  __m256 Value;
};

/// Converts from float, so that arithmetic reads as for one number.
struct Floats
{
  Floats() = default;
  SIMD_INLINE Floats(__m256 value)
    : Value(value)
  {
  }
  SIMD_INLINE Floats(float value)
    : Value(_mm256_set1_ps(value))
  {
  }

  __m256 Value;
};

SIMD_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { _mm256_and_ps(a.Value, b.Value) };
}
SIMD_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { _mm256_or_ps(a.Value, b.Value) };
}
SIMD_INLINE unsigned int ToBits(FloatMask a)
{
  return static_cast<unsigned int>(_mm256_movemask_ps(a.Value));
}
SIMD_INLINE Floats LoadFloats(const float* a)
{
  return { _mm256_loadu_ps(a) };
}
SIMD_INLINE void StoreFloats(Floats a, float* to)
{
  _mm256_storeu_ps(to, a.Value);
}
SIMD_INLINE Floats Select(FloatMask mask, Floats yes, Floats no)
{
  return { _mm256_blendv_ps(no.Value, yes.Value, mask.Value) };
}
SIMD_INLINE Floats Round(Doubles low, Doubles high)
{
  return { _mm256_set_m128(_mm256_cvtpd_ps(high.Value), _mm256_cvtpd_ps(low.Value)) };
}
SIMD_INLINE void StoreRounded(Doubles a, float* to)
{
  _mm_storeu_ps(to, _mm256_cvtpd_ps(a.Value));
}
SIMD_INLINE Doubles LoadWidened(const float* a)
{
  return { _mm256_cvtps_pd(_mm_loadu_ps(a)) };
}
SIMD_INLINE Floats operator+(Floats a, Floats b)
{
  return { _mm256_add_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator-(Floats a, Floats b)
{
  return { _mm256_sub_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator*(Floats a, Floats b)
{
  return { _mm256_mul_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats operator/(Floats a, Floats b)
{
  return { _mm256_div_ps(a.Value, b.Value) };
}
SIMD_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { _mm256_fmadd_ps(a.Value, b.Value, c.Value) };
}
SIMD_INLINE Floats Abs(Floats a)
{
  return { _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.Value) };
}
SIMD_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { _mm256_cmp_ps(a.Value, b.Value, _CMP_LT_OQ) };
}
SIMD_INLINE Floats Min(Floats a, Floats b)
{
  return { _mm256_min_ps(b.Value, a.Value) };
}
SIMD_INLINE Floats Max(Floats a, Floats b)
{
  return { _mm256_max_ps(b.Value, a.Value) };
}
SIMD_INLINE Floats MaxAbs(Floats a, Floats b)
{
  return Max(Abs(a), Abs(b));
}
SIMD_INLINE float ReduceMin(Floats a)
{
  const __m128 four =
    _mm_min_ps(_mm256_castps256_ps128(a.Value), _mm256_extractf128_ps(a.Value, 1));
  const __m128 two = _mm_min_ps(four, _mm_movehl_ps(four, four));
  return _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps(two, two, 1)));
}
SIMD_INLINE Floats CopySign(Floats a, Floats b)
{
  const __m256 sign = _mm256_set1_ps(-0.0F);
  return { _mm256_or_ps(_mm256_and_ps(sign, b.Value), _mm256_andnot_ps(sign, a.Value)) };
}
SIMD_INLINE FloatMask HaveDifferentSigns(Floats a, Floats b)
{
  return { _mm256_xor_ps(a.Value, b.Value) };
}
SIMD_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { _mm256_andnot_ps(b.Value, a.Value) };
}
SIMD_INLINE Floats ApproximateReciprocal(Floats a)
{
  return { _mm256_div_ps(_mm256_set1_ps(1.0F), a.Value) };
}
SIMD_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
  return { _mm256_cvtepi32_ps(_mm256_and_si256(
    _mm256_srl_epi32(all, _mm_cvtsi32_si128(shift)), _mm256_set1_epi32(static_cast<int>(mask)))) };
}
SIMD_INLINE Floats LoadBytes(const std::uint8_t* a)
{
  return { _mm256_cvtepi32_ps(
    _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(a)))) };
}
SIMD_INLINE void TransposeFours(const Floats rows[4], Floats to[4])
{
  const __m256d low[2] = { _mm256_castps_pd(_mm256_unpacklo_ps(rows[0].Value, rows[1].Value)),
    _mm256_castps_pd(_mm256_unpacklo_ps(rows[2].Value, rows[3].Value)) };
  const __m256d high[2] = { _mm256_castps_pd(_mm256_unpackhi_ps(rows[0].Value, rows[1].Value)),
    _mm256_castps_pd(_mm256_unpackhi_ps(rows[2].Value, rows[3].Value)) };
  to[0] = { _mm256_castpd_ps(_mm256_unpacklo_pd(low[0], low[1])) };
  to[1] = { _mm256_castpd_ps(_mm256_unpackhi_pd(low[0], low[1])) };
  to[2] = { _mm256_castpd_ps(_mm256_unpacklo_pd(high[0], high[1])) };
  to[3] = { _mm256_castpd_ps(_mm256_unpackhi_pd(high[0], high[1])) };
}
SIMD_INLINE void LoadFours(const float* const from[FloatWidth], Floats to[4], int at = 0)
{
  Floats rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = { _mm256_set_m128(_mm_loadu_ps(from[4 + i] + at), _mm_loadu_ps(from[i] + at)) };
  }
  TransposeFours(rows, to);
}
SIMD_INLINE void StoreFours(const Floats from[4], float* to)
{
  Floats rows[4];
  TransposeFours(from, rows);
  for (int i = 0; i < 4; ++i)
  {
    _mm_storeu_ps(to + 4 * i, _mm256_castps256_ps128(rows[i].Value));
    _mm_storeu_ps(to + 16 + 4 * i, _mm256_extractf128_ps(rows[i].Value, 1));
  }
}

//------------------------------------------------------------------------------
// There is no conversion from integers of more than 31 bits.
template <typename T>
constexpr bool HasWords = sizeof(T) <= 2 || (sizeof(T) == 4 && IsSigned<T>);

template <int Size>
SIMD_INLINE auto LoadWords(const void* const* rows, std::ptrdiff_t bytes)
{
  using Word = WordOf<Size>;
  if constexpr (Size == 8)
  {
    return _mm256_set_epi64x(LoadWord<Word>(rows[3], bytes), LoadWord<Word>(rows[2], bytes),
      LoadWord<Word>(rows[1], bytes), LoadWord<Word>(rows[0], bytes));
  }
  else
  {
    return _mm_set_epi32(LoadWord<Word>(rows[3], bytes), LoadWord<Word>(rows[2], bytes),
      LoadWord<Word>(rows[1], bytes), LoadWord<Word>(rows[0], bytes));
  }
}

/// For samples that are the highest bits of their words.
template <typename T>
SIMD_INLINE Doubles ToDoubles(__m128i high)
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
SIMD_INLINE Doubles TakeFromWords(__m256i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i high = _mm256_sll_epi64(words, _mm_cvtsi32_si128(64 - bits * (k + 1)));
  const __m256i upperHalves = _mm256_set_epi32(7, 5, 3, 1, 7, 5, 3, 1);
  return ToDoubles<T>(_mm256_castsi256_si128(_mm256_permutevar8x32_epi32(high, upperHalves)));
}

template <typename T>
SIMD_INLINE Doubles TakeFromWords(__m128i words, int k)
{
  constexpr int bits = 8 * sizeof(T);
  return ToDoubles<T>(_mm_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1))));
}

template <typename T>
SIMD_INLINE Floats TakeFromWords(__m128i low, __m128i high, int k)
{
  constexpr int bits = 8 * sizeof(T);
  const __m256i words = _mm256_set_m128i(high, low);
  const __m256i highest = _mm256_sll_epi32(words, _mm_cvtsi32_si128(32 - bits * (k + 1)));
  return { _mm256_cvtepi32_ps(
    IsSigned<T> ? _mm256_srai_epi32(highest, 32 - bits) : _mm256_srli_epi32(highest, 32 - bits)) };
}

template <typename T>
SIMD_INLINE Floats TakeFromWords(__m256i low, __m256i high, int k)
{
  const __m256 first = _mm256_castsi256_ps(low);
  const __m256 second = _mm256_castsi256_ps(high);
  // Lanes 0, 1, 4, 5, 2, 3, 6, 7.
  const __m256 mixed =
    k == 0 ? _mm256_shuffle_ps(first, second, 0x88) : _mm256_shuffle_ps(first, second, 0xDD);
  return { _mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(mixed), 0xD8)) };
}

//------------------------------------------------------------------------------
using SliceMasks = const std::uint64_t*;

SIMD_INLINE SliceMasks LoadSlices(const std::uint64_t slices[8])
{
  return slices;
}

/// The cells between the coordinates of a ray along one axis across, one bit for each, in eight
/// slices.
SIMD_INLINE __m256i FindRow(float middle, float slope, float margin)
{
  const __m256 planes = _mm256_set_ps(3.0F, 2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F);
  const __m256 margins = _mm256_set1_ps(margin);
  const __m256 slopes = _mm256_set1_ps(slope);
  const __m256 near = _mm256_add_ps(_mm256_set1_ps(middle), _mm256_mul_ps(planes, slopes));
  const __m256 far = _mm256_add_ps(near, slopes);
  const __m256 least = _mm256_sub_ps(_mm256_min_ps(near, far), margins);
  const __m256 most = _mm256_add_ps(_mm256_max_ps(near, far), margins);
  const __m256i seven = _mm256_set1_epi32(7);
  const __m256i low = _mm256_max_epi32(_mm256_cvttps_epi32(least), _mm256_setzero_si256());
  const __m256i high =
    _mm256_sub_epi32(seven, _mm256_min_epi32(_mm256_cvttps_epi32(_mm256_floor_ps(most)), seven));
  const __m256i byte = _mm256_set1_epi32(0xFF);
  return _mm256_and_si256(
    byte, _mm256_and_si256(_mm256_sllv_epi32(byte, low), _mm256_srlv_epi32(byte, high)));
}

/// The cells of four slices that are in the given columns and rows and in the masks of the slices.
SIMD_INLINE unsigned int FindCellsOfSlices(
  __m128i columns, __m128i rows, const std::uint64_t slices[4], std::uint64_t cells[4])
{
  const __m256i firstBytes = _mm256_set_epi64x(0x0808080808080808, 0, 0x0808080808080808, 0);
  const __m256i bits = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201U));
  const auto spread = [firstBytes](__m128i words)
  { return _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(words), firstBytes); };
  const __m256i inRows = _mm256_cmpeq_epi8(_mm256_and_si256(spread(rows), bits), bits);
  const __m256i found = _mm256_and_si256(_mm256_and_si256(inRows, spread(columns)),
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(slices)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells), found);
  const __m256i none = _mm256_cmpeq_epi64(found, _mm256_setzero_si256());
  return 15U ^ static_cast<unsigned int>(_mm256_movemask_pd(_mm256_castsi256_pd(none)));
}

SIMD_INLINE unsigned int FindCellsOfRows(
  __m256i columns, __m256i rows, SliceMasks slices, std::uint64_t cells[8])
{
  const unsigned int first =
    FindCellsOfSlices(_mm256_castsi256_si128(columns), _mm256_castsi256_si128(rows), slices, cells);
  return first |
    FindCellsOfSlices(_mm256_extracti128_si256(columns, 1), _mm256_extracti128_si256(rows, 1),
      slices + 4, cells + 4)
    << 4;
}

SIMD_INLINE unsigned int FindCellsOfRay(const float middle[2], const float slope[2], float margin,
  SliceMasks slices, std::uint64_t cells[8])
{
  return FindCellsOfRows(
    FindRow(middle[0], slope[0], margin), FindRow(middle[1], slope[1], margin), slices, cells);
}

/// The cells between planes that the coordinates of a ray along one axis across meet, one bit for
/// each, in eight slices between the given planes along the axis.
SIMD_INLINE __m256i FindRow(
  float first, float slope, float margin, const float along[9], const float planes[9])
{
  const __m256 firsts = _mm256_set1_ps(first);
  const __m256 slopes = _mm256_set1_ps(slope);
  const __m256 margins = _mm256_set1_ps(margin);
  const __m256 near = _mm256_fmadd_ps(_mm256_loadu_ps(along), slopes, firsts);
  const __m256 far = _mm256_fmadd_ps(_mm256_loadu_ps(along + 1), slopes, firsts);
  const __m256 least = _mm256_sub_ps(_mm256_min_ps(near, far), margins);
  const __m256 most = _mm256_add_ps(_mm256_max_ps(near, far), margins);
  __m256i row = _mm256_setzero_si256();
  for (int i = 0; i < 8; ++i)
  {
    const __m256 met =
      _mm256_and_ps(_mm256_cmp_ps(least, _mm256_set1_ps(planes[i + 1]), _CMP_LE_OQ),
        _mm256_cmp_ps(_mm256_set1_ps(planes[i]), most, _CMP_LE_OQ));
    row =
      _mm256_or_si256(row, _mm256_and_si256(_mm256_castps_si256(met), _mm256_set1_epi32(1 << i)));
  }
  return row;
}

SIMD_INLINE unsigned int FindCellsBetweenPlanes(const float line[2], const float slope[2],
  float margin, const float* const planes[3], SliceMasks slices, std::uint64_t cells[8])
{
  return FindCellsOfRows(FindRow(line[0], slope[0], margin, planes[0], planes[1]),
    FindRow(line[1], slope[1], margin, planes[0], planes[2]), slices, cells);
}

}
}
