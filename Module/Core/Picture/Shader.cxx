// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/Shader.h"

#include "Picture/Hemisphere.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double RadiansPerDegree = 3.14159265358979323846 / 180.0;

struct Illumination
{
  /// From the surface to the light, of length one.
  Vector3 Direction;
  double Strength;
};

Illumination Illuminate(const Light& light, const Vector3& point)
{
  if (!light.Positional)
  {
    return { light.Direction, 1.0 };
  }
  const Vector3 toLight = light.Position - point;
  const double distance = Length(toLight);
  const Vector3 direction = Normalized(toLight);
  double strength = 1.0 /
    (light.Attenuation[0] + distance * (light.Attenuation[1] + distance * light.Attenuation[2]));
  if (light.ConeAngle < 90.0)
  {
    const double cosine = Dot(direction, light.Direction);
    strength *= cosine >= std::cos(light.ConeAngle * RadiansPerDegree)
      ? std::pow(cosine, light.Exponent)
      : 0.0;
  }
  return { direction, strength };
}

Vector3 Product(const Vector3& a, const Vector3& b)
{
  return { a[0] * b[0], a[1] * b[1], a[2] * b[2] };
}

/// One of 96 numbers, the same for directions that are much the same: a part of a face of a cube.
int GetWay(const Vector3& direction)
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

Vector3 Cross(const Vector3& a, const Vector3& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

}

//------------------------------------------------------------------------------
Matrix4 GradientMatrix(const Matrix4& m)
{
  // The inverse transposed is the matrix of cofactors over the determinant; its rows are cross
  // products. Columns are scaled to one first, so that no spacing overflows.
  Vector3 axes[3];
  double lengths[3];
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vector3 column = { m[i], m[4 + i], m[8 + i] };
    lengths[i] = Length(column);
    axes[i] = Normalized(column);
  }
  const Vector3 cofactors[3] = { Cross(axes[1], axes[2]), Cross(axes[2], axes[0]),
    Cross(axes[0], axes[1]) };
  const double sign = std::copysign(1.0, Dot(axes[0], cofactors[0]));
  const double shortest = std::min(std::min(lengths[0], lengths[1]), lengths[2]);
  Matrix4 result = {};
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t row = 0; row < 3; ++row)
    {
      result[4 * row + i] = cofactors[i][row] * (sign * (shortest / lengths[i]));
    }
  }
  return result;
}

//------------------------------------------------------------------------------
Vector3 GradientToWorld(const Matrix4& worldFromIndex, const Vector3& gradient)
{
  return TransformDirection(GradientMatrix(worldFromIndex), gradient);
}

//------------------------------------------------------------------------------
Shader::Shader(const Scene& scene, ImageField& volume)
  : TheScene(scene)
  , Volume(volume)
  , WorldFromGradient(GradientMatrix(scene.View.GetWorldFromIndex()))
{
  const double power = scene.Look.SpecularPower;
  const bool isWhole = power >= 0.0 && power <= 128.0 && power == std::floor(power);
  this->WholePower = isWhole ? static_cast<int>(power) : -1;
  for (const Light& light : scene.Lights)
  {
    if (!light.Positional)
    {
      DistantLight distant;
      std::copy(light.Direction.begin(), light.Direction.end(), distant.Direction);
      std::copy(light.DiffuseColor.begin(), light.DiffuseColor.end(), distant.DiffuseColor);
      std::copy(light.SpecularColor.begin(), light.SpecularColor.end(), distant.SpecularColor);
      this->DistantLights.push_back(distant);
    }
  }
}

//------------------------------------------------------------------------------
bool Shader::CanUseKernels() const
{
  const Scene& scene = this->TheScene;
  return scene.Request.BeamKernels && scene.Look.Shade && !scene.Shadows &&
    scene.OcclusionRays == 0 && this->WholePower >= 0 &&
    this->DistantLights.size() == scene.Lights.size();
}

//------------------------------------------------------------------------------
Vector3 Shader::GetColor(const Hit& hit) const
{
  if (this->TheScene.ColorsOfHits)
  {
    return this->TheScene.ColorsOfHits->Get(hit);
  }
  if (hit.Plane != Hit::NoPlane)
  {
    const std::array<double, 4> color = this->TheScene.ColorsOfValues->Get(hit.Value);
    return { color[0], color[1], color[2] };
  }
  return this->TheScene.Colors[static_cast<std::size_t>(hit.Surface)];
}

