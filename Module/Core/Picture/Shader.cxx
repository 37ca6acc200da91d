// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/Shader.h"

#include "Math/Matrix.h"
#include "Math/PhongReflection.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceRayTracing
{
namespace
{

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
    strength *= cosine >= light.FindLeastCosine() ? std::pow(cosine, light.Exponent) : 0.0;
  }
  return { direction, strength };
}

Vector3 Clamped(Vector3 color)
{
  for (double& channel : color)
  {
    channel = std::clamp(channel, 0.0, 1.0);
  }
  return color;
}

/// Calls visit(ray, i) for the hits of a packet, in order.
template <typename Visit>
void ForEachHit(const RayPacket& packet, const RayHits& hits, const Visit& visit)
{
  for (int ray = 0; ray < packet.Count; ++ray)
  {
    const auto number = static_cast<std::size_t>(ray);
    for (std::size_t i = hits.First[number]; i < hits.First[number + 1]; ++i)
    {
      visit(ray, i);
    }
  }
}

}

//------------------------------------------------------------------------------
Shader::Shader(const Scene& scene, std::size_t field, const Kernels* kernels)
  : TheScene(scene)
  , Own(scene.Fields[field])
  , Field(*scene.Fields[field].Field)
  , TheKernels(kernels)
  , Secondary(scene, field)
  , WorldFromGradient(NormalMatrix(scene.Fields[field].View.GetWorldFromObject()))
{
  const double power = this->Own.Surface.SpecularPower;
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
  return this->TheKernels && this->Own.Surface.Shade && this->WholePower >= 0 &&
    this->DistantLights.size() == this->TheScene.Lights.size();
}

//------------------------------------------------------------------------------
bool Shader::CanMakePixels() const
{
  const TraceRequest& request = this->Field.GetRequest();
  return this->CanUseKernels() && request.Surfaces.size() == 1 && request.HasOnlyOpaqueSurfaces();
}

//------------------------------------------------------------------------------
Vector3 Shader::GetColor(const Hit& hit) const
{
  if (this->Own.ColorsOfHits)
  {
    return this->Own.ColorsOfHits->Get(hit);
  }
  if (hit.Plane != Hit::NoPlane)
  {
    const std::array<double, 4> color = this->Own.ColorsOfValues->Get(hit.Value);
    return { color[0], color[1], color[2] };
  }
  return this->Own.Colors[static_cast<std::size_t>(hit.Surface)];
}

//------------------------------------------------------------------------------
void Shader::MakeFragments(const RayPacket& packet, const RayHits& hits, Fragments& fragments) const
{
  fragments.First = hits.First;
  fragments.List.resize(hits.Hits.size());
  if (this->Field.GetRequest().Projection)
  {
    std::transform(hits.Hits.begin(), hits.Hits.end(), fragments.List.begin(),
      [this](const Hit& hit) { return this->MakeFragmentOfValue(hit); });
    return;
  }
  ShadedHits shaded;
  shaded.Clear();
  alignas(64) double points[3][RayPacket::Capacity];
  std::size_t first = 0;
  ForEachHit(packet, hits,
    [&](int ray, std::size_t i)
    {
      this->Append(hits.Hits[i], packet, ray, shaded);
      if (shaded.Count < RayPacket::Capacity && i + 1 < hits.Hits.size())
      {
        return;
      }
      this->ShadeSome(&hits.Hits[first], points, shaded);
      for (int k = 0; k < shaded.Count; ++k, ++first)
      {
        fragments.List[first] = this->MakeFragment(hits.Hits[first], points, k, shaded);
      }
      shaded.Clear();
    });
}

//------------------------------------------------------------------------------
/// Makes that of one of the hits that were shaded.
Fragment Shader::MakeFragment(const Hit& hit, const double (*points)[RayPacket::Capacity], int i,
  const ShadedHits& shaded) const
{
  const Vector3 color = { shaded.Color[0][i], shaded.Color[1][i], shaded.Color[2][i] };
  const double opacity = this->Field.GetRequest().GetOpacity(hit);
  double depth = 0.0;
  if (opacity >= 1.0 || this->TheScene.KeepFragments)
  {
    depth = this->Own.View.GetDepth(this->CanUseKernels()
        ? Vector3{ points[0][i], points[1][i], points[2][i] }
        : this->Field.GetPoint(hit));
  }
  return { hit.T, Clamped(color) * opacity, opacity,
    static_cast<float>(std::clamp(depth, 0.0, 1.0)) };
}

//------------------------------------------------------------------------------
/// Of a projection, whose values may be opaque, but hide nothing in the depth buffer.
Fragment Shader::MakeFragmentOfValue(const Hit& hit) const
{
  const std::array<double, 4> color = this->Own.ColorsOfValues->Get(hit.Value);
  return { hit.T, Clamped({ color[0], color[1], color[2] }) * color[3], color[3],
    PixelWithoutDepth };
}

//------------------------------------------------------------------------------
void Shader::MakePixels(const RayPacket& packet, const RayHits& hits, HitPixels& pixels) const
{
  ShadedHits shaded;
  shaded.Clear();
  alignas(64) double points[3][RayPacket::Capacity];
  ForEachHit(
    packet, hits, [&](int ray, std::size_t i) { this->Append(hits.Hits[i], packet, ray, shaded); });
  this->ShadeSome(hits.Hits.data(), points, shaded);
  this->TheKernels->MakePixels(this->Own.View.GetClipFromObject().data(), shaded, points, pixels);
}

