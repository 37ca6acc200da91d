// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The vectors of the compiler: SSE2, NEON, or whatever two doubles fit in. Included by Vectors.h
// only; see VectorsAvx512.h for what the functions do.

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr int DoubleWidth = 2;

using DoubleVector = double __attribute__((vector_size(16)));
using MaskVector = long long __attribute__((vector_size(16)));

struct Mask
{
  MaskVector Value;
};

/// Converts from double, so that arithmetic reads as for one number.
struct Doubles
{
  Doubles() = default;
  SIMD_INLINE Doubles(DoubleVector value)
    : Value(value)
  {
  }
  SIMD_INLINE Doubles(double value)
    : Value(DoubleVector{ value, value })
  {
  }

  DoubleVector Value;
};

SIMD_INLINE Mask operator&(Mask a, Mask b)
{
  return { a.Value & b.Value };
}
SIMD_INLINE Mask operator|(Mask a, Mask b)
{
  return { a.Value | b.Value };
}
SIMD_INLINE Mask operator^(Mask a, Mask b)
{
  return { a.Value ^ b.Value };
}
SIMD_INLINE Mask AndNot(Mask a, Mask b)
{
  return { a.Value & ~b.Value };
}
SIMD_INLINE unsigned int ToBits(Mask a)
{
  return static_cast<unsigned int>((a.Value[0] & 1) | (a.Value[1] & 2));
}
SIMD_INLINE Mask FirstLanes(int count)
{
  return { MaskVector{ -static_cast<long long>(count > 0), -static_cast<long long>(count > 1) } };
}

SIMD_INLINE Doubles Load(const double* a)
{
  return { DoubleVector{ a[0], a[1] } };
}
SIMD_INLINE void Store(Doubles a, double* to)
{
  to[0] = a.Value[0];
  to[1] = a.Value[1];
}
SIMD_INLINE Doubles LoadIntegers(const int* a)
{
  return { DoubleVector{ static_cast<double>(a[0]), static_cast<double>(a[1]) } };
}
SIMD_INLINE void StoreTruncated(Doubles a, int* to)
{
  to[0] = static_cast<int>(a.Value[0]);
  to[1] = static_cast<int>(a.Value[1]);
}
SIMD_INLINE Doubles Gather(const double* from, const int* indices)
{
  return { DoubleVector{ from[indices[0]], from[indices[1]] } };
}
SIMD_INLINE Doubles operator+(Doubles a, Doubles b)
{
  return { a.Value + b.Value };
}
SIMD_INLINE Doubles operator-(Doubles a, Doubles b)
{
  return { a.Value - b.Value };
}
SIMD_INLINE Doubles operator*(Doubles a, Doubles b)
{
  return { a.Value * b.Value };
}
SIMD_INLINE Doubles operator/(Doubles a, Doubles b)
{
  return { a.Value / b.Value };
}
SIMD_INLINE Doubles FusedMultiplyAdd(Doubles a, Doubles b, Doubles c)
{
  return { DoubleVector{ __builtin_fma(a.Value[0], b.Value[0], c.Value[0]),
    __builtin_fma(a.Value[1], b.Value[1], c.Value[1]) } };
}
SIMD_INLINE Doubles Sqrt(Doubles a)
{
  return { DoubleVector{ __builtin_sqrt(a.Value[0]), __builtin_sqrt(a.Value[1]) } };
}
SIMD_INLINE Doubles Floor(Doubles a)
{
  return { DoubleVector{ __builtin_floor(a.Value[0]), __builtin_floor(a.Value[1]) } };
}
SIMD_INLINE Doubles Abs(Doubles a)
{
  return { DoubleVector{ __builtin_fabs(a.Value[0]), __builtin_fabs(a.Value[1]) } };
}
SIMD_INLINE Doubles CopySign(Doubles a, Doubles b)
{
  return { DoubleVector{
    __builtin_copysign(a.Value[0], b.Value[0]), __builtin_copysign(a.Value[1], b.Value[1]) } };
}
/// Those of the bits that are in a mask are replaced by others.
SIMD_INLINE Doubles ReplaceBits(Doubles a, std::uint64_t mask, std::uint64_t bits)
{
  const auto replaced = static_cast<long long>(mask);
  const auto others = static_cast<long long>(bits);
  return { reinterpret_cast<DoubleVector>(
    (reinterpret_cast<MaskVector>(a.Value) & ~MaskVector{ replaced, replaced }) |
    MaskVector{ others, others }) };
}
SIMD_INLINE Mask operator<(Doubles a, Doubles b)
{
  return { a.Value < b.Value };
}
SIMD_INLINE Mask operator<=(Doubles a, Doubles b)
{
  return { a.Value <= b.Value };
}
SIMD_INLINE Mask operator==(Doubles a, Doubles b)
{
  return { a.Value == b.Value };
}
SIMD_INLINE Doubles Select(Mask mask, Doubles yes, Doubles no)
{
  return { reinterpret_cast<DoubleVector>((reinterpret_cast<MaskVector>(yes.Value) & mask.Value) |
    (reinterpret_cast<MaskVector>(no.Value) & ~mask.Value)) };
}
SIMD_INLINE Doubles Min(Doubles a, Doubles b)
{
  return Select(b < a, b, a);
}
SIMD_INLINE Doubles Max(Doubles a, Doubles b)
{
  return Select(a < b, b, a);
}

