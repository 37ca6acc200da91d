// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/SecondaryRays.h"

#include "Math/Matrix.h"
#include "Picture/Hemisphere.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// One of 96 numbers, the same for directions that are much the same: a part of a face of a cube.
int GetSector(const Vector3& direction)
{
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other)
  {
    axis = std::abs(direction[other]) > std::abs(direction[axis]) ? other : axis;
  }
  const double length = std::abs(direction[axis]);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return 0; // no ray
  }
  const auto part = [&direction, length](std::size_t other)
  { return std::min(3, static_cast<int>(2.0 * (direction[other] / length + 1.0))); };
  const int face = 2 * static_cast<int>(axis) + (direction[axis] > 0.0 ? 1 : 0);
  return 16 * face + 4 * part((axis + 1) % 3) + part((axis + 2) % 3);
}

}

//------------------------------------------------------------------------------
SecondaryRays::SecondaryRays(const Scene& scene, std::size_t field)
  : TheScene(scene)
  , Field(*scene.Fields[field].Field)
  , WorldFromObject(scene.Fields[field].View.GetWorldFromObject())
  , WorldFromGradient(NormalMatrix(this->WorldFromObject))
{
  for (std::size_t other = 0; other < scene.Fields.size(); ++other)
  {
    if (other != field)
    {
      this->Others.push_back({ scene.Fields[other].Field,
        Multiply(
          InvertAffine(scene.Fields[other].View.GetWorldFromObject()), this->WorldFromObject) });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<double> SecondaryRays::FindLightTransmittance(const std::vector<Hit>& hits) const
{
  const std::size_t lights = this->TheScene.Lights.size();
  std::vector<double> transmittance(hits.size() * lights, 1.0);
  for (std::size_t first = 0; first < hits.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, hits.size() - first);
    for (std::size_t light = 0; light < lights; ++light)
    {
      OutgoingRay rays[RayPacket::Capacity];
      for (std::size_t i = 0; i < count; ++i)
      {
        rays[i] = this->MakeLightRay(this->TheScene.Lights[light], hits[first + i]);
      }
      double some[RayPacket::Capacity];
      this->FindTransmittance(rays, &hits[first], static_cast<int>(count), some);
      for (std::size_t i = 0; i < count; ++i)
      {
        transmittance[(first + i) * lights + light] = some[i];
      }
    }
  }
  return transmittance;
}

//------------------------------------------------------------------------------
std::vector<double> SecondaryRays::FindAmbientTransmittance(const std::vector<Hit>& hits) const
{
  const int count = this->TheScene.OcclusionRays;
  std::vector<Hemisphere> hemispheres;
  for (const Hit& hit : hits)
  {
    // The exact normal: about another one, rays would go into the surface that they leave.
    const Vector3 gradient = this->Field.GetGradient(hit, NormalMode::InterpolantGradient);
    const Vector3 normal =
      Normalized(TransformDirection(this->WorldFromGradient, Normalized(gradient)));
    hemispheres.emplace_back(hit.Entering ? normal * -1.0 : normal, count,
      HitNumbers(this->Field.GetPointInCells(hit), this->TheScene.OcclusionFrame));
  }
  // Some rays of all hits at a time, so that among them are many that go the same way.
  constexpr int atOnce = 32;
  std::vector<double> ambient(hits.size());
  std::vector<Hit> starts;
  std::vector<OutgoingRay> rays;
  std::vector<double> transmittance;
  for (int first = 0; first < count; first += atOnce)
  {
    starts.clear();
    rays.clear();
    const int some = std::min(atOnce, count - first);
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      for (int number = 0; number < some; ++number)
      {
        starts.push_back(hits[i]);
        rays.push_back(this->MakeOcclusionRay(hemispheres[i].Next(), hits[i]));
      }
    }
    this->FindTransmittanceSorted(rays, starts, transmittance);
    for (std::size_t i = 0; i < transmittance.size(); ++i)
    {
      ambient[i / static_cast<std::size_t>(some)] += transmittance[i] / count;
    }
  }
  return ambient;
}

//------------------------------------------------------------------------------
SecondaryRays::OutgoingRay SecondaryRays::MakeLightRay(const Light& light, const Hit& hit) const
{
  const Vector3 origin = this->Field.GetPoint(hit);
  const Vector3 toLight = light.Positional
    ? light.Position - TransformPoint(this->WorldFromObject, origin)
    : light.Direction;
  // The gradient's matrix is the inverse of the transposed, up to a factor.
  const Vector3 direction = TransposeTransformDirection(this->WorldFromGradient, toLight);
  const double end = light.Positional
    ? Length(toLight) / Length(TransformDirection(this->WorldFromObject, direction))
    : std::numeric_limits<double>::infinity();
  return { origin, direction, end };
}

//------------------------------------------------------------------------------
/// In a direction of length one in the world.
SecondaryRays::OutgoingRay SecondaryRays::MakeOcclusionRay(
  const Vector3& direction, const Hit& hit) const
{
  const Vector3 inObject = TransposeTransformDirection(this->WorldFromGradient, direction);
  const double unit = Length(TransformDirection(this->WorldFromObject, inObject));
  return { this->Field.GetPoint(hit), inObject, this->TheScene.OcclusionRadius / unit };
}

//------------------------------------------------------------------------------
/// For any number of rays, of which those that go about the same way are traced together. What is
/// found does not depend on that.
void SecondaryRays::FindTransmittanceSorted(const std::vector<OutgoingRay>& rays,
  const std::vector<Hit>& starts, std::vector<double>& transmittance) const
{
  std::vector<std::pair<int, std::size_t>> order(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    order[i] = { GetSector(rays[i].Direction), i };
  }
  std::sort(order.begin(), order.end());
  transmittance.resize(rays.size());
  for (std::size_t first = 0; first < order.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, order.size() - first);
    OutgoingRay someRays[RayPacket::Capacity];
    Hit someStarts[RayPacket::Capacity];
    double some[RayPacket::Capacity];
    for (std::size_t i = 0; i < count; ++i)
    {
      someRays[i] = rays[order[first + i].second];
      someStarts[i] = starts[order[first + i].second];
    }
    this->FindTransmittance(someRays, someStarts, static_cast<int>(count), some);
    for (std::size_t i = 0; i < count; ++i)
    {
      transmittance[order[first + i].second] = some[i];
    }
  }
}

