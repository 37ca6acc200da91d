// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PlacesOfHits_h
#define PlacesOfHits_h

#include "Field/TracedField.h"
#include "Math/Bounds.h"
#include "Math/Vector.h"
#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Moves hits of a field to where an earlier field has some, if they are there but for rounding,
/// which must not decide what is in front: surfaces of several fields, or their caps, may be at one
/// place. The rays are those of the field.
inline void MoveToEarlier(const TracedField& earlier, const RayHits& places,
  const TracedField& field, const RayPacket& rays, RayHits& hits)
{
  if (places.Hits.empty() || hits.Hits.empty() || earlier.GetRequest().Projection ||
    field.GetRequest().Projection)
  {
    return;
  }
  // More than what rounding may move hits by, as a part of the size of the field.
  constexpr double slack = 1e-10;
  const Bounds box = field.GetBounds();
  const double reach = slack * Length(box.Upper - box.Lower);
  for (int ray = 0; ray < rays.Count; ++ray)
  {
    const auto number = static_cast<std::size_t>(ray);
    auto place = places.Hits.begin() + static_cast<std::ptrdiff_t>(places.First[number]);
    const auto last = places.Hits.begin() + static_cast<std::ptrdiff_t>(places.First[number + 1]);
    if (place == last)
    {
      continue;
    }
    const double within = reach / Length(rays.GetDirection(ray));
    for (std::size_t i = hits.First[number]; i < hits.First[number + 1]; ++i)
    {
      // Both are in order.
      double& t = hits.Hits[i].T;
      place =
        std::find_if(place, last, [t, within](const Hit& hit) { return hit.T >= t - within; });
      t = place != last && place->T <= t + within ? place->T : t;
    }
  }
}

}

#endif