//------------------------------------------------------------------------------
void Shader::Shade(const RayPacket& rays, const RayHits& hits, std::vector<Vector3>& colors) const
{
  colors.resize(hits.Hits.size());
  const bool canUseKernels = this->CanUseKernels();
  const std::size_t lights = this->TheScene.Lights.size();
  std::vector<double> shares;
  if (this->TheScene.Shadows && this->TheScene.Look.Shade)
  {
    shares = this->CastShadows(hits.Hits);
  }
  std::vector<double> openness;
  if (this->TheScene.OcclusionRays > 0 && this->TheScene.Look.Shade)
  {
    openness = this->FindOpenness(hits.Hits);
  }
  ShadedHits some;
  some.Count = 0;
  some.Entering = {};
  std::size_t first = 0;
  const auto takeColors = [&some, &colors, &first]
  {
    for (int i = 0; i < some.Count; ++i)
    {
      colors[first++] = { some.Color[0][i], some.Color[1][i], some.Color[2][i] };
    }
    some.Count = 0;
    some.Entering = {};
  };
  for (int ray = 0; ray < rays.Count; ++ray)
  {
    const auto number = static_cast<std::size_t>(ray);
    for (std::size_t i = hits.First[number]; i < hits.First[number + 1]; ++i)
    {
      const Hit& hit = hits.Hits[i];
      if (!canUseKernels)
      {
        colors[i] = this->Shade(hit,
          { rays.Direction[0][ray], rays.Direction[1][ray], rays.Direction[2][ray] },
          shares.empty() ? nullptr : &shares[i * lights], openness.empty() ? 1.0 : openness[i]);
        continue;
      }
      this->Append(hit, rays, ray, some);
      if (some.Count == RayPacket::Capacity)
      {
        this->ShadeSome(&hits.Hits[first], some);
        takeColors();
      }
    }
  }
  if (some.Count > 0)
  {
    this->ShadeSome(&hits.Hits[first], some);
    takeColors();
  }
}

//------------------------------------------------------------------------------
bool Shader::CanMakePixels() const
{
  const TraceRequest& want = this->TheScene.Request;
  return this->CanUseKernels() && !want.Planes && !want.Projection && want.Surfaces.size() == 1 &&
    want.Surfaces[0].Opacity >= 1.0;
}

//------------------------------------------------------------------------------
void Shader::MakePixels(const RayPacket& rays, const RayHits& hits, HitPixels& pixels) const
{
  ShadedHits shaded;
  shaded.Count = 0;
  shaded.Entering = {};
  alignas(64) double points[3][RayPacket::Capacity];
  const Hit* hit = hits.Hits.data();
  for (int ray = 0; ray < rays.Count; ++ray)
  {
    const auto number = static_cast<std::size_t>(ray);
    if (hits.First[number + 1] > hits.First[number])
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        points[k][shaded.Count] = hit->Cell[k] + hit->Parametric[k];
      }
      this->Append(*hit++, rays, ray, shaded);
    }
  }
  this->ShadeSome(hits.Hits.data(), shaded);
  this->TheScene.Request.BeamKernels->MakePixels(
    this->TheScene.View.GetClipFromIndex().data(), shaded, points, pixels);
}

//------------------------------------------------------------------------------
/// Appends a hit that is to be shaded.
void Shader::Append(const Hit& hit, const RayPacket& rays, int ray, ShadedHits& shaded) const
{
  const int place = shaded.Count++;
  if (hit.Entering)
  {
    Add(place, shaded.Entering);
  }
  const Vector3 color = this->GetColor(hit);
  for (std::size_t k = 0; k < 3; ++k)
  {
    shaded.Direction[k][place] = rays.Direction[k][ray];
    shaded.Color[k][place] = color[k];
  }
}

//------------------------------------------------------------------------------
/// Shades hits that were appended, in their order.
void Shader::ShadeSome(const Hit* hits, ShadedHits& shaded) const
{
  const Scene& scene = this->TheScene;
  const Kernels& kernels = *scene.Request.BeamKernels;
  this->Volume.GetGradients(hits, shaded.Count, scene.Normals, kernels, shaded.Gradient);
  const Phong phong = { scene.View.GetWorldFromIndex().data(), this->WorldFromGradient.data(),
    scene.TwoSidedLighting, scene.Look.Ambient, scene.Look.Diffuse, scene.Look.Specular,
    this->WholePower, static_cast<int>(this->DistantLights.size()), this->DistantLights.data() };
  kernels.Shade(phong, shaded);
  if (IsEmpty(shaded.Extreme))
  {
    return;
  }
  for (int i = 0; i < shaded.Count; ++i)
  {
    if (Has(shaded.Extreme, i))
    {
      const Vector3 color = this->Shade(
        hits[i], { shaded.Direction[0][i], shaded.Direction[1][i], shaded.Direction[2][i] });
      for (std::size_t k = 0; k < 3; ++k)
      {
        shaded.Color[k][i] = color[k];
      }
    }
  }
}