SIMD_INLINE double ReduceMin(Doubles a)
{
  return a.Value[1] < a.Value[0] ? a.Value[1] : a.Value[0];
}
SIMD_INLINE Mask ToMask(unsigned int bits)
{
  double lanes[DoubleWidth];
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    lanes[lane] = static_cast<double>(bits >> lane & 1U);
  }
  return Doubles(0.0) < Load(lanes);
}
SIMD_INLINE void StorePairs(Doubles first, Doubles second, float (*pairs)[2])
{
  double lanes[2][DoubleWidth];
  Store(first, lanes[0]);
  Store(second, lanes[1]);
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    pairs[lane][0] = static_cast<float>(lanes[0][lane]);
    pairs[lane][1] = static_cast<float>(lanes[1][lane]);
  }
}
SIMD_INLINE int AppendLanes(int first, unsigned int lanes, int* numbers)
{
  int count = 0;
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    numbers[count] = first + lane;
    count += static_cast<int>(lanes >> lane & 1U);
  }
  return count;
}
SIMD_INLINE void StoreLanes(Doubles a, unsigned int lanes, double* to)
{
  double all[DoubleWidth];
  Store(a, all);
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    *to = all[lane];
    to += lanes >> lane & 1U;
  }
}
SIMD_INLINE int CopyLanes(const int* from, unsigned int lanes, int* to)
{
  int count = 0;
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    to[count] = from[lane];
    count += static_cast<int>(lanes >> lane & 1U);
  }
  return count;
}

SIMD_INLINE void LoadFours(const double* const from[DoubleWidth], Doubles to[4])
{
  for (int i = 0; i < 4; ++i)
  {
    to[i] = { DoubleVector{ from[0][i], from[1][i] } };
  }
}
SIMD_INLINE void StoreFours(const Doubles from[4], double* to, int stride)
{
  for (int i = 0; i < 4; ++i)
  {
    to[i] = from[i].Value[0];
    to[stride + i] = from[i].Value[1];
  }
}

constexpr int FloatWidth = 4;

using FloatVector = float __attribute__((vector_size(16)));
using FloatMaskVector = int __attribute__((vector_size(16)));

struct FloatMask
{
  FloatMaskVector Value;
};

/// Converts from float, so that arithmetic reads as for one number.
struct Floats
{
  Floats() = default;
  SIMD_INLINE Floats(FloatVector value)
    : Value(value)
  {
  }
  SIMD_INLINE Floats(float value)
    : Value(FloatVector{ value, value, value, value })
  {
  }

  FloatVector Value;
};

