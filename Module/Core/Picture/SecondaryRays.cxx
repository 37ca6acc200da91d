// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/SecondaryRays.h"

#include "Math/Matrix.h"
#include "Picture/Hemisphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Directions have a place on a face of a cube, which is divided into so many parts each way.
constexpr int SectorBits = 4;
constexpr int Sectors = 6 << (2 * SectorBits);

/// A number that is near for similar directions: the place on a face of a cube in Morton order, so
/// that halves of a sequence, and halves of them, have similar directions, too.
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
  const double scale = 1.0 / length;
  constexpr int parts = 1 << SectorBits;
  const auto part = [&direction, scale](std::size_t other)
  { return std::min(parts - 1, static_cast<int>(0.5 * parts * (direction[other] * scale + 1.0))); };
  const int u = part((axis + 1) % 3);
  const int v = part((axis + 2) % 3);
  int sector = 2 * static_cast<int>(axis) + (direction[axis] > 0.0 ? 1 : 0);
  for (int bit = SectorBits - 1; bit >= 0; --bit)
  {
    sector = 4 * sector + 2 * (u >> bit & 1) + (v >> bit & 1);
  }
  return sector;
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
          InvertAffine(scene.Fields[other].View.GetWorldFromObject()), this->WorldFromObject),
        StoppedRays::NearStart * scene.Fields[other].CellSize });
    }
  }
}

//------------------------------------------------------------------------------
void SecondaryRays::FindLights(const Hit* hits, int count, LightAtHits* lights) const
{
  Start starts[RayPacket::Capacity];
  this->FindStarts(hits, count, starts);
  for (std::size_t light = 0; light < this->TheScene.Lights.size(); ++light)
  {
    OutgoingRay rays[RayPacket::Capacity];
    for (int i = 0; i < count; ++i)
    {
      rays[i] = this->MakeLightRay(this->TheScene.Lights[light], starts[i]);
    }
    this->FindTransmittance(rays, count, lights[light].Parts);
  }
}

//------------------------------------------------------------------------------
void SecondaryRays::FindAmbient(const Hit* hits, int count, LightAtHits& ambient) const
{
  const int raysOfHit = this->TheScene.OcclusionRays;
  Start starts[RayPacket::Capacity];
  this->FindStarts(hits, count, starts);
  std::vector<Hemisphere> hemispheres;
  for (int i = 0; i < count; ++i)
  {
    const Vector3 normal =
      Normalized(TransformDirection(this->WorldFromGradient, Normalized(starts[i].Gradient)));
    hemispheres.emplace_back(hits[i].Entering ? normal * -1.0 : normal, raysOfHit,
      HitNumbers(this->Field.GetPointInCells(hits[i]), this->TheScene.OcclusionFrame));
  }
  // Rays of several hits at a time, so that many of them have similar directions.
  constexpr int atOnce = 32;
  std::fill_n(ambient.Parts, count, 0.0);
  std::vector<OutgoingRay> rays;
  std::vector<double> transmittance;
  for (int first = 0; first < raysOfHit; first += atOnce)
  {
    rays.clear();
    const int some = std::min(atOnce, raysOfHit - first);
    for (int i = 0; i < count; ++i)
    {
      for (int number = 0; number < some; ++number)
      {
        rays.push_back(
          this->MakeOcclusionRay(hemispheres[static_cast<std::size_t>(i)].Next(), starts[i]));
      }
    }
    this->FindTransmittanceOfAll(rays, transmittance);
    for (std::size_t i = 0; i < transmittance.size(); ++i)
    {
      ambient.Parts[i / static_cast<std::size_t>(some)] += transmittance[i] / raysOfHit;
    }
  }
}

//------------------------------------------------------------------------------
void SecondaryRays::FindStarts(const Hit* hits, int count, Start* starts) const
{
  alignas(64) double points[3][RayPacket::Capacity];
  alignas(64) double gradients[3][RayPacket::Capacity];
  // The exact normal: with another, rays might enter the surface that they leave.
  this->Field.GetPointsAndGradients(
    hits, count, NormalMode::InterpolantGradient, points, gradients);
  for (int i = 0; i < count; ++i)
  {
    starts[i] = { { points[0][i], points[1][i], points[2][i] },
      { gradients[0][i], gradients[1][i], gradients[2][i] }, hits[i].Surface, hits[i].Member,
      hits[i].Cell };
  }
}

