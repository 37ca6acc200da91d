// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Doubles side by side in a vector register, and floats. Included by Kernels.inl only, once for
// every instruction set; everything is in an unnamed namespace and inlined, so that no code for one
// processor is ever linked into a program for another.

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
#define LANES_AVX512
#elif defined(__AVX2__) && defined(__FMA__)
#define LANES_AVX2
#endif
#if defined(LANES_AVX512) || defined(LANES_AVX2)
#include <immintrin.h>
#endif

#define LANES_INLINE static inline __attribute__((always_inline))

namespace vtkIsosurfaceRayTracing
{
namespace
{

#if defined(LANES_AVX512)

constexpr int LaneCount = 8;

/// A truth value for each lane.
struct Mask
{
  __mmask8 Value;
};

struct Doubles
{
  __m512d Value;
};

LANES_INLINE Mask operator&(Mask a, Mask b)
{
  return { _kand_mask8(a.Value, b.Value) };
}
LANES_INLINE Mask operator|(Mask a, Mask b)
{
  return { _kor_mask8(a.Value, b.Value) };
}
LANES_INLINE Mask operator^(Mask a, Mask b)
{
  return { _kxor_mask8(a.Value, b.Value) };
}
LANES_INLINE Mask AndNot(Mask a, Mask b)
{
  return { _kandn_mask8(b.Value, a.Value) };
}
LANES_INLINE unsigned int ToBits(Mask a)
{
  return a.Value;
}
LANES_INLINE Mask FirstLanes(int count)
{
  return { static_cast<__mmask8>((1U << count) - 1U) };
}

LANES_INLINE Doubles Broadcast(double a)
{
  return { _mm512_set1_pd(a) };
}
LANES_INLINE Doubles Load(const double* a)
{
  return { _mm512_loadu_pd(a) };
}
LANES_INLINE void Store(Doubles a, double* to)
{
  _mm512_storeu_pd(to, a.Value);
}
LANES_INLINE Doubles LoadIntegers(const int* a)
{
  return { _mm512_cvtepi32_pd(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(a))) };
}
/// Without what is behind the point.
LANES_INLINE void StoreTruncated(Doubles a, int* to)
{
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm512_cvttpd_epi32(a.Value));
}
LANES_INLINE Doubles Gather(const double* from, const int* places)
{
  return { _mm512_i32gather_pd(
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(places)), from, 8) };
}
LANES_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { _mm512_add_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { _mm512_sub_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { _mm512_mul_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { _mm512_div_pd(a.Value, b.Value) };
}
/// a b + c, rounded once.
LANES_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { _mm512_fmadd_pd(a.Value, b.Value, c.Value) };
}
LANES_INLINE Doubles SquareRoot(Doubles a)
{
  return { _mm512_sqrt_pd(a.Value) };
}
LANES_INLINE Doubles Magnitude(Doubles a)
{
  return { _mm512_abs_pd(a.Value) };
}
LANES_INLINE Doubles Floor(Doubles a)
{
  return { _mm512_floor_pd(a.Value) };
}
/// The first with the sign of the second.
LANES_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  const __m512i sign = _mm512_set1_epi64(static_cast<long long>(0x8000000000000000U));
  return { _mm512_castsi512_pd(_mm512_ternarylogic_epi64(
    sign, _mm512_castpd_si512(b.Value), _mm512_castpd_si512(a.Value), 0xCA)) };
}
LANES_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_LT_OQ) };
}
LANES_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_LE_OQ) };
}
LANES_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { _mm512_cmp_pd_mask(a.Value, b.Value, _CMP_EQ_OQ) };
}
// As std::min and std::max choose, NaN and the signs of zeros included.
LANES_INLINE Doubles Smaller(Doubles a, Doubles b)
{
  return { _mm512_min_pd(b.Value, a.Value) };
}
LANES_INLINE Doubles Larger(Doubles a, Doubles b)
{
  return { _mm512_max_pd(b.Value, a.Value) };
}
LANES_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { _mm512_mask_mov_pd(no.Value, mask.Value, yes.Value) };
}