SIMD_INLINE FloatMask operator&(FloatMask a, FloatMask b)
{
  return { a.Value & b.Value };
}
SIMD_INLINE FloatMask operator|(FloatMask a, FloatMask b)
{
  return { a.Value | b.Value };
}
SIMD_INLINE unsigned int ToBits(FloatMask a)
{
  return static_cast<unsigned int>(
    (a.Value[0] & 1) | (a.Value[1] & 2) | (a.Value[2] & 4) | (a.Value[3] & 8));
}
SIMD_INLINE Floats LoadFloats(const float* a)
{
  return { FloatVector{ a[0], a[1], a[2], a[3] } };
}
SIMD_INLINE void StoreFloats(Floats a, float* to)
{
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    to[lane] = a.Value[lane];
  }
}
SIMD_INLINE Floats Select(FloatMask mask, Floats yes, Floats no)
{
  return { reinterpret_cast<FloatVector>(
    (reinterpret_cast<FloatMaskVector>(yes.Value) & mask.Value) |
    (reinterpret_cast<FloatMaskVector>(no.Value) & ~mask.Value)) };
}
SIMD_INLINE Floats Round(Doubles low, Doubles high)
{
  return { FloatVector{ static_cast<float>(low.Value[0]), static_cast<float>(low.Value[1]),
    static_cast<float>(high.Value[0]), static_cast<float>(high.Value[1]) } };
}
SIMD_INLINE void StoreRounded(Doubles a, float* to)
{
  to[0] = static_cast<float>(a.Value[0]);
  to[1] = static_cast<float>(a.Value[1]);
}
SIMD_INLINE Doubles LoadWidened(const float* a)
{
  return { DoubleVector{ static_cast<double>(a[0]), static_cast<double>(a[1]) } };
}
SIMD_INLINE Floats operator+(Floats a, Floats b)
{
  return { a.Value + b.Value };
}
SIMD_INLINE Floats operator-(Floats a, Floats b)
{
  return { a.Value - b.Value };
}
SIMD_INLINE Floats operator*(Floats a, Floats b)
{
  return { a.Value * b.Value };
}
SIMD_INLINE Floats operator/(Floats a, Floats b)
{
  return { a.Value / b.Value };
}
SIMD_INLINE Floats MultiplyAdd(Floats a, Floats b, Floats c)
{
  return { a.Value * b.Value + c.Value };
}
SIMD_INLINE Floats Abs(Floats a)
{
  return { reinterpret_cast<FloatVector>(reinterpret_cast<FloatMaskVector>(a.Value) &
    FloatMaskVector{ 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF, 0x7FFFFFFF }) };
}
SIMD_INLINE FloatMask operator<(Floats a, Floats b)
{
  return { a.Value < b.Value };
}
SIMD_INLINE Floats Min(Floats a, Floats b)
{
  return { b.Value < a.Value ? b.Value : a.Value };
}
SIMD_INLINE Floats Max(Floats a, Floats b)
{
  return { a.Value < b.Value ? b.Value : a.Value };
}
SIMD_INLINE Floats MaxAbs(Floats a, Floats b)
{
  return Max(Abs(a), Abs(b));
}
SIMD_INLINE float ReduceMin(Floats a)
{
  const float first = a.Value[1] < a.Value[0] ? a.Value[1] : a.Value[0];
  const float second = a.Value[3] < a.Value[2] ? a.Value[3] : a.Value[2];
  return second < first ? second : first;
}
SIMD_INLINE Floats CopySign(Floats a, Floats b)
{
  return { FloatVector{ __builtin_copysignf(a.Value[0], b.Value[0]),
    __builtin_copysignf(a.Value[1], b.Value[1]), __builtin_copysignf(a.Value[2], b.Value[2]),
    __builtin_copysignf(a.Value[3], b.Value[3]) } };
}
/// The highest bit of each lane tells.
SIMD_INLINE FloatMask HaveDifferentSigns(Floats a, Floats b)
{
  return {
    (reinterpret_cast<FloatMaskVector>(a.Value) ^ reinterpret_cast<FloatMaskVector>(b.Value)) >> 31
  };
}
SIMD_INLINE FloatMask AndNot(FloatMask a, FloatMask b)
{
  return { a.Value & ~b.Value };
}
SIMD_INLINE Floats ApproximateReciprocal(Floats a)
{
  return { FloatVector{ 1.0F, 1.0F, 1.0F, 1.0F } / a.Value };
}
SIMD_INLINE Floats GetBits(const unsigned int* words, int shift, unsigned int mask)
{
  FloatVector bits = {};
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    bits[lane] = static_cast<float>(words[lane] >> shift & mask);
  }
  return { bits };
}
SIMD_INLINE Floats LoadBytes(const std::uint8_t* a)
{
  return { FloatVector{ static_cast<float>(a[0]), static_cast<float>(a[1]),
    static_cast<float>(a[2]), static_cast<float>(a[3]) } };
}
SIMD_INLINE void LoadFours(const float* const from[FloatWidth], Floats to[4], int at = 0)
{
  for (int i = 0; i < 4; ++i)
  {
    to[i] = { FloatVector{ from[0][at + i], from[1][at + i], from[2][at + i], from[3][at + i] } };
  }
}
SIMD_INLINE void StoreFours(const Floats from[4], float* to)
{
  for (int lane = 0; lane < FloatWidth; ++lane)
  {
    for (int i = 0; i < 4; ++i)
    {
      to[4 * lane + i] = from[i].Value[lane];
    }
  }
}

