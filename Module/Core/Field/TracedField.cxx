// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Field/TracedField.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void TracedField::ClipRays(RayPacket& packet) const
{
  RayPacket clipped;
  clipped.Clear();
  for (int i = 0; i < packet.Count; ++i)
  {
    if (Has(packet.Exists, i))
    {
      this->AddRay(
        packet.GetOrigin(i), packet.GetDirection(i), packet.Begin[i], packet.End[i], clipped);
    }
    else
    {
      ++clipped.Count;
    }
  }
  clipped.Columns = packet.Columns;
  packet = clipped;
}

//------------------------------------------------------------------------------
void TracedField::MoveRays(
  const RayPacket& rays, const RaysInBox& parts, const Matrix4& ownFromRays, RayPacket& moved) const
{
  moved.Clear();
  for (int i = 0; i < rays.Count; ++i)
  {
    if (Has(parts.Rays, i))
    {
      this->AddRay(TransformPoint(ownFromRays, rays.GetOrigin(i)),
        TransformDirection(ownFromRays, rays.GetDirection(i)), parts.Begin[i], parts.End[i], moved);
    }
    else
    {
      ++moved.Count;
    }
  }
  moved.Columns = rays.Columns;
}

//------------------------------------------------------------------------------
void TracedField::MakeRays(const Camera& view, const PixelRectangle& pixels,
  const PixelDepths& depths, RayPacket& packet) const
{
  packet.Clear();
  packet.Columns = pixels.Width;
  for (int y = 0; y < pixels.Height; ++y)
  {
    for (int x = 0; x < pixels.Width; ++x)
    {
      const Camera::PixelRay ray = view.GetRay(pixels.X + x, pixels.Y + y, depths.Get(x, y));
      this->AddRay(ray.Origin, ray.Direction, 0.0, ray.End, packet);
    }
  }
}

//------------------------------------------------------------------------------
void TracedField::TracePackets(TracedPacket* packets, int count, Beam* beam)
{
  for (int i = 0; i < count; ++i)
  {
    this->Trace(packets[i].Rays, packets[i].Hits, beam);
  }
}

//------------------------------------------------------------------------------
void TracedField::FindTransmittance(
  RayPacket& packet, const Departure* departures, double* transmittance)
{
  std::fill_n(transmittance, packet.Count, 1.0);
  const TraceRequest& request = this->GetRequest();
  if (request.Projection)
  {
    return; // There are no surfaces.
  }
  // A ray that starts on a surface may meet it right there, by rounding. The side that it leaves to
  // decides: a first crossing to the side that the ray is on already does not count. (Farther away
  // it does: on the way there, another may not have been visible, or in no cell.) Where the surface
  // is opaque, the ray is continued from there.
  const double cell = this->GetCellSize();
  const double nearStart = StoppedRays::NearStart * cell;
  double step = 1e-13 * cell;
  RayHits found;
  for (int attempt = 0; attempt < 8 && !IsEmpty(packet.Exists); ++attempt, step *= 16.0)
  {
    this->Trace(packet, found);
    RaySet again = {};
    for (int i = 0; i < packet.Count; ++i)
    {
      std::size_t first = found.First[static_cast<std::size_t>(i)];
      const std::size_t last = found.First[static_cast<std::size_t>(i) + 1];
      const double length = Length(packet.GetDirection(i));
      const bool isOwn = first < last &&
        departures[i].Is(found.Hits[first].Surface, found.Hits[first].Entering) &&
        found.Hits[first].T * length < nearStart;
      if (isOwn && request.GetOpacity(found.Hits[first]) >= 1.0)
      {
        packet.Begin[i] = found.Hits[first].T - packet.Base[i] + step / length;
        if (packet.Begin[i] < packet.End[i])
        {
          Add(i, again);
        }
        continue;
      }
      for (first += isOwn ? 1 : 0; first < last; ++first)
      {
        transmittance[i] *= 1.0 - request.GetOpacity(found.Hits[first]);
      }
    }
    packet.Exists = again;
  }
}

}