constexpr int FloatCount = 16;

struct FloatMask
{
  __mmask16 Value;
};

struct Floats
{
  __m512 Value;
};

LANES_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { _kand_mask16(a.Value, b.Value) };
}
LANES_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { _kor_mask16(a.Value, b.Value) };
}
LANES_INLINE unsigned int ToBits(FloatMask a)
{
  return a.Value;
}
LANES_INLINE Floats BroadcastFloat(float a)
{
  return { _mm512_set1_ps(a) };
}
LANES_INLINE Floats LoadFloats(const float* a)
{
  return { _mm512_loadu_ps(a) };
}
/// What two vectors of doubles hold, rounded.
LANES_INLINE Floats Round(Doubles low, Doubles high)
{
  return { _mm512_insertf32x8(
    _mm512_castps256_ps512(_mm512_cvtpd_ps(low.Value)), _mm512_cvtpd_ps(high.Value), 1) };
}
LANES_INLINE Floats operator+(Floats a, Floats b)
{
  return { _mm512_add_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator-(Floats a, Floats b)
{
  return { _mm512_sub_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator*(Floats a, Floats b)
{
  return { _mm512_mul_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator/(Floats a, Floats b)
{
  return { _mm512_div_ps(a.Value, b.Value) };
}
/// a b + c, rounded once or twice.
LANES_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { _mm512_fmadd_ps(a.Value, b.Value, c.Value) };
}
LANES_INLINE Floats Magnitude(Floats a)
{
  return { _mm512_abs_ps(a.Value) };
}
LANES_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { _mm512_cmp_ps_mask(a.Value, b.Value, _CMP_LT_OQ) };
}
LANES_INLINE Floats Smaller(Floats a, Floats b)
{
  return { _mm512_min_ps(b.Value, a.Value) };
}
LANES_INLINE Floats Larger(Floats a, Floats b)
{
  return { _mm512_max_ps(b.Value, a.Value) };
}
/// Whichever is larger in magnitude, in magnitude.
LANES_INLINE Floats LargerSize(Floats a, Floats b)
{
  return { _mm512_range_ps(a.Value, b.Value, 0x0B) };
}
LANES_INLINE Floats CopySign(Floats a, Floats b)
{
  const __m512i sign = _mm512_set1_epi32(static_cast<int>(0x80000000U));
  return { _mm512_castsi512_ps(_mm512_ternarylogic_epi32(
    sign, _mm512_castps_si512(b.Value), _mm512_castps_si512(a.Value), 0xCA)) };
}
LANES_INLINE FloatMask HaveOtherSigns(Floats a, Floats b)
{
  return { _mm512_movepi32_mask(
    _mm512_xor_si512(_mm512_castps_si512(a.Value), _mm512_castps_si512(b.Value))) };
}
LANES_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { _kandn_mask16(b.Value, a.Value) };
}
/// 1 / a to some twenty bits.
LANES_INLINE Floats RoughReciprocal(Floats a)
{
  const __m512 first = _mm512_rcp14_ps(a.Value);
  return { _mm512_mul_ps(first, _mm512_fnmadd_ps(a.Value, first, _mm512_set1_ps(2.0F))) };
}
/// Some bits of each word.
LANES_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  return { _mm512_cvtepi32_ps(
    _mm512_and_si512(_mm512_srl_epi32(_mm512_loadu_si512(words), _mm_cvtsi32_si128(shift)),
      _mm512_set1_epi32(static_cast<int>(mask)))) };
}
/// Four numbers for each lane, each of them in a vector.
LANES_INLINE void LoadFours(const float* const from[FloatCount], Floats to[4])
{
  __m512 rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = _mm512_castps128_ps512(_mm_loadu_ps(from[i]));
    rows[i] = _mm512_insertf32x4(rows[i], _mm_loadu_ps(from[4 + i]), 1);
    rows[i] = _mm512_insertf32x4(rows[i], _mm_loadu_ps(from[8 + i]), 2);
    rows[i] = _mm512_insertf32x4(rows[i], _mm_loadu_ps(from[12 + i]), 3);
  }
  const __m512d low[2] = { _mm512_castps_pd(_mm512_unpacklo_ps(rows[0], rows[1])),
    _mm512_castps_pd(_mm512_unpacklo_ps(rows[2], rows[3])) };
  const __m512d high[2] = { _mm512_castps_pd(_mm512_unpackhi_ps(rows[0], rows[1])),
    _mm512_castps_pd(_mm512_unpackhi_ps(rows[2], rows[3])) };
  to[0] = { _mm512_castpd_ps(_mm512_unpacklo_pd(low[0], low[1])) };
  to[1] = { _mm512_castpd_ps(_mm512_unpackhi_pd(low[0], low[1])) };
  to[2] = { _mm512_castpd_ps(_mm512_unpacklo_pd(high[0], high[1])) };
  to[3] = { _mm512_castpd_ps(_mm512_unpackhi_pd(high[0], high[1])) };
}

#elif defined(LANES_AVX2)

constexpr int LaneCount = 4;

struct Mask
{
  __m256d Value;
};

struct Doubles
{
  __m256d Value;
};

LANES_INLINE Mask operator&(Mask a, Mask b)
{
  return { _mm256_and_pd(a.Value, b.Value) };
}
LANES_INLINE Mask operator|(Mask a, Mask b)
{
  return { _mm256_or_pd(a.Value, b.Value) };
}
LANES_INLINE Mask operator^(Mask a, Mask b)
{
  return { _mm256_xor_pd(a.Value, b.Value) };
}
LANES_INLINE Mask AndNot(Mask a, Mask b)
{
  return { _mm256_andnot_pd(b.Value, a.Value) };
}
LANES_INLINE unsigned int ToBits(Mask a)
{
  return static_cast<unsigned int>(_mm256_movemask_pd(a.Value));
}
LANES_INLINE Mask FirstLanes(int count)
{
  return { _mm256_castsi256_pd(
    _mm256_cmpgt_epi64(_mm256_set1_epi64x(count), _mm256_set_epi64x(3, 2, 1, 0))) };
}

LANES_INLINE Doubles Broadcast(double a)
{
  return { _mm256_set1_pd(a) };
}
LANES_INLINE Doubles Load(const double* a)
{
  return { _mm256_loadu_pd(a) };
}
LANES_INLINE void Store(Doubles a, double* to)
{
  _mm256_storeu_pd(to, a.Value);
}
LANES_INLINE Doubles LoadIntegers(const int* a)
{
  return { _mm256_cvtepi32_pd(_mm_loadu_si128(reinterpret_cast<const __m128i*>(a))) };
}
LANES_INLINE void StoreTruncated(Doubles a, int* to)
{
  _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm256_cvttpd_epi32(a.Value));
}
LANES_INLINE Doubles Gather(const double* from, const int* places)
{
  return { _mm256_set_pd(from[places[3]], from[places[2]], from[places[1]], from[places[0]]) };
}
LANES_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { _mm256_add_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { _mm256_sub_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { _mm256_mul_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { _mm256_div_pd(a.Value, b.Value) };
}
LANES_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { _mm256_fmadd_pd(a.Value, b.Value, c.Value) };
}
LANES_INLINE Doubles SquareRoot(Doubles a)
{
  return { _mm256_sqrt_pd(a.Value) };
}
LANES_INLINE Doubles Floor(Doubles a)
{
  return { _mm256_floor_pd(a.Value) };
}
LANES_INLINE Doubles Magnitude(Doubles a)
{
  return { _mm256_andnot_pd(_mm256_set1_pd(-0.0), a.Value) };
}
LANES_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  const __m256d sign = _mm256_set1_pd(-0.0);
  return { _mm256_or_pd(_mm256_and_pd(sign, b.Value), _mm256_andnot_pd(sign, a.Value)) };
}
LANES_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_LT_OQ) };
}
LANES_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_LE_OQ) };
}
LANES_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { _mm256_cmp_pd(a.Value, b.Value, _CMP_EQ_OQ) };
}
LANES_INLINE Doubles Smaller(Doubles a, Doubles b)
{
  return { _mm256_min_pd(b.Value, a.Value) };
}
LANES_INLINE Doubles Larger(Doubles a, Doubles b)
{
  return { _mm256_max_pd(b.Value, a.Value) };
}
LANES_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { _mm256_blendv_pd(no.Value, yes.Value, mask.Value) };
}

