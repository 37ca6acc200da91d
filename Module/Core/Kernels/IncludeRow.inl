// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The ranges of rows of samples. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

template <typename T>
void IncludeRow(const void* row, void* low, void* high, std::ptrdiff_t count)
{
  const T* values = static_cast<const T*>(row);
  T* lows = static_cast<T*>(low);
  T* highs = static_cast<T*>(high);
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    IncludeLow(values[i], lows[i]);
    IncludeHigh(values[i], highs[i]);
  }
}

}
}