//------------------------------------------------------------------------------
/// For up to a packet of rays, one from each hit.
void SecondaryRays::FindTransmittance(
  const OutgoingRay* rays, const Hit* starts, int count, double* transmittance) const
{
  RayPacket packet;
  packet.Count = 0;
  packet.Exists = {};
  Departure departures[RayPacket::Capacity];
  for (int i = 0; i < count; ++i)
  {
    const Vector3 gradient = this->Field.GetGradient(starts[i], NormalMode::InterpolantGradient);
    departures[i] = { starts[i].Surface, Dot(gradient, rays[i].Direction) > 0.0 };
    this->Field.AddRay(rays[i].Origin, rays[i].Direction, 0.0, rays[i].End, packet);
  }
  this->Field.FindTransmittance(packet, departures, transmittance);
  this->FindTransmittanceOfOthers(rays, count, transmittance);
}

//------------------------------------------------------------------------------
/// Multiplies by what the other fields of the scene let through.
void SecondaryRays::FindTransmittanceOfOthers(
  const OutgoingRay* rays, int count, double* transmittance) const
{
  const Departure none[RayPacket::Capacity] = {};
  for (const OtherField& other : this->Others)
  {
    RayPacket packet;
    packet.Count = 0;
    packet.Exists = {};
    for (int i = 0; i < count; ++i)
    {
      other.Field->AddRay(TransformPoint(other.OtherFromOwn, rays[i].Origin),
        TransformDirection(other.OtherFromOwn, rays[i].Direction), 0.0, rays[i].End, packet);
    }
    double some[RayPacket::Capacity];
    other.Field->FindTransmittance(packet, none, some);
    for (int i = 0; i < count; ++i)
    {
      transmittance[i] *= some[i];
    }
  }
}

}