constexpr int FloatCount = 8;

struct FloatMask
{
  __m256 Value;
};

struct Floats
{
  __m256 Value;
};

LANES_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { _mm256_and_ps(a.Value, b.Value) };
}
LANES_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { _mm256_or_ps(a.Value, b.Value) };
}
LANES_INLINE unsigned int ToBits(FloatMask a)
{
  return static_cast<unsigned int>(_mm256_movemask_ps(a.Value));
}
LANES_INLINE Floats BroadcastFloat(float a)
{
  return { _mm256_set1_ps(a) };
}
LANES_INLINE Floats LoadFloats(const float* a)
{
  return { _mm256_loadu_ps(a) };
}
LANES_INLINE Floats Round(Doubles low, Doubles high)
{
  return { _mm256_set_m128(_mm256_cvtpd_ps(high.Value), _mm256_cvtpd_ps(low.Value)) };
}
LANES_INLINE Floats operator+(Floats a, Floats b)
{
  return { _mm256_add_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator-(Floats a, Floats b)
{
  return { _mm256_sub_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator*(Floats a, Floats b)
{
  return { _mm256_mul_ps(a.Value, b.Value) };
}
LANES_INLINE Floats operator/(Floats a, Floats b)
{
  return { _mm256_div_ps(a.Value, b.Value) };
}
LANES_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { _mm256_fmadd_ps(a.Value, b.Value, c.Value) };
}
LANES_INLINE Floats Magnitude(Floats a)
{
  return { _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.Value) };
}
LANES_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { _mm256_cmp_ps(a.Value, b.Value, _CMP_LT_OQ) };
}
LANES_INLINE Floats Smaller(Floats a, Floats b)
{
  return { _mm256_min_ps(b.Value, a.Value) };
}
LANES_INLINE Floats Larger(Floats a, Floats b)
{
  return { _mm256_max_ps(b.Value, a.Value) };
}
LANES_INLINE Floats LargerSize(Floats a, Floats b)
{
  return Larger(Magnitude(a), Magnitude(b));
}
LANES_INLINE Floats CopySign(Floats a, Floats b)
{
  const __m256 sign = _mm256_set1_ps(-0.0F);
  return { _mm256_or_ps(_mm256_and_ps(sign, b.Value), _mm256_andnot_ps(sign, a.Value)) };
}
LANES_INLINE FloatMask HaveOtherSigns(Floats a, Floats b)
{
  return { _mm256_xor_ps(a.Value, b.Value) };
}
LANES_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { _mm256_andnot_ps(b.Value, a.Value) };
}
LANES_INLINE Floats RoughReciprocal(Floats a)
{
  return { _mm256_div_ps(_mm256_set1_ps(1.0F), a.Value) };
}
LANES_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(words));
  return { _mm256_cvtepi32_ps(_mm256_and_si256(
    _mm256_srl_epi32(all, _mm_cvtsi32_si128(shift)), _mm256_set1_epi32(static_cast<int>(mask)))) };
}
LANES_INLINE void LoadFours(const float* const from[FloatCount], Floats to[4])
{
  __m256 rows[4];
  for (int i = 0; i < 4; ++i)
  {
    rows[i] = _mm256_set_m128(_mm_loadu_ps(from[4 + i]), _mm_loadu_ps(from[i]));
  }
  const __m256d low[2] = { _mm256_castps_pd(_mm256_unpacklo_ps(rows[0], rows[1])),
    _mm256_castps_pd(_mm256_unpacklo_ps(rows[2], rows[3])) };
  const __m256d high[2] = { _mm256_castps_pd(_mm256_unpackhi_ps(rows[0], rows[1])),
    _mm256_castps_pd(_mm256_unpackhi_ps(rows[2], rows[3])) };
  to[0] = { _mm256_castpd_ps(_mm256_unpacklo_pd(low[0], low[1])) };
  to[1] = { _mm256_castpd_ps(_mm256_unpackhi_pd(low[0], low[1])) };
  to[2] = { _mm256_castpd_ps(_mm256_unpacklo_pd(high[0], high[1])) };
  to[3] = { _mm256_castpd_ps(_mm256_unpackhi_pd(high[0], high[1])) };
}

