// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PlanesOfCaps_h
#define PlanesOfCaps_h

#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"
#include "Rays/TraceRequest.h"

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where the same rays meet the planes of caps in several fields, traced one after the other: at
/// the T that the first field with a cap there has found. Those of the others differ by rounding,
/// which must not decide whose cap is seen.
class PlanesOfCaps
{
public:
  /// Forgets the hits of other rays.
  void Clear() { this->Planes.clear(); }

  /// Moves the caps of a field there. The planes that all fields have in common are the last ones
  /// of what is visible of each.
  void MoveCaps(const TraceRequest& request, RayHits& hits)
  {
    for (std::size_t ray = 0; request.Visible.HasCaps() && ray + 1 < hits.First.size(); ++ray)
    {
      for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
      {
        Hit& hit = hits.Hits[i];
        if (hit.Plane != Hit::NoPlane)
        {
          const auto plane = static_cast<std::size_t>(hit.Plane);
          double& t = this->GetT(request.Visible.HalfSpaces.size() - 1 - plane, ray);
          t = t == NotMet ? hit.T : t;
          hit.T = t;
        }
      }
    }
  }

private:
  static constexpr double NotMet = std::numeric_limits<double>::infinity();
  using TOfRays = std::array<double, RayPacket::Capacity>;

  double& GetT(std::size_t planeFromLast, std::size_t ray)
  {
    if (planeFromLast >= this->Planes.size())
    {
      TOfRays none;
      none.fill(NotMet);
      this->Planes.resize(planeFromLast + 1, none);
    }
    return this->Planes[planeFromLast][ray];
  }

  std::vector<TOfRays> Planes;
};

}

#endif