//------------------------------------------------------------------------------
/// Appends a hit that is to be shaded.
void Shader::Append(const Hit& hit, const RayPacket& packet, int ray, ShadedHits& shaded) const
{
  const int index = shaded.Count++;
  if (hit.Entering)
  {
    Add(index, shaded.Entering);
  }
  const Vector3 color = this->GetColor(hit);
  for (std::size_t k = 0; k < 3; ++k)
  {
    shaded.Direction[k][index] = packet.Direction[k][ray];
    shaded.Color[k][index] = color[k];
  }
}

//------------------------------------------------------------------------------
/// Shades hits that were appended, in their order. If it uses kernels it finds their points.
void Shader::ShadeSome(
  const Hit* hits, double (*points)[RayPacket::Capacity], ShadedHits& shaded) const
{
  const Scene& scene = this->TheScene;
  if (!this->Own.Surface.Shade)
  {
    return;
  }
  LightAtHits ambient;
  if (scene.OcclusionRays > 0)
  {
    this->Secondary.FindAmbient(hits, shaded.Count, ambient);
    shaded.Ambient = &ambient;
  }
  std::vector<LightAtHits> lights;
  if (scene.Shadows)
  {
    lights.resize(scene.Lights.size());
    this->Secondary.FindLights(hits, shaded.Count, lights.data());
    shaded.Lights = lights.data();
  }
  if (this->CanUseKernels())
  {
    this->ShadeByKernels(hits, points, shaded);
  }
  else
  {
    for (int i = 0; i < shaded.Count; ++i)
    {
      this->ShadeOne(hits[i], i, shaded);
    }
  }
  shaded.Ambient = nullptr;
  shaded.Lights = nullptr;
}

//------------------------------------------------------------------------------
void Shader::ShadeByKernels(
  const Hit* hits, double (*points)[RayPacket::Capacity], ShadedHits& shaded) const
{
  const Scene& scene = this->TheScene;
  const Material& surface = this->Own.Surface;
  this->Field.GetPointsAndGradients(
    hits, shaded.Count, this->Field.GetRequest().Normals, points, shaded.Gradient);
  const Phong phong = { this->Own.View.GetWorldFromObject().data(), this->WorldFromGradient.data(),
    scene.TwoSidedLighting, surface.Ambient, surface.Diffuse, surface.Specular, this->WholePower,
    static_cast<int>(this->DistantLights.size()), this->DistantLights.data() };
  this->TheKernels->Shade(phong, shaded);
  if (IsEmpty(shaded.Extreme))
  {
    return;
  }
  for (int i = 0; i < shaded.Count; ++i)
  {
    if (Has(shaded.Extreme, i))
    {
      this->ShadeOne(hits[i], i, shaded);
    }
  }
}

//------------------------------------------------------------------------------
/// Shades one of the hits that were appended.
void Shader::ShadeOne(const Hit& hit, int i, ShadedHits& shaded) const
{
  const IncomingLight light = { shaded.Ambient ? shaded.Ambient->Parts[i] : 1.0, shaded.Lights, i };
  const Vector3 color = this->Shade(
    hit, { shaded.Direction[0][i], shaded.Direction[1][i], shaded.Direction[2][i] }, light);
  for (std::size_t k = 0; k < 3; ++k)
  {
    shaded.Color[k][i] = color[k];
  }
}

//------------------------------------------------------------------------------
double Shader::Highlight(double cosine) const
{
  return this->WholePower < 0 ? std::pow(cosine, this->Own.Surface.SpecularPower)
                              : Power(cosine, this->WholePower);
}

//------------------------------------------------------------------------------
Vector3 Shader::Shade(const Hit& hit, const Vector3& direction, const IncomingLight& light) const
{
  const Scene& scene = this->TheScene;
  const Vector3 color = this->GetColor(hit);
  const Material& surface = this->Own.Surface;
  if (!surface.Shade)
  {
    return color;
  }
  const Matrix4& toWorld = this->Own.View.GetWorldFromObject();
  const Vector3 toViewer = Normalized(TransformDirection(toWorld, direction)) * -1.0;
  // The outside of a surface is where values are smaller.
  const Vector3 gradient = this->Field.GetGradient(hit, this->Field.GetRequest().Normals);
  Vector3 normal =
    Normalized(TransformDirection(this->WorldFromGradient, Normalized(gradient))) * -1.0;
  // The hit tells which side is visible; a smooth normal may be turned away from both.
  if (scene.TwoSidedLighting && !hit.Entering)
  {
    normal = normal * -1.0;
  }

  const Vector3 point = TransformPoint(toWorld, this->Field.GetPoint(hit));
  PhongReflection<double> reflection;
  for (std::size_t i = 0; i < scene.Lights.size(); ++i)
  {
    const Light& source = scene.Lights[i];
    const Illumination illumination = Illuminate(source, point);
    reflection.Add(normal.data(), toViewer.data(), illumination.Direction.data(),
      source.DiffuseColor.data(), source.SpecularColor.data(),
      illumination.Strength * (light.Lights ? light.Lights[i].Parts[light.Place] : 1.0),
      [this](double cosine) { return this->Highlight(cosine); });
  }
  Vector3 shaded;
  for (int i = 0; i < 3; ++i)
  {
    const auto k = static_cast<std::size_t>(i);
    shaded[k] = reflection.GetChannel(
      i, color[k], surface.Ambient * light.Ambient, surface.Diffuse, surface.Specular);
  }
  return shaded;
}

//------------------------------------------------------------------------------
std::vector<Shader> MakeShaders(const Scene& scene, const Kernels* kernels)
{
  std::vector<Shader> shaders;
  shaders.reserve(scene.Fields.size());
  for (std::size_t field = 0; field < scene.Fields.size(); ++field)
  {
    shaders.emplace_back(scene, field, kernels);
  }
  return shaders;
}

}