//------------------------------------------------------------------------------
// Samples are loaded one by one.
template <typename T>
constexpr bool HasWords = false;
template <typename T>
SIMD_INLINE void LoadFloatPairs(const void* const* rows, std::ptrdiff_t index, Floats pair[2])
{
  for (int k = 0; k < 2; ++k)
  {
    for (int lane = 0; lane < FloatWidth; ++lane)
    {
      pair[k].Value[lane] = static_cast<float>(static_cast<const T*>(rows[lane])[index + k]);
    }
  }
}

//------------------------------------------------------------------------------
using SliceMasks = const std::uint64_t*;

SIMD_INLINE SliceMasks LoadSlices(const std::uint64_t slices[8])
{
  return slices;
}

SIMD_INLINE unsigned int FindCellsOfRay(const float middle[2], const float slope[2], float margin,
  SliceMasks slices, std::uint64_t cells[8])
{
  unsigned int any = 0;
  for (int slice = 0; slice < 8; ++slice)
  {
    cells[slice] = 0;
    if (slices[slice] == 0)
    {
      continue;
    }
    int low[2];
    int high[2];
    for (int j = 0; j < 2; ++j)
    {
      const float near = middle[j] + static_cast<float>(slice - 4) * slope[j];
      const float far = near + slope[j];
      const float least = (near < far ? near : far) - margin;
      const float most = (near < far ? far : near) + margin;
      low[j] = least > 0.0F ? static_cast<int>(least) : 0;
      high[j] = most < 0.0F ? -1 : (most < 8.0F ? static_cast<int>(most) : 7);
    }
    if (low[0] <= high[0] && low[1] <= high[1] && low[0] < 8 && low[1] < 8)
    {
      const std::uint64_t columns = (0xFFU << low[0] & 0xFFU & 0xFFU >> (7 - high[0]));
      const std::uint64_t rows =
        (~std::uint64_t{ 0 } << (8 * low[1])) & (~std::uint64_t{ 0 } >> (8 * (7 - high[1])));
      cells[slice] = slices[slice] & rows & (columns * 0x0101010101010101U);
      any |= static_cast<unsigned int>(cells[slice] != 0) << slice;
    }
  }
  return any;
}

SIMD_INLINE unsigned int FindCellsBetweenPlanes(const float line[2], const float slope[2],
  float margin, const float* const planes[3], SliceMasks slices, std::uint64_t cells[8])
{
  unsigned int any = 0;
  for (int slice = 0; slice < 8; ++slice)
  {
    cells[slice] = 0;
    if (slices[slice] == 0)
    {
      continue;
    }
    std::uint64_t columns = 0;
    std::uint64_t rows = 0;
    for (int j = 0; j < 2; ++j)
    {
      const float near = line[j] + planes[0][slice] * slope[j];
      const float far = line[j] + planes[0][slice + 1] * slope[j];
      const float least = (near < far ? near : far) - margin;
      const float most = (near < far ? far : near) + margin;
      for (int i = 0; i < 8; ++i)
      {
        const bool isMet = least <= planes[1 + j][i + 1] && planes[1 + j][i] <= most;
        columns |= j == 0 && isMet ? std::uint64_t{ 1 } << i : 0U;
        rows |= j == 1 && isMet ? std::uint64_t{ 0xFF } << (8 * i) : 0U;
      }
    }
    cells[slice] = slices[slice] & rows & (columns * 0x0101010101010101U);
    any |= static_cast<unsigned int>(cells[slice] != 0) << slice;
  }
  return any;
}

}
}
