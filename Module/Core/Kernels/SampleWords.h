// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Samples of the words of 8, 4 or 2 bytes that some instruction sets load, one in each lane; see
// SampleRows.h. Included by Vectors.h only, after the vectors of such a set.

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename T, int Count>
SIMD_INLINE void LoadWordRow(const void* const* rows, std::ptrdiff_t index, Doubles values[Count])
{
  const auto words =
    LoadWords<Count * sizeof(T)>(rows, index * static_cast<std::ptrdiff_t>(sizeof(T)));
  for (int k = 0; k < Count; ++k)
  {
    values[k] = TakeFromWords<T>(words, k);
  }
}

template <typename T>
SIMD_INLINE void LoadFloatPairs(const void* const* rows, std::ptrdiff_t index, Floats pair[2])
{
  constexpr int size = 2 * sizeof(T);
  const std::ptrdiff_t bytes = index * static_cast<std::ptrdiff_t>(sizeof(T));
  const auto low = LoadWords<size>(rows, bytes);
  const auto high = LoadWords<size>(rows + DoubleWidth, bytes);
  for (int k = 0; k < 2; ++k)
  {
    pair[k] = TakeFromWords<T>(low, high, k);
  }
}

}
}
