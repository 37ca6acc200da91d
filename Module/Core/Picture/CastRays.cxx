// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CastRays.h"

#include "Field/FirstException.h"
#include "Field/HitCollector.h"
#include "Picture/OpaqueEnds.h"
#include "Picture/PlacesOfHits.h"

#include <algorithm>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Finds the hits of a packet of rays with one field.
void TraceField(TracedField& field, const CastRay* rays, std::size_t count, const OpaqueEnds& ends,
  RayPacket& packet, RayHits& hits)
{
  packet.Clear();
  for (std::size_t ray = 0; ray < count; ++ray)
  {
    packet.Append(rays[ray].Origin, rays[ray].Direction, rays[ray].Begin, rays[ray].End);
  }
  field.ClipRays(packet);
  ends.Cut(packet);
  field.Trace(packet, hits);
}

/// Drops the hits of a ray behind which no transmittance is left; they begin at first. The values
/// of projections hide nothing.
void DropInvisible(
  const std::vector<TracedField*>& fields, std::size_t first, std::vector<Hit>& hits)
{
  double transmittance = 1.0;
  const auto last = std::find_if(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(),
    [&fields, &transmittance](const Hit& hit)
    {
      const TraceRequest& request = fields[static_cast<std::size_t>(hit.Field)]->GetRequest();
      transmittance *= request.Projection ? 1.0 : 1.0 - request.GetOpacity(hit);
      return transmittance < NegligibleTransmittance;
    });
  if (last != hits.end())
  {
    hits.erase(last + 1, hits.end());
  }
}

/// Joins the hits of each ray with several fields.
void Join(const std::vector<TracedField*>& fields, const std::vector<RayHits>& ofFields,
  std::size_t rays, RayHits& joined)
{
  joined.Clear();
  for (std::size_t ray = 0; ray < rays; ++ray)
  {
    const std::size_t first = joined.Hits.size();
    for (std::size_t i = 0; i < ofFields.size(); ++i)
    {
      for (std::size_t k = ofFields[i].First[ray]; k < ofFields[i].First[ray + 1]; ++k)
      {
        joined.Hits.push_back(ofFields[i].Hits[k]);
        joined.Hits.back().Field = static_cast<int>(i);
      }
    }
    std::stable_sort(joined.Hits.begin() + static_cast<std::ptrdiff_t>(first), joined.Hits.end(),
      [](const Hit& a, const Hit& b) { return a.T < b.T; });
    DropInvisible(fields, first, joined.Hits);
    joined.EndRay();
  }
}

/// Finds the hits of a packet of rays.
void TracePacket(const std::vector<TracedField*>& fields,
  const std::vector<std::vector<CastRay>>& rays, std::size_t first, std::size_t count,
  RayHits& hits)
{
  RayPacket packet;
  OpaqueEnds ends;
  if (fields.size() == 1)
  {
    TraceField(*fields.front(), &rays.front()[first], count, ends, packet, hits);
    return;
  }
  std::vector<RayHits> ofFields(fields.size());
  for (std::size_t i = 0; i < fields.size(); ++i)
  {
    TraceField(*fields[i], &rays[i][first], count, ends, packet, ofFields[i]);
    for (std::size_t k = 0; k < i; ++k)
    {
      MoveToEarlier(*fields[k], ofFields[k], *fields[i], packet, ofFields[i]);
    }
    ends.Add(fields[i]->GetRequest(), ofFields[i]);
  }
  Join(fields, ofFields, count, hits);
}

}

//------------------------------------------------------------------------------
RayHits CastRays(TracedField& field, const std::vector<CastRay>& rays, int threads)
{
  return CastRays(std::vector<TracedField*>{ &field }, { rays }, threads);
}

//------------------------------------------------------------------------------
RayHits CastRays(const std::vector<TracedField*>& fields,
  const std::vector<std::vector<CastRay>>& rays, int threads)
{
  constexpr std::size_t size = RayPacket::Capacity;
  const std::size_t count = rays.front().size();
  const std::size_t packets = (count + size - 1) / size;
  std::vector<RayHits> found(packets);
  FirstException exception;
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(packets); ++i)
  {
    exception.Guard(
      [&]
      {
        const auto number = static_cast<std::size_t>(i);
        const std::size_t first = number * size;
        TracePacket(fields, rays, first, std::min(size, count - first), found[number]);
      });
  }
  exception.Rethrow();

  RayHits all;
  all.Clear();
  for (const RayHits& some : found)
  {
    all.Append(some);
  }
  return all;
}

}
