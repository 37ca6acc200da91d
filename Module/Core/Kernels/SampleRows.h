// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rows of samples of any type, one in each lane of a vector, as doubles. Included by
// Kernels.inl only, after Vectors.h and under the same rules.

namespace vtkIsosurfaceRayTracing
{
namespace
{

// Defined by the instruction sets that load words of 8, 4 or 2 bytes, one in each lane, which hold
// some samples each.
/// Neighbours that are next to each other in memory.
template <typename T, int Count>
void LoadWordRow(const void* const* rows, std::ptrdiff_t index, Doubles values[Count]);
/// The same for two, in single precision.
template <typename T>
void LoadFloatPairs(const void* const* rows, std::ptrdiff_t index, Floats pair[2]);

/// Whether pairs of samples of a type are loaded in single precision.
template <typename T>
constexpr bool HasFloatPairs = sizeof(T) <= 2 || (IsFloating<T> && sizeof(T) == 4);

/// The rows of a vector, of which the first has a number, of so many; the last is repeated.
SIMD_INLINE void TakeRows(
  const void* const* rows, int first, int count, const void* taken[DoubleWidth])
{
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    taken[lane] = rows[SmallerOf(first + lane, count - 1)];
  }
}

/// One sample in each lane, at an index of the lane's row.
template <typename T>
SIMD_INLINE Doubles LoadSamples(const void* const* rows, std::ptrdiff_t index)
{
  double values[DoubleWidth];
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    values[lane] = static_cast<double>(static_cast<const T*>(rows[lane])[index]);
  }
  return Load(values);
}

/// Neighbours along x in each lane, starting at an index of the lane's row. Reads nothing beyond
/// them.
template <typename T, int Count>
SIMD_INLINE void LoadRow(
  const void* const* rows, std::ptrdiff_t index, std::ptrdiff_t stride, Doubles values[Count])
{
  constexpr int size = Count * sizeof(T);
  if constexpr (HasWords<T> && size > 8)
  {
    LoadRow<T, Count / 2>(rows, index, stride, values);
    LoadRow<T, Count / 2>(rows, index + Count / 2 * stride, stride, values + Count / 2);
    return;
  }
  else if constexpr (HasWords<T> && size >= 2)
  {
    if (stride == 1)
    {
      LoadWordRow<T, Count>(rows, index, values);
      return;
    }
  }
  for (int k = 0; k < Count; ++k)
  {
    values[k] = LoadSamples<T>(rows, index + k * stride);
  }
}

/// Two neighbours along x in each lane, in single precision.
template <typename T>
SIMD_INLINE void LoadRowOfFloats(
  const void* const* rows, std::ptrdiff_t index, std::ptrdiff_t stride, Floats pair[2])
{
  if constexpr (HasFloatPairs<T>)
  {
    if (stride == 1)
    {
      LoadFloatPairs<T>(rows, index, pair);
      return;
    }
  }
  Doubles low[2];
  Doubles high[2];
  LoadRow<T, 2>(rows, index, stride, low);
  LoadRow<T, 2>(rows + DoubleWidth, index, stride, high);
  pair[0] = Round(low[0], high[0]);
  pair[1] = Round(low[1], high[1]);
}

}
}
