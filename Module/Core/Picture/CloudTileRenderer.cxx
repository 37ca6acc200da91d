// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudTileRenderer.h"

#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Math/ByteColor.h"
#include "Math/Matrix.h"
#include "Picture/CloudMedium.h"
#include "Picture/RenderTiles.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A ray ends where less of the light behind is seen.
constexpr double NegligibleLight = 0x1p-15;

/// How many segments are put in order at once.
constexpr std::size_t SegmentsAtOnce = 128 * CloudTile::Capacity;

CloudLight MakeCloudLight(const Light& light)
{
  CloudLight made{};
  std::copy(light.DiffuseColor.begin(), light.DiffuseColor.end(), made.DiffuseColor);
  std::copy(light.SpecularColor.begin(), light.SpecularColor.end(), made.SpecularColor);
  std::copy(light.Direction.begin(), light.Direction.end(), made.Direction);
  made.IsPositional = light.Positional;
  std::copy(light.Position.begin(), light.Position.end(), made.Position);
  std::copy(light.Attenuation.begin(), light.Attenuation.end(), made.Attenuation);
  made.HasCone = light.ConeAngle < 90.0;
  made.LeastCosine = light.FindLeastCosine();
  made.Exponent = light.Exponent;
  return made;
}

/// Puts elements in order by a key from 0 to count - 1. Those of a key are from first[key] to
/// first[key + 1], in the order that they had.
template <typename Element, typename Key>
void SortByKey(const std::vector<Element>& elements, std::size_t count, const Key& getKey,
  std::vector<std::uint32_t>& first, std::vector<Element>& sorted)
{
  first.assign(count + 2, 0);
  for (const Element& element : elements)
  {
    ++first[getKey(element) + 2];
  }
  for (std::size_t i = 2; i < first.size(); ++i)
  {
    first[i] += first[i - 1];
  }
  sorted.resize(elements.size());
  for (const Element& element : elements)
  {
    // In the end it is where those of the next key begin.
    sorted[first[getKey(element) + 1]++] = element;
  }
}

}

//------------------------------------------------------------------------------
/// The depths, the values and the gradients at both ends of a segment.
struct CloudTileRenderer::SegmentEnds
{
  SegmentEnds(const CloudSegments& segments, int number)
    : Components(segments.Components)
    , Coordinates(3 * segments.Gradients)
  {
    for (int end = 0; end < 2; ++end)
    {
      this->Depth[end] = segments.Depth[end][number];
      for (int i = 0; i < this->Components; ++i)
      {
        this->Value[i][end] = segments.Value[i][end][number];
      }
      for (int i = 0; i < this->Coordinates; ++i)
      {
        this->Gradient[i][end] = segments.Gradient[i][end][number];
      }
    }
  }

  /// Returns the part before a depth, and becomes the rest.
  SegmentEnds CutOff(double depth)
  {
    SegmentEnds before = *this;
    const double fraction = (depth - this->Depth[0]) / (this->Depth[1] - this->Depth[0]);
    for (int i = 0; i < this->Components; ++i)
    {
      const double there = Lerp(this->Value[i][0], this->Value[i][1], fraction);
      before.Value[i][1] = there;
      this->Value[i][0] = there;
    }
    for (int i = 0; i < this->Coordinates; ++i)
    {
      const float there =
        Lerp(this->Gradient[i][0], this->Gradient[i][1], static_cast<float>(fraction));
      before.Gradient[i][1] = there;
      this->Gradient[i][0] = there;
    }
    before.Depth[1] = depth;
    this->Depth[0] = depth;
    return before;
  }

  void Write(CloudSegments& segments, int number) const
  {
    for (int end = 0; end < 2; ++end)
    {
      segments.Depth[end][number] = this->Depth[end];
      for (int i = 0; i < this->Components; ++i)
      {
        segments.Value[i][end][number] = this->Value[i][end];
      }
      for (int i = 0; i < this->Coordinates; ++i)
      {
        segments.Gradient[i][end][number] = this->Gradient[i][end];
      }
    }
  }

  int Components;
  /// Of all gradients.
  int Coordinates;
  double Depth[2];
  double Value[MaximumCloudComponents][2];
  float Gradient[3 * MaximumCloudComponents][2];
};