//------------------------------------------------------------------------------
/// How much of each light comes through to each hit: hit by hit, light by light.
std::vector<double> Shader::CastShadows(const std::vector<Hit>& hits) const
{
  const std::size_t lights = this->TheScene.Lights.size();
  std::vector<double> shares(hits.size() * lights, 1.0);
  for (std::size_t first = 0; first < hits.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, hits.size() - first);
    for (std::size_t light = 0; light < lights; ++light)
    {
      ShadowRay rays[RayPacket::Capacity];
      for (std::size_t i = 0; i < count; ++i)
      {
        rays[i] = this->MakeShadowRay(this->TheScene.Lights[light], hits[first + i]);
      }
      double some[RayPacket::Capacity];
      this->FindShares(rays, &hits[first], static_cast<int>(count), some);
      for (std::size_t i = 0; i < count; ++i)
      {
        shares[(first + i) * lights + light] = some[i];
      }
    }
  }
  return shares;
}

//------------------------------------------------------------------------------
std::vector<double> Shader::FindOpenness(const std::vector<Hit>& hits) const
{
  const int count = this->TheScene.OcclusionRays;
  std::vector<Hemisphere> skies;
  for (const Hit& hit : hits)
  {
    // The exact normal: about another one, rays would go into the surface that they leave.
    const Vector3 gradient = this->Volume.GetGradient(hit, NormalMode::InterpolantGradient);
    const Vector3 normal =
      Normalized(TransformDirection(this->WorldFromGradient, Normalized(gradient)));
    skies.emplace_back(
      hit.Entering ? normal * -1.0 : normal, count, HitNumbers(hit, this->TheScene.OcclusionFrame));
  }
  // Some rays of all hits at a time, so that among them are many that go the same way.
  constexpr int atOnce = 32;
  std::vector<double> openness(hits.size());
  std::vector<Hit> starts;
  std::vector<ShadowRay> rays;
  std::vector<double> shares;
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
        rays.push_back(this->MakeOcclusionRay(skies[i].Next(), hits[i]));
      }
    }
    this->FindSharesSorted(rays, starts, shares);
    for (std::size_t i = 0; i < shares.size(); ++i)
    {
      openness[i / static_cast<std::size_t>(some)] += shares[i] / count;
    }
  }
  return openness;
}

//------------------------------------------------------------------------------
/// How much comes through along any number of rays, of which those that go about the same way are
/// traced together. What is found does not depend on that.
void Shader::FindSharesSorted(const std::vector<ShadowRay>& rays, const std::vector<Hit>& starts,
  std::vector<double>& shares) const
{
  std::vector<std::pair<int, std::size_t>> order(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    order[i] = { GetWay(rays[i].Direction), i };
  }
  std::sort(order.begin(), order.end());
  shares.resize(rays.size());
  for (std::size_t first = 0; first < order.size(); first += RayPacket::Capacity)
  {
    const std::size_t count = std::min<std::size_t>(RayPacket::Capacity, order.size() - first);
    ShadowRay someRays[RayPacket::Capacity];
    Hit someStarts[RayPacket::Capacity];
    double someShares[RayPacket::Capacity];
    for (std::size_t i = 0; i < count; ++i)
    {
      someRays[i] = rays[order[first + i].second];
      someStarts[i] = starts[order[first + i].second];
    }
    this->FindShares(someRays, someStarts, static_cast<int>(count), someShares);
    for (std::size_t i = 0; i < count; ++i)
    {
      shares[order[first + i].second] = someShares[i];
    }
  }
}

//------------------------------------------------------------------------------
/// How much comes through to hits along rays, one for each.
void Shader::FindShares(
  const ShadowRay* shadowRays, const Hit* hits, int count, double* shares) const
{
  RayPacket rays;
  rays.Count = 0;
  rays.Exists = {};
  bool goesInside[RayPacket::Capacity];
  for (int i = 0; i < count; ++i)
  {
    shares[i] = 1.0;
    const ShadowRay& ray = shadowRays[i];
    const Vector3 gradient = this->Volume.GetGradient(hits[i], NormalMode::InterpolantGradient);
    goesInside[i] = Dot(gradient, ray.Direction) > 0.0;
    AddRay(ClipToVolume(ray.Origin, ray.Direction, 0.0, ray.End, this->Volume.GetDimensions(),
             this->TheScene.Request.Planes),
      rays);
  }
  // A ray that starts on a surface may meet it right there, by rounding. The side that it leaves to
  // tells: a first crossing to the side that the ray is on already is none. Where the surface is
  // opaque, the ray is sent on from there.
  double step = 1e-13;
  RayHits found;
  for (int attempt = 0; attempt < 8 && !IsEmpty(rays.Exists); ++attempt, step *= 16.0)
  {
    this->Volume.Trace(rays, found);
    RaySet again = {};
    for (int i = 0; i < count; ++i)
    {
      std::size_t first = found.First[static_cast<std::size_t>(i)];
      const std::size_t last = found.First[static_cast<std::size_t>(i) + 1];
      const bool isOwn = first < last && found.Hits[first].Surface == hits[i].Surface &&
        found.Hits[first].Entering == goesInside[i];
      if (isOwn && this->GetOpacity(found.Hits[first]) >= 1.0)
      {
        const Ray ray = GetRay(rays, i);
        rays.Begin[i] = found.Hits[first].T - ray.Base + step / Length(ray.Direction);
        if (rays.Begin[i] < rays.End[i])
        {
          Add(i, again);
        }
        continue;
      }
      for (first += isOwn ? 1 : 0; first < last; ++first)
      {
        shares[i] *= 1.0 - this->GetOpacity(found.Hits[first]);
      }
    }
    rays.Exists = again;
  }
}

