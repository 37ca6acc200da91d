// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Doubles side by side in a vector register. Included by Kernels.inl only, once for every
// instruction set; everything is in an unnamed namespace and inlined, so that no code for one
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

#endif

LANES_INLINE bool Any(Mask mask)
{
  return ToBits(mask) != 0;
}

}
}
