// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rows of samples of any type, one in each lane of a vector, gathered as doubles. Included by
// Kernels.inl only, after Vectors.h and under the same rules.

namespace vtkIsosurfaceRayTracing
{
namespace
{

// Defined by the instruction sets that have words of 8 or 4 bytes, one in each lane, that hold some
// samples each.
/// Neighbours that are next to each other in memory.
template <typename T, int Count>
void LoadWordRow(const void* const* rows, int lanes, std::ptrdiff_t index, Doubles values[Count]);
/// The same for two, in single precision.
template <typename T>
void LoadFloatPairs(const void* const* rows, std::ptrdiff_t index, Floats pair[2]);

/// One sample in each of the first lanes, at an index of the lane's row. The other lanes have the
/// sample of the first.
template <typename T>
SIMD_INLINE Doubles LoadSamples(const void* const* rows, int lanes, std::ptrdiff_t index)
{
  double values[DoubleWidth];
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    const void* row = rows[lane < lanes ? lane : 0];
    values[lane] = static_cast<double>(static_cast<const T*>(row)[index]);
  }
  return Load(values);
}

/// Neighbours along x in each of the first lanes, starting at an index of the lane's row. Reads
/// nothing beyond them.
template <typename T, int Count>
SIMD_INLINE void LoadRow(const void* const* rows, int lanes, std::ptrdiff_t index,
  std::ptrdiff_t stride, Doubles values[Count])
{
  constexpr int size = Count * sizeof(T);
  if constexpr (HasWords<T> && size > 8)
  {
    LoadRow<T, Count / 2>(rows, lanes, index, stride, values);
    LoadRow<T, Count / 2>(rows, lanes, index + Count / 2 * stride, stride, values + Count / 2);
    return;
  }
  else if constexpr (HasWords<T> && size >= 4)
  {
    if (stride == 1)
    {
      LoadWordRow<T, Count>(rows, lanes, index, values);
      return;
    }
  }
  for (int k = 0; k < Count; ++k)
  {
    values[k] = LoadSamples<T>(rows, lanes, index + k * stride);
  }
}

/// Two neighbours along x in each lane, in single precision. There must be a row for every lane.
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
  LoadRow<T, 2>(rows, DoubleWidth, index, stride, low);
  LoadRow<T, 2>(rows + DoubleWidth, DoubleWidth, index, stride, high);
  pair[0] = Round(low[0], high[0]);
  pair[1] = Round(low[1], high[1]);
}

}
}