#else

constexpr int LaneCount = 2;

// Vectors of the compiler: SSE2, NEON, or whatever two doubles fit in.
using DoubleVector = double __attribute__((vector_size(16)));
using MaskVector = long long __attribute__((vector_size(16)));

struct Mask
{
  MaskVector Value;
};

struct Doubles
{
  DoubleVector Value;
};

LANES_INLINE Mask operator&(Mask a, Mask b)
{
  return { a.Value & b.Value };
}
LANES_INLINE Mask operator|(Mask a, Mask b)
{
  return { a.Value | b.Value };
}
LANES_INLINE Mask operator^(Mask a, Mask b)
{
  return { a.Value ^ b.Value };
}
LANES_INLINE Mask AndNot(Mask a, Mask b)
{
  return { a.Value & ~b.Value };
}
LANES_INLINE unsigned int ToBits(Mask a)
{
  return static_cast<unsigned int>((a.Value[0] & 1) | (a.Value[1] & 2));
}
LANES_INLINE Mask FirstLanes(int count)
{
  return { MaskVector{ -static_cast<long long>(count > 0), -static_cast<long long>(count > 1) } };
}

LANES_INLINE Doubles Broadcast(double a)
{
  return { DoubleVector{ a, a } };
}
LANES_INLINE Doubles Load(const double* a)
{
  return { DoubleVector{ a[0], a[1] } };
}
LANES_INLINE void Store(Doubles a, double* to)
{
  to[0] = a.Value[0];
  to[1] = a.Value[1];
}
LANES_INLINE Doubles LoadIntegers(const int* a)
{
  return { DoubleVector{ static_cast<double>(a[0]), static_cast<double>(a[1]) } };
}
LANES_INLINE void StoreTruncated(Doubles a, int* to)
{
  to[0] = static_cast<int>(a.Value[0]);
  to[1] = static_cast<int>(a.Value[1]);
}
LANES_INLINE Doubles Gather(const double* from, const int* places)
{
  return { DoubleVector{ from[places[0]], from[places[1]] } };
}
LANES_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { a.Value + b.Value };
}
LANES_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { a.Value - b.Value };
}
LANES_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { a.Value * b.Value };
}
LANES_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { a.Value / b.Value };
}
LANES_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { DoubleVector{ __builtin_fma(a.Value[0], b.Value[0], c.Value[0]),
    __builtin_fma(a.Value[1], b.Value[1], c.Value[1]) } };
}
LANES_INLINE Doubles SquareRoot(Doubles a)
{
  return { DoubleVector{ __builtin_sqrt(a.Value[0]), __builtin_sqrt(a.Value[1]) } };
}
LANES_INLINE Doubles Floor(Doubles a)
{
  return { DoubleVector{ __builtin_floor(a.Value[0]), __builtin_floor(a.Value[1]) } };
}
LANES_INLINE Doubles Magnitude(Doubles a)
{
  return { DoubleVector{ __builtin_fabs(a.Value[0]), __builtin_fabs(a.Value[1]) } };
}
LANES_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  return { DoubleVector{
    __builtin_copysign(a.Value[0], b.Value[0]), __builtin_copysign(a.Value[1], b.Value[1]) } };
}
LANES_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { a.Value < b.Value };
}
LANES_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { a.Value <= b.Value };
}
LANES_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { a.Value == b.Value };
}
LANES_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { reinterpret_cast<DoubleVector>((reinterpret_cast<MaskVector>(yes.Value) & mask.Value) |
    (reinterpret_cast<MaskVector>(no.Value) & ~mask.Value)) };
}
LANES_INLINE Doubles Smaller(Doubles a, Doubles b)
{
  return Select(b < a, b, a);
}
LANES_INLINE Doubles Larger(Doubles a, Doubles b)
{
  return Select(a < b, b, a);
}