//------------------------------------------------------------------------------
SecondaryRays::OutgoingRay SecondaryRays::MakeLightRay(const Light& light, const Start& start) const
{
  const Vector3 toLight = light.Positional
    ? light.Position - TransformPoint(this->WorldFromObject, start.Point)
    : light.Direction;
  // The matrix of gradients is the inverse transpose, up to a factor.
  const Vector3 direction = TransposeTransformDirection(this->WorldFromGradient, toLight);
  const double end = light.Positional
    ? Length(toLight) / Length(TransformDirection(this->WorldFromObject, direction))
    : std::numeric_limits<double>::infinity();
  return { &start, direction, end };
}

//------------------------------------------------------------------------------
/// In a direction of length one in the world.
SecondaryRays::OutgoingRay SecondaryRays::MakeOcclusionRay(
  const Vector3& direction, const Start& start) const
{
  const Vector3 inObject = TransposeTransformDirection(this->WorldFromGradient, direction);
  const double unit = Length(TransformDirection(this->WorldFromObject, inObject));
  return { &start, inObject, this->TheScene.OcclusionRadius / unit };
}

//------------------------------------------------------------------------------
/// For any number of rays. Those with similar directions are traced together, where that is faster;
/// it does not change the result.
void SecondaryRays::FindTransmittanceOfAll(
  const std::vector<OutgoingRay>& rays, std::vector<double>& transmittance) const
{
  std::vector<std::size_t> order(rays.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  if (this->Field.GainsFromDirections())
  {
    order = SortByDirection(rays);
  }
  transmittance.resize(rays.size());
  for (std::size_t first = 0; first < order.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, order.size() - first);
    OutgoingRay someRays[RayPacket::Capacity];
    double some[RayPacket::Capacity];
    for (std::size_t i = 0; i < count; ++i)
    {
      someRays[i] = rays[order[first + i]];
    }
    this->FindTransmittance(someRays, static_cast<int>(count), some);
    for (std::size_t i = 0; i < count; ++i)
    {
      transmittance[order[first + i]] = some[i];
    }
  }
}

//------------------------------------------------------------------------------
/// The numbers of rays, those with similar directions next to each other.
std::vector<std::size_t> SecondaryRays::SortByDirection(const std::vector<OutgoingRay>& rays)
{
  std::vector<std::uint16_t> sectors(rays.size());
  std::array<std::size_t, Sectors + 1> places = {};
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    sectors[i] = static_cast<std::uint16_t>(GetSector(rays[i].Direction));
    ++places[sectors[i] + 1U];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  std::vector<std::size_t> order(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    order[places[sectors[i]]++] = i;
  }
  return order;
}

//------------------------------------------------------------------------------
/// For up to a packet of rays.
void SecondaryRays::FindTransmittance(
  const OutgoingRay* rays, int count, double* transmittance) const
{
  RayPacket packet;
  packet.Clear();
  Departure departures[RayPacket::Capacity];
  for (int i = 0; i < count; ++i)
  {
    const Start& start = *rays[i].From;
    departures[i] = { start.Surface, Dot(start.Gradient, rays[i].Direction) > 0.0, start.Member,
      start.Cell };
    packet.Append(start.Point, rays[i].Direction, 0.0, rays[i].End);
  }
  this->Field.ClipRays(packet);
  this->Field.FindTransmittance(packet, departures, transmittance);
  this->FindTransmittanceOfOthers(rays, count, transmittance);
}

//------------------------------------------------------------------------------
/// Multiplies by the transmittance of the other fields of the scene, for the rays that are left.
void SecondaryRays::FindTransmittanceOfOthers(
  const OutgoingRay* rays, int count, double* transmittance) const
{
  const Departure none[RayPacket::Capacity] = {};
  for (const OtherField& other : this->Others)
  {
    RayPacket packet;
    packet.Clear();
    int numbers[RayPacket::Capacity];
    for (int i = 0; i < count; ++i)
    {
      if (transmittance[i] > 0.0)
      {
        numbers[packet.Count] = i;
        const Vector3 direction = TransformDirection(other.OtherFromOwn, rays[i].Direction);
        // Coinciding surfaces must not shadow each other.
        const double begin = other.NearStart / Length(direction);
        packet.Append(
          TransformPoint(other.OtherFromOwn, rays[i].From->Point), direction, begin, rays[i].End);
      }
    }
    other.Field->ClipRays(packet);
    double some[RayPacket::Capacity];
    other.Field->FindTransmittance(packet, none, some);
    for (int i = 0; i < packet.Count; ++i)
    {
      transmittance[numbers[i]] *= some[i];
    }
  }
}

}
