// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SameBits_h
#define SameBits_h

#include "Rays/Hit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

// Comparisons to the last bit, for results that must not depend on threads, settings or kernels.

namespace vtkIsosurfaceRayTracing
{

/// Tells the zeros apart.
inline bool AreSameBits(double a, double b)
{
  return std::memcmp(&a, &b, sizeof(a)) == 0;
}

/// The same where a NaN equals any NaN: no standard defines which one an operation returns.
inline bool AreSameNumbers(double a, double b)
{
  return AreSameBits(a, b) || (std::isnan(a) && std::isnan(b));
}

inline bool AreSame(const Hit& a, const Hit& b)
{
  return AreSameBits(a.T, b.T) && a.Cell == b.Cell && a.Surface == b.Surface &&
    std::equal(a.Parametric.begin(), a.Parametric.end(), b.Parametric.begin(),
      [](double x, double y) { return AreSameBits(x, y); }) &&
    a.Entering == b.Entering && a.Jump == b.Jump && a.Plane == b.Plane && a.Member == b.Member &&
    AreSameBits(a.Value, b.Value);
}

inline bool AreSame(const std::vector<Hit>& a, const std::vector<Hit>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const Hit& x, const Hit& y) { return AreSame(x, y); });
}

}

#endif