constexpr int FloatCount = 4;

using FloatVector = float __attribute__((vector_size(16)));
using FloatMaskVector = int __attribute__((vector_size(16)));

struct FloatMask
{
  FloatMaskVector Value;
};

struct Floats
{
  FloatVector Value;
};

LANES_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { a.Value & b.Value };
}
LANES_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { a.Value | b.Value };
}
LANES_INLINE unsigned int ToBits(FloatMask a)
{
  return static_cast<unsigned int>(
    (a.Value[0] & 1) | (a.Value[1] & 2) | (a.Value[2] & 4) | (a.Value[3] & 8));
}
LANES_INLINE Floats BroadcastFloat(float a)
{
  return { FloatVector{ a, a, a, a } };
}
LANES_INLINE Floats LoadFloats(const float* a)
{
  return { FloatVector{ a[0], a[1], a[2], a[3] } };
}
LANES_INLINE Floats Round(Doubles low, Doubles high)
{
  return { FloatVector{ static_cast<float>(low.Value[0]), static_cast<float>(low.Value[1]),
    static_cast<float>(high.Value[0]), static_cast<float>(high.Value[1]) } };
}
LANES_INLINE Floats operator+(Floats a, Floats b)
{
  return { a.Value + b.Value };
}
LANES_INLINE Floats operator-(Floats a, Floats b)
{
  return { a.Value - b.Value };
}
LANES_INLINE Floats operator*(Floats a, Floats b)
{
  return { a.Value * b.Value };
}
LANES_INLINE Floats operator/(Floats a, Floats b)
{
  return { a.Value / b.Value };
}
LANES_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { a.Value * b.Value + c.Value };
}
LANES_INLINE Floats Magnitude(Floats a)
{
  return { reinterpret_cast<FloatVector>(reinterpret_cast<FloatMaskVector>(a.Value) &
    FloatMaskVector{ 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF }) };
}
LANES_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { a.Value < b.Value };
}
LANES_INLINE Floats Smaller(Floats a, Floats b)
{
  return { b.Value < a.Value ? b.Value : a.Value };
}
LANES_INLINE Floats Larger(Floats a, Floats b)
{
  return { a.Value < b.Value ? b.Value : a.Value };
}
LANES_INLINE Floats LargerSize(Floats a, Floats b)
{
  return Larger(Magnitude(a), Magnitude(b));
}
LANES_INLINE Floats CopySign(Floats a, Floats b)
{
  return { FloatVector{ __builtin_copysignf(a.Value[0], b.Value[0]),
    __builtin_copysignf(a.Value[1], b.Value[1]), __builtin_copysignf(a.Value[2], b.Value[2]),
    __builtin_copysignf(a.Value[3], b.Value[3]) } };
}
/// The highest bit of each lane tells.
LANES_INLINE FloatMask HaveOtherSigns(Floats a, Floats b)
{
  return {
    (reinterpret_cast<FloatMaskVector>(a.Value) ^ reinterpret_cast<FloatMaskVector>(b.Value)) >> 31
  };
}
LANES_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { a.Value & ~b.Value };
}
LANES_INLINE Floats RoughReciprocal(Floats a)
{
  return { FloatVector{ 1.0F, 1.0F, 1.0F, 1.0F } / a.Value };
}
LANES_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  FloatVector bits = {};
  for (int lane = 0; lane < FloatCount; ++lane)
  {
    bits[lane] = static_cast<float>(words[lane] >> shift & mask);
  }
  return { bits };
}
LANES_INLINE void LoadFours(const float* const from[FloatCount], Floats to[4])
{
  for (int i = 0; i < 4; ++i)
  {
    to[i] = { FloatVector{ from[0][i], from[1][i], from[2][i], from[3][i] } };
  }
}

#endif

LANES_INLINE bool Any(Mask mask)
{
  return ToBits(mask) != 0;
}

}
}
