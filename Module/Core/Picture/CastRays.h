// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CastRays_h
#define CastRays_h

#include "Field/TracedField.h"

#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A ray in the object space of a field, from t = Begin to t = End.
struct CastRay
{
  Vector3 Origin;
  Vector3 Direction;
  double Begin;
  double End;
};

/// The hits of any number of rays with what the field was selected for, traced on several threads.
RayHits CastRays(TracedField& field, const std::vector<CastRay>& rays, int threads);

/// The same with several fields, for each of which there are the rays in its object space. The hits
/// of a ray are in order whatever field they are of, up to the first opaque one, or to where no
/// transmittance is left. Surfaces must be selected: projections cannot be joined.
RayHits CastRays(const std::vector<TracedField*>& fields,
  const std::vector<std::vector<CastRay>>& rays, int threads);

}

#endif
