// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OpaqueEnds_h
#define OpaqueEnds_h

#include "Rays/RayHits.h"
#include "Rays/RayPacket.h"
#include "Rays/TraceRequest.h"

#include <algorithm>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// Where the same rays end in several fields, traced one after the other: at the nearest opaque
/// hits so far, as nothing is visible behind.
class OpaqueEnds
{
public:
  OpaqueEnds() { this->Clear(); }

  /// Forgets the hits of other rays.
  void Clear()
  {
    std::fill_n(this->T, RayPacket::Capacity, std::numeric_limits<double>::infinity());
  }

  /// Ends rays there, before they are traced through the next field.
  void Cut(RayPacket& packet) const
  {
    for (int i = 0; i < packet.Count; ++i)
    {
      if (!Has(packet.Exists, i))
      {
        continue;
      }
      packet.End[i] = std::min(packet.End[i], this->T[i] - packet.Base[i]);
      if (!(packet.Begin[i] <= packet.End[i]))
      {
        Remove(i, packet.Exists);
      }
    }
  }

  /// Adds the hits of a field, with what was selected of it.
  void Add(const TraceRequest& request, const RayHits& hits)
  {
    for (std::size_t ray = 0; !request.Projection && ray + 1 < hits.First.size(); ++ray)
    {
      // Behind an opaque hit a ray has no others.
      const std::size_t end = hits.First[ray + 1];
      if (hits.First[ray] < end && request.GetOpacity(hits.Hits[end - 1]) >= 1.0)
      {
        this->T[ray] = std::min(this->T[ray], hits.Hits[end - 1].T);
      }
    }
  }

private:
  double T[RayPacket::Capacity];
};

}

#endif