//------------------------------------------------------------------------------
/// From a hit to a light, in index space.
Shader::ShadowRay Shader::MakeShadowRay(const Light& light, const Hit& hit) const
{
  const Matrix4& toWorld = this->TheScene.View.GetWorldFromIndex();
  const Vector3 origin = hit.GetPoint(this->TheScene.Request.Planes);
  const Vector3 toLight =
    light.Positional ? light.Position - TransformPoint(toWorld, origin) : light.Direction;
  // The gradient's matrix is the inverse of the transposed, up to a factor.
  const Vector3 direction = TransposeTransformDirection(this->WorldFromGradient, toLight);
  const double end = light.Positional
    ? Length(toLight) / Length(TransformDirection(toWorld, direction))
    : std::numeric_limits<double>::infinity();
  return { origin, direction, end };
}

//------------------------------------------------------------------------------
/// From a hit in a direction of length one in the world, in index space.
Shader::ShadowRay Shader::MakeOcclusionRay(const Vector3& direction, const Hit& hit) const
{
  const Vector3 inIndex = TransposeTransformDirection(this->WorldFromGradient, direction);
  const double unit = Length(TransformDirection(this->TheScene.View.GetWorldFromIndex(), inIndex));
  return { hit.GetPoint(this->TheScene.Request.Planes), inIndex,
    this->TheScene.OcclusionRadius / unit };
}

//------------------------------------------------------------------------------
double Shader::GetOpacity(const Hit& hit) const
{
  return this->TheScene.Request.Surfaces[static_cast<std::size_t>(hit.Surface)].Opacity;
}

//------------------------------------------------------------------------------
double Shader::Highlight(double cosine) const
{
  if (this->WholePower < 0)
  {
    return std::pow(cosine, this->TheScene.Look.SpecularPower);
  }
  double result = 1.0;
  double square = cosine;
  for (int power = this->WholePower; power > 0; power /= 2)
  {
    result *= power % 2 == 1 ? square : 1.0;
    square *= square;
  }
  return result;
}

//------------------------------------------------------------------------------
Vector3 Shader::Shade(
  const Hit& hit, const Vector3& direction, const double* shares, double openness) const
{
  const Scene& scene = this->TheScene;
  const Vector3 color = this->GetColor(hit);
  const Material& look = scene.Look;
  if (!look.Shade)
  {
    return color;
  }
  const Matrix4& toWorld = scene.View.GetWorldFromIndex();
  const Vector3 toViewer = Normalized(TransformDirection(toWorld, direction)) * -1.0;
  // The outside of a surface is where values are smaller.
  const Vector3 gradient = this->Volume.GetGradient(hit, scene.Normals);
  Vector3 normal =
    Normalized(TransformDirection(this->WorldFromGradient, Normalized(gradient))) * -1.0;
  // Which side is seen, the hit knows; a smooth normal may be turned away from both.
  if (scene.TwoSidedLighting && !hit.Entering)
  {
    normal = normal * -1.0;
  }

  const Vector3 point = TransformPoint(toWorld, hit.GetPoint(scene.Request.Planes));
  Vector3 diffuse = { 0.0, 0.0, 0.0 };
  Vector3 specular = { 0.0, 0.0, 0.0 };
  for (std::size_t i = 0; i < scene.Lights.size(); ++i)
  {
    const Light& light = scene.Lights[i];
    Illumination illumination = Illuminate(light, point);
    const double cosine = Dot(normal, illumination.Direction);
    if (cosine <= 0.0)
    {
      continue;
    }
    illumination.Strength *= shares ? shares[i] : 1.0;
    diffuse = diffuse + light.DiffuseColor * (cosine * illumination.Strength);
    const Vector3 mirrored = normal * (2.0 * cosine) - illumination.Direction;
    const double highlight = this->Highlight(std::max(0.0, Dot(mirrored, toViewer)));
    specular = specular + light.SpecularColor * (highlight * illumination.Strength);
  }
  return color * (look.Ambient * openness) + Product(color, diffuse) * look.Diffuse +
    specular * look.Specular;
}

}
