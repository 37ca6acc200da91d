// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The interpolation of an array on the points of a lattice.

#ifndef vtkIsosurfaceRayTraceLatticeSampling_h
#define vtkIsosurfaceRayTraceLatticeSampling_h

#include "vtkDataArray.h"
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Math/Vector.h"

#include <algorithm>
#include <cstddef>

VTK_ABI_NAMESPACE_BEGIN

/// A component at a place, in indices counted from the first point. Border values extend beyond the
/// lattice.
inline double vtkIsosurfaceRayTraceSampleLattice(vtkDataArray* array,
  const vtkIsosurfaceRayTracing::Index3& dimensions, const vtkIsosurfaceRayTracing::Vector3& index,
  int component)
{
  vtkIdType corner = 0;
  vtkIdType stride = 1;
  vtkIdType steps[3];
  double weights[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // NaN, from numbers that overflow, is at the begin.
    const int dimension = dimensions[axis];
    const double coordinate =
      std::min(std::max(0.0, index[axis]), static_cast<double>(dimension - 1));
    const int first = std::min(static_cast<int>(coordinate), std::max(0, dimension - 2));
    weights[axis] = coordinate - first;
    corner += first * stride;
    steps[axis] = dimension > 1 ? stride : 0;
    stride *= dimension;
  }
  double sum = 0.0;
  for (int i = 0; i < 8; ++i)
  {
    double weight = 1.0;
    vtkIdType point = corner;
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isUpper = (i >> axis & 1) != 0;
      weight *= isUpper ? weights[axis] : 1.0 - weights[axis];
      point += isUpper ? steps[axis] : 0;
    }
    // Values without weight may be NaN.
    sum += weight > 0.0 ? weight * array->GetComponent(point, component) : 0.0;
  }
  return sum;
}

VTK_ABI_NAMESPACE_END

#endif
