// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudTileRenderer.h"

#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Math/ByteColor.h"
#include "Math/Matrix.h"
#include "Picture/CloudTransfer.h"
#include "Picture/RenderTiles.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// A ray ends where less of the light behind is seen.
constexpr double NegligibleLight = 0x1p-15;

/// How many segments are put in order at once.
constexpr std::size_t SegmentsAtOnce = 128 * CloudTile::Capacity;

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
CloudTileRenderer::CloudTileRenderer(const Scene& scene, const Kernels* kernels)
  : TheScene(scene)
  , TheKernels(kernels ? *kernels : BaselineKernels)
  , Rays(new RayLight[CloudTile::Capacity])
  , Segments(new CloudSegments)
  , Parts(new CloudSegments)
{
  std::vector<ViewedCloud> found;
  for (const SceneField& field : scene.Fields)
  {
    if (field.Cloud)
    {
      field.Field->AddClouds(field.View, kernels, found);
      for (ViewedCloud& cloud : found)
      {
        this->Clouds.push_back({ std::move(cloud), &field });
      }
      found.clear();
    }
  }
}

//------------------------------------------------------------------------------
bool CloudTileRenderer::IsNeeded(const Scene& scene)
{
  return std::any_of(scene.Fields.begin(), scene.Fields.end(),
    [](const SceneField& field) { return field.Cloud != nullptr; });
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Begin(const PixelRectangle& tile)
{
  this->Tile = tile;
  this->Surfaces.clear();
  this->Pending.clear();
  this->Lights.clear();
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    this->Rays[static_cast<std::size_t>(pixel)] = { {}, 1.0, PixelWithoutDepth, -Infinity, nullptr,
      0, 0 };
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::SetFragments(int x, int y, const Fragment* fragments, std::size_t count)
{
  RayLight& ray = this->Rays[static_cast<std::size_t>(y * CloudTile::Edge + x)];
  ray.Fragment = this->Surfaces.size();
  this->Surfaces.insert(this->Surfaces.end(), fragments, fragments + count);
  ray.End = this->Surfaces.size();
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Render(Frame& frame)
{
  this->BeginRays();
  std::size_t enough = SegmentsAtOnce;
  while (Cloud* cloud = this->FindNearest())
  {
    this->Add(*cloud);
    if (this->Pending.size() >= enough)
    {
      const Cloud* next = this->FindNearest();
      this->DrawBefore(next ? next->Viewed.Source->GetNextDepth() : Infinity);
      // Those that are left are sorted again.
      enough = std::max(SegmentsAtOnce, 2 * this->Pending.size());
    }
  }
  this->DrawBefore(Infinity);
  for (int pixel = 0; pixel < CloudTile::Capacity; ++pixel)
  {
    this->DrawMaximum(this->Rays[static_cast<std::size_t>(pixel)]);
    this->DrawFragments(pixel, Infinity);
  }
  this->Write(frame);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::BeginRays()
{
  const Camera& view = this->TheScene.Fields.front().View;
  const PixelRectangle inViewport = { this->TheScene.Pixels.X + this->Tile.X,
    this->TheScene.Pixels.Y + this->Tile.Y, this->Tile.Width, this->Tile.Height };
  const float* depths = this->TheScene.Depth;
  const std::ptrdiff_t stride = this->TheScene.Pixels.Width;
  const PixelDepths depthsOfTile = {
    depths ? depths + this->Tile.Y * stride + this->Tile.X : nullptr, stride
  };
  this->RaysOfTile.Columns = this->Tile.Width;
  this->RaysOfTile.Rows = this->Tile.Height;
  for (int y = 0; y < CloudTile::Edge; ++y)
  {
    this->Open[y] = y < this->Tile.Height ? (1U << this->Tile.Width) - 1U : 0U;
    for (int x = 0; y < this->Tile.Height && x < this->Tile.Width; ++x)
    {
      this->BeginRay(
        view, inViewport.X + x, inViewport.Y + y, depthsOfTile.Get(x, y), y * CloudTile::Edge + x);
    }
  }
  for (const Cloud& cloud : this->Clouds)
  {
    cloud.Viewed.Source->Begin(cloud.Viewed.View, inViewport, this->RaysOfTile);
  }
}

//------------------------------------------------------------------------------
/// Depths grow with the T of the ray: see MakePixelRays, where w is one over that of the clip
/// coordinates. All this is the same in the object spaces of all fields.
void CloudTileRenderer::BeginRay(const Camera& view, int column, int row, double depth, int pixel)
{
  CloudTile& rays = this->RaysOfTile;
  const Camera::PixelRay ray = view.GetRay(column, row, depth);
  const Matrix4& object = view.GetObjectFromClip();
  const double x = (column + 0.5) * (2.0 / view.GetWidth()) - 1.0;
  const double y = (row + 0.5) * (2.0 / view.GetHeight()) - 1.0;
  const double depthOfT = object[12] * x + object[13] * y + object[15] - object[14];
  rays.DepthOfT[pixel] = depthOfT;
  rays.Length[pixel] =
    Length(TransformDirection(view.GetWorldFromObject(), ray.Direction)) / depthOfT;
  rays.Begin[pixel] = 0.0;
  rays.End[pixel] = ray.End * depthOfT;
  // Nothing is seen behind an opaque surface.
  const RayLight& light = this->Rays[static_cast<std::size_t>(pixel)];
  if (light.Fragment < light.End && this->Surfaces[light.End - 1].Opacity >= 1.0)
  {
    rays.End[pixel] =
      std::min(rays.End[pixel], this->GetDepth(this->Surfaces[light.End - 1], pixel));
  }
}

//------------------------------------------------------------------------------
/// The cloud with the nearest of the segments that are not found yet; null if there is none.
CloudTileRenderer::Cloud* CloudTileRenderer::FindNearest()
{
  const bool isOpen = std::any_of(
    std::begin(this->Open), std::end(this->Open), [](std::uint32_t row) { return row != 0; });
  Cloud* nearest = nullptr;
  double least = Infinity;
  for (Cloud& cloud : this->Clouds)
  {
    const double depth = cloud.Viewed.Source->GetNextDepth();
    nearest = isOpen && depth < least ? &cloud : nearest;
    least = std::min(least, depth);
  }
  return nearest;
}

//------------------------------------------------------------------------------
/// Adds the next segments of a cloud to those that are pending.
void CloudTileRenderer::Add(Cloud& cloud)
{
  this->Segments->Count = 0;
  cloud.Viewed.Source->FindMore(this->Open, *this->Segments);
  if (cloud.Field->IsMaximum)
  {
    this->FindMaxima(cloud);
  }
  else if (this->Surfaces.empty())
  {
    this->Integrate(cloud, *this->Segments);
  }
  else
  {
    this->IntegrateParts(cloud);
  }
}

//------------------------------------------------------------------------------
void CloudTileRenderer::FindMaxima(const Cloud& cloud)
{
  const CloudSegments& segments = *this->Segments;
  for (int i = 0; i < segments.Count; ++i)
  {
    RayLight& ray = this->Rays[static_cast<std::size_t>(segments.Pixel[i])];
    const double largest = std::max(segments.Value[0][i], segments.Value[1][i]);
    if (largest > ray.Maximum)
    {
      ray.Maximum = largest;
      ray.MaximumOf = cloud.Field;
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
void CloudTileRenderer::IntegrateParts(const Cloud& cloud)
{
  const CloudSegments& whole = *this->Segments;
  CloudSegments& parts = *this->Parts;
  parts.Count = 0;
  for (int i = 0; i < whole.Count; ++i)
  {
    const int pixel = whole.Pixel[i];
    const RayLight& ray = this->Rays[static_cast<std::size_t>(pixel)];
    double depth[2] = { whole.Depth[0][i], whole.Depth[1][i] };
    double value[2] = { whole.Value[0][i], whole.Value[1][i] };
    for (std::size_t k = ray.Fragment; k < ray.End; ++k)
    {
      const double at = this->GetDepth(this->Surfaces[k], pixel);
      if (depth[0] < at && at < depth[1])
      {
        const double there = Lerp(value[0], value[1], (at - depth[0]) / (depth[1] - depth[0]));
        this->AddPart(cloud, pixel, { depth[0], at }, { value[0], there });
        depth[0] = at;
        value[0] = there;
      }
    }
    this->AddPart(cloud, pixel, { depth[0], depth[1] }, { value[0], value[1] });
  }
  this->Integrate(cloud, parts);
}

//------------------------------------------------------------------------------
void CloudTileRenderer::AddPart(const Cloud& cloud, int pixel, const std::array<double, 2>& depths,
  const std::array<double, 2>& values)
{
  CloudSegments& parts = *this->Parts;
  if (parts.Count == CloudSegments::Batch)
  {
    this->Integrate(cloud, parts);
    parts.Count = 0;
  }
  parts.Pixel[parts.Count] = pixel;
  for (std::size_t end = 0; end < 2; ++end)
  {
    parts.Depth[end][parts.Count] = depths[end];
    parts.Value[end][parts.Count] = values[end];
  }
  ++parts.Count;
}

//------------------------------------------------------------------------------
void CloudTileRenderer::Integrate(const Cloud& cloud, const CloudSegments& segments)
{
  const std::size_t before = this->Pending.size();
  const auto count = static_cast<std::size_t>(segments.Count);
  this->Pending.resize(before + count);
  this->Lights.resize(before + count);
  this->TheKernels.IntegrateSegments(
    this->RaysOfTile, cloud.Field->Cloud->GetPieces(), segments, this->Lights.data() + before);
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
    SortByDepth(first, last);
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
void CloudTileRenderer::SortByDepth(PendingSegment* first, PendingSegment* last)
{
  for (PendingSegment* i = first + 1; i < last; ++i)
  {
    const PendingSegment moved = *i;
    PendingSegment* place = i;
    for (; place > first && moved.Depth < (place - 1)->Depth; --place)
    {
      *place = *(place - 1);
    }
    *place = moved;
  }
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
