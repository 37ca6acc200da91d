// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FlatEdges_h
#define FlatEdges_h

#include "Math/Arithmetic.h"

namespace vtkIsosurfaceRayTracing
{

/// Whether three edges are in one plane, given the volume that they span: then it is no more than
/// what rounding makes of it.
template <typename Number>
SIMD_INLINE auto AreFlat(const Number x[3], const Number y[3], const Number z[3], Number volume)
{
  Number size = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    size = size + Abs(x[i]) * (Abs(y[j] * z[k]) + Abs(y[k] * z[j]));
  }
  return Abs(volume) <= 1e-13 * size;
}

}

#endif
