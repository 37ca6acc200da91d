// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ValueRange_h
#define ValueRange_h

#include "Math/Arithmetic.h"

#include <limits>

namespace vtkIsosurfaceRayTracing
{

// Without a branch, so that rows of samples are vectorized.

/// Includes a sample in the smallest so far. NaN and infinite samples do not count.
template <typename T>
SIMD_INLINE void IncludeLow(T value, T& low)
{
  if constexpr (std::numeric_limits<T>::has_infinity)
  {
    constexpr T lowest = std::numeric_limits<T>::lowest();
    low = ((value < low) & (value >= lowest)) ? value : low;
  }
  else
  {
    low = value < low ? value : low;
  }
}

/// The same for the largest.
template <typename T>
SIMD_INLINE void IncludeHigh(T value, T& high)
{
  if constexpr (std::numeric_limits<T>::has_infinity)
  {
    constexpr T largest = std::numeric_limits<T>::max();
    high = ((value > high) & (value <= largest)) ? value : high;
  }
  else
  {
    high = value > high ? value : high;
  }
}

/// The smallest and the largest of a set of samples, in their own type: nothing is rounded. NaN
/// does not count. The range of no samples has Min > Max.
template <typename T>
struct ValueRange
{
  T Min = std::numeric_limits<T>::max();
  T Max = std::numeric_limits<T>::lowest();

  void Include(T low, T high)
  {
    IncludeLow(low, this->Min);
    IncludeHigh(high, this->Max);
  }

  /// Whether samples lie on both sides of the isovalue, by the rule that equal is inside.
  bool Straddles(double isovalue) const
  {
    return static_cast<double>(this->Min) < isovalue && isovalue <= static_cast<double>(this->Max);
  }

  /// The same for a range extended at both ends by a multiple of its length.
  bool Straddles(double isovalue, double overshoot) const
  {
    const auto low = static_cast<double>(this->Min);
    const auto high = static_cast<double>(this->Max);
    const double margin = overshoot * (high - low);
    return low <= high && low - margin < isovalue && isovalue <= high + margin;
  }
};

}

#endif