//------------------------------------------------------------------------------
CloudTileRenderer::CloudTileRenderer(const Scene& scene, const Kernels* kernels)
  : TheScene(scene)
  , TheKernels(kernels ? *kernels : BaselineKernels)
  , Rays(new RayLight[CloudTile::Capacity])
  , Segments(new CloudSegments)
  , Parts(new CloudSegments)
{
  const bool isLit = std::any_of(scene.Fields.begin(), scene.Fields.end(),
    [](const SceneField& field)
    { return field.Cloud && !field.IsMaximum && field.Cloud->GetMixed().Gradients > 0; });
  if (isLit)
  {
    std::transform(
      scene.Lights.begin(), scene.Lights.end(), std::back_inserter(this->Lamps), MakeCloudLight);
    this->Lighting = std::make_unique<CloudLighting>();
    this->Lighting->LightCount = static_cast<int>(this->Lamps.size());
    this->Lighting->Lights = this->Lamps.data();
    this->Lighting->AreTwoSided = scene.TwoSidedLighting;
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Begin(const PixelRectangle& tile)
{
  this->Tile = tile;
  this->Surfaces.clear();
  this->Pending.clear();
  this->Lights.clear();
  MakeCloudRays(this->TheScene, tile, this->TheKernels, this->RaysOfTile, this->Lighting.get());
  for (int row = 0; row < CloudTile::Edge; ++row)
  {
    this->Open[row] = row < tile.Height ? (1U << tile.Width) - 1U : 0U;
  }
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    this->Rays[static_cast<std::size_t>(pixel)] = { {}, 1.0, PixelWithoutDepth, -Infinity, nullptr,
      0, 0 };
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::SetFragments(int x, int y, const Fragment* fragments, std::size_t count)
{
  const int pixel = y * CloudTile::Edge + x;
  RayLight& ray = this->Rays[static_cast<std::size_t>(pixel)];
  ray.Fragment = this->Surfaces.size();
  this->Surfaces.insert(this->Surfaces.end(), fragments, fragments + count);
  ray.End = this->Surfaces.size();
  CutCloudRay(fragments, count, pixel, this->RaysOfTile);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Render(CloudFinder& finder, Frame& frame)
{
  finder.Begin(this->Tile, this->RaysOfTile, 0.0);
  std::size_t enough = SegmentsAtOnce;
  while (this->IsAnyOpen() && finder.GetNextDepth() < Infinity)
  {
    const std::size_t field = finder.FindMore(this->Open, *this->Segments);
    this->Add(field, *this->Segments);
    if (this->Pending.size() >= enough)
    {
      this->DrawBefore(finder.GetNextDepth());
      // Those that are left are sorted again.
      enough = std::max(SegmentsAtOnce, 2 * this->Pending.size());
    }
  }
  this->Finish(frame);
}

//------------------------------------------------------------------------------
bool CloudTileRenderer::IsAnyOpen() const
{
  return std::any_of(
    std::begin(this->Open), std::end(this->Open), [](std::uint32_t row) { return row != 0; });
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Finish(Frame& frame)
{
  this->DrawBefore(Infinity);
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    this->DrawMaximum(this->Rays[static_cast<std::size_t>(pixel)]);
    this->DrawFragments(pixel, Infinity);
  }
  this->Write(frame);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Add(std::size_t number, const CloudSegments& segments)
{
  const SceneField& field = this->TheScene.Fields[number];
  if (field.IsMaximum)
  {
    this->FindMaxima(field, segments);
  }
  else if (this->Surfaces.empty())
  {
    this->Integrate(field, segments);
  }
  else
  {
    this->IntegrateParts(field, segments);
  }
}

//------------------------------------------------------------------------------
/// Of equal values, that of the first field counts.
void CloudTileRenderer::FindMaxima(const SceneField& field, const CloudSegments& segments)
{
  for (int i = 0; i < segments.Count; ++i)
  {
    RayLight& ray = this->Rays[static_cast<std::size_t>(segments.Pixel[i])];
    const double largest = std::max(segments.Value[0][0][i], segments.Value[0][1][i]);
    if (largest > ray.Maximum || (largest == ray.Maximum && &field < ray.MaximumOf))
    {
      ray.Maximum = largest;
      ray.MaximumOf = &field;
    }
  }
}

//------------------------------------------------------------------------------
/// Draws the largest value before all else.
void CloudTileRenderer::DrawMaximum(RayLight& ray) const
{
  if (ray.MaximumOf)
  {
    const std::array<double, 4> rgba = ray.MaximumOf->ColorsOfValues->Get(ray.Maximum);
    for (std::size_t k = 0; k < 3; ++k)
    {
      ray.Color[k] = rgba[k] * rgba[3];
    }
    ray.Transmittance = 1.0 - rgba[3];
  }
}

//------------------------------------------------------------------------------
/// Integrates the segments in parts, between the fragments that are in them.
void CloudTileRenderer::IntegrateParts(const SceneField& field, const CloudSegments& whole)
{
  CloudSegments& parts = *this->Parts;
  parts.Count = 0;
  parts.Components = whole.Components;
  parts.Gradients = whole.Gradients;
  for (int i = 0; i < whole.Count; ++i)
  {
    const int pixel = whole.Pixel[i];
    const RayLight& ray = this->Rays[static_cast<std::size_t>(pixel)];
    SegmentEnds ends(whole, i);
    for (std::size_t k = ray.Fragment; k < ray.End; ++k)
    {
      const double at = this->GetDepth(this->Surfaces[k], pixel);
      if (ends.Depth[0] < at && at < ends.Depth[1])
      {
        this->AddPart(field, pixel, ends.CutOff(at));
      }
    }
    this->AddPart(field, pixel, ends);
  }
  this->Integrate(field, parts);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::AddPart(const SceneField& field, int pixel, const SegmentEnds& ends)
{
  CloudSegments& parts = *this->Parts;
  if (parts.Count == CloudSegments::Batch)
  {
    this->Integrate(field, parts);
    parts.Count = 0;
  }
  parts.Pixel[parts.Count] = pixel;
  ends.Write(parts, parts.Count);
  ++parts.Count;
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Integrate(const SceneField& field, const CloudSegments& segments)
{
  const std::size_t before = this->Pending.size();
  const auto count = static_cast<std::size_t>(segments.Count);
  this->Pending.resize(before + count);
  this->Lights.resize(before + count);
  const MixedTransfers& mixed = field.Cloud->GetMixed();
  SegmentLight* lights = this->Lights.data() + before;
  if (segments.Gradients > 0)
  {
    const Matrix4 toWorld = NormalMatrix(field.View.GetWorldFromObject());
    std::copy(toWorld.begin(), toWorld.end(), this->Lighting->WorldFromGradient);
    this->TheKernels.IntegrateLitMixture(
      this->RaysOfTile, mixed, *this->Lighting, segments, lights);
  }
  else if (mixed.Components == 1)
  {
    this->TheKernels.IntegrateSegments(this->RaysOfTile, *mixed.Transfers[0], segments, lights);
  }
  else
  {
    this->TheKernels.IntegrateMixture(this->RaysOfTile, mixed, segments, lights);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Pending[before + i] = { segments.Depth[0][i], segments.Pixel[i],
      static_cast<std::uint32_t>(before + i) };
  }
}

//------------------------------------------------------------------------------
/// Draws the segments that begin before a depth: none that is found later comes before them.
void CloudTileRenderer::DrawBefore(double depth)
{
  this->SortByPixel();
  this->Pending.clear();
  this->LaterLights.clear();
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    PendingSegment* first = this->Sorted.data() + this->First[static_cast<std::size_t>(pixel)];
    PendingSegment* last = this->Sorted.data() + this->First[static_cast<std::size_t>(pixel) + 1];
    if (first == last || !this->IsOpen(pixel))
    {
      continue;
    }
    this->SortByDepth(first, last);
    const PendingSegment* later = first;
    while (later != last && later->Depth < depth)
    {
      ++later;
    }
    if (!this->DrawSegments(pixel, first, later))
    {
      this->Close(pixel);
      continue;
    }
    for (; later != last; ++later)
    {
      this->Pending.push_back(
        { later->Depth, pixel, static_cast<std::uint32_t>(this->LaterLights.size()) });
      this->LaterLights.push_back(this->Lights[later->Light]);
    }
  }
  this->Lights.swap(this->LaterLights);
}

//------------------------------------------------------------------------------
/// Puts the pending segments in order by pixel, and those of each nearly in order by depth: by
/// intervals of depth first.
void CloudTileRenderer::SortByPixel()
{
  constexpr int intervals = 512;
  double least = Infinity;
  double most = -Infinity;
  for (const PendingSegment& segment : this->Pending)
  {
    least = std::min(least, segment.Depth);
    most = std::max(most, segment.Depth);
  }
  const double scale = least < most ? (intervals - 0.5) / (most - least) : 0.0;
  SortByKey(
    this->Pending, intervals,
    [least, scale](const PendingSegment& segment)
    { return static_cast<std::size_t>((segment.Depth - least) * scale); },
    this->First, this->Sorted);
  this->Pending.swap(this->Sorted);
  SortByKey(
    this->Pending, CloudTile::Capacity,
    [](const PendingSegment& segment) { return static_cast<std::size_t>(segment.Pixel); },
    this->First, this->Sorted);
}

//------------------------------------------------------------------------------
/// Segments are nearly in order: each is moved to its place among those before it.
void CloudTileRenderer::SortByDepth(PendingSegment* first, PendingSegment* last) const
{
  for (PendingSegment* i = first + 1; i < last; ++i)
  {
    const PendingSegment moved = *i;
    PendingSegment* place = i;
    for (; place > first && this->IsBefore(moved, *(place - 1)); --place)
    {
      *place = *(place - 1);
    }
    *place = moved;
  }
}

//------------------------------------------------------------------------------
/// The order does not depend on which segment was found first: those that begin at one depth, in
/// cells that overlap, are in order by their light.
bool CloudTileRenderer::IsBefore(const PendingSegment& a, const PendingSegment& b) const
{
  if (a.Depth != b.Depth)
  {
    return a.Depth < b.Depth;
  }
  const SegmentLight& one = this->Lights[a.Light];
  const SegmentLight& other = this->Lights[b.Light];
  return std::tie(one.Transmittance, one.Color[0], one.Color[1], one.Color[2]) <
    std::tie(other.Transmittance, other.Color[0], other.Color[1], other.Color[2]);
}

//------------------------------------------------------------------------------
/// Draws segments of a ray, and the fragments before them. Returns false if nothing more is seen.
bool CloudTileRenderer::DrawSegments(
  int pixel, const PendingSegment* first, const PendingSegment* last)
{
  RayLight& ray = this->Rays[static_cast<std::size_t>(pixel)];
  for (const PendingSegment* segment = first; segment != last; ++segment)
  {
    if (ray.Fragment < ray.End)
    {
      this->DrawFragments(pixel, segment->Depth);
    }
    const SegmentLight& light = this->Lights[segment->Light];
    for (int k = 0; k < 3; ++k)
    {
      ray.Color[k] += ray.Transmittance * static_cast<double>(light.Color[k]);
    }
    ray.Transmittance *= static_cast<double>(light.Transmittance);
    if (ray.Transmittance < NegligibleLight)
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/// Draws the fragments of a ray up to a depth.
void CloudTileRenderer::DrawFragments(int pixel, double depth)
{
  RayLight& ray = this->Rays[static_cast<std::size_t>(pixel)];
  for (; ray.Fragment < ray.End; ++ray.Fragment)
  {
    const Fragment& fragment = this->Surfaces[ray.Fragment];
    if (ray.Transmittance < NegligibleLight ||
      (depth < Infinity && depth < this->GetDepth(fragment, pixel)))
    {
      return;
    }
    for (std::size_t k = 0; k < 3; ++k)
    {
      ray.Color[k] += ray.Transmittance * fragment.Color[k];
    }
    ray.Transmittance *= 1.0 - fragment.Opacity;
    ray.Depth = fragment.Opacity >= 1.0 ? fragment.Depth : ray.Depth;
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Close(int pixel)
{
  this->Open[pixel / CloudTile::Edge] &= ~(1U << (pixel % CloudTile::Edge));
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Write(Frame& frame) const
{
  for (int y = 0; y < this->Tile.Height; ++y)
  {
    for (int x = 0; x < this->Tile.Width; ++x)
    {
      const RayLight& ray = this->Rays[static_cast<std::size_t>(y * CloudTile::Edge + x)];
      const std::size_t pixel = static_cast<std::size_t>(this->Tile.X + x) +
        static_cast<std::size_t>(this->Tile.Y + y) *
          static_cast<std::size_t>(this->TheScene.Pixels.Width);
      for (std::size_t k = 0; k < 3; ++k)
      {
        frame.Colors[4 * pixel + k] = ToByte(ray.Color[k]);
      }
      frame.Colors[4 * pixel + 3] = ToByte(1.0 - ray.Transmittance);
      frame.Depths[pixel] = ray.Depth;
    }
  }
}

}
