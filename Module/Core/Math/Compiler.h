// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Compiler_h
#define Compiler_h

// What C++17 has no name for, in the words of the compiler. Beside this header only the vectors
// (Kernels/Vectors*.h) are written for certain compilers.
#if !defined(__GNUC__)
#error "Write here what your compiler has in place of the attributes and built-ins of GCC and clang"
#endif

#include <cstdint>

/// Inlined without optimization too.
#define SIMD_INLINE inline __attribute__((always_inline))

namespace vtkIsosurfaceRayTracing
{

/// Asks for the line of the cache that has an address. It is not read now, so it may be gone.
SIMD_INLINE void PrefetchLine(const void* address)
{
  __builtin_prefetch(address);
  // Else GCC takes functions that do nothing besides for ones without an effect, and removes calls
  // of them.
  __asm__ volatile("");
}

/// The number of the lowest bit that is set. One must be.
SIMD_INLINE int LowestBit(std::uint32_t bits)
{
  return __builtin_ctz(bits);
}

SIMD_INLINE int LowestBit(std::uint64_t bits)
{
  return __builtin_ctzll(bits);
}

/// The number of the highest bit that is set. One must be.
SIMD_INLINE int HighestBit(std::uint32_t bits)
{
  return 31 - __builtin_clz(bits);
}

SIMD_INLINE int HighestBit(std::uint64_t bits)
{
  return 63 - __builtin_clzll(bits);
}

/// How many bits are set.
SIMD_INLINE int CountBits(std::uint64_t bits)
{
  return __builtin_popcountll(bits);
}

/// A word whose bytes were copied from memory, with the first byte lowest.
SIMD_INLINE std::uint64_t FromLittleEndian(std::uint64_t word)
{
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  return __builtin_bswap64(word);
#else
  return word;
#endif
}

/// As many numbers as are given, whose operators work on each.
template <typename T, int Count>
struct ShortVector
{
  // GCC wants the attribute of a dependent type at the end of a typedef.
  typedef T Type __attribute__((vector_size(Count * sizeof(T)))); // NOLINT(modernize-use-using)
};

/// Converts each number of a ShortVector. (By reference: without AVX there is no other agreed way
/// to pass some of them.)
template <typename From, typename To>
SIMD_INLINE void Convert(const From& from, To& to)
{
  to = __builtin_convertvector(from, To);
}

#if defined(__x86_64__)

/// Whether the processor has the instructions of Kernels/VectorsAvx2.h.
SIMD_INLINE bool HasAvx2()
{
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
}

/// Whether the processor has the instructions of Kernels/VectorsAvx512.h.
SIMD_INLINE bool HasAvx512()
{
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
}

#endif

}

#endif
