// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef HitOrder_h
#define HitOrder_h

#include "Rays/Hit.h"
#include "Rays/TraceRequest.h"

#include <cmath>
#include <vector>

// Where a ray passes a face, an edge or a vertex, hits in several cells are at one place, but for
// rounding. Their order is made up for: a ray enters and leaves a surface in turn.

namespace vtkIsosurfaceRayTracing
{

/// Hits at one place differ by no more than this part of their t.
constexpr double ToleranceOfPlace = 1e-13;

/// What rounding may move hits by that are at one place: by so much, on a ray that was moved to
/// begin at the base. Hits that far beyond the first opaque one decide about its order.
inline double GetReachOfPlace(double t, double base)
{
  return 4.0 * ToleranceOfPlace * (std::abs(t) + std::abs(base));
}

/// Puts the hits of a ray in order. In: all up to the first opaque one and its place, and perhaps
/// some beyond, in any order; out: those without the ones beyond. The ray starts inside of the
/// surfaces up to one, or of none: Hit::NoSurface.
void PutInOrder(const TraceRequest& request, int startsInside, std::vector<Hit>& hits);

}

#endif
