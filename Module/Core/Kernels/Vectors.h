// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// SIMD vectors of doubles and floats, of the instruction set that is compiled for. Included by
// Kernels.inl only; everything is in an unnamed namespace and inlined, so that no code for one
// processor is ever linked into a program for another.
//
// Every instruction set has, with the names of Math/Arithmetic.h wherever it has the operation too:
// Doubles with DoubleWidth lanes and Floats with FloatWidth, which is twice that; Mask and
// FloatMask, a truth value for each lane; and functions for what the sets do in their own ways:
// loading words of samples (see SampleRows.h) and the cells of a ray in a block (FindCellsOfRay).

#include "Math/Arithmetic.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename T>
constexpr bool IsFloating = static_cast<T>(0.5) != 0;
template <typename T>
constexpr bool IsSigned = static_cast<T>(-1) < 0;

/// A word of 8, 4 or 2 bytes.
template <int Size>
using WordOf =
  std::conditional_t<Size == 8, long long, std::conditional_t<Size == 4, int, std::uint16_t>>;

template <typename Word>
SIMD_INLINE Word LoadWord(const void* row, std::ptrdiff_t bytes)
{
  Word word;
  __builtin_memcpy(&word, static_cast<const char*>(row) + bytes, sizeof(word));
  return word;
}

}
}

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512BW__) && defined(__AVX512VL__)
#include "Kernels/VectorsAvx512.h"

#include "Kernels/SampleWords.h"
#elif defined(__AVX2__) && defined(__FMA__)
#include "Kernels/VectorsAvx2.h"

#include "Kernels/SampleWords.h"
#else
#include "Kernels/VectorsGeneric.h"
#endif

namespace vtkIsosurfaceRayTracing
{
namespace
{

SIMD_INLINE bool Any(Mask mask)
{
  return ToBits(mask) != 0;
}

SIMD_INLINE double ReduceMax(Doubles a)
{
  return -ReduceMin(0.0 - a);
}

SIMD_INLINE float ReduceMax(Floats a)
{
  return -ReduceMin(0.0F - a);
}

}
}
