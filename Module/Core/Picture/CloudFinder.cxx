// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudFinder.h"

#include "Field/PixelBlocks.h"
#include "Kernels/Kernels.h"
#include "Math/Arithmetic.h"
#include "Picture/CloudMedium.h"

#include <algorithm>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

PixelRectangle InViewport(const Scene& scene, const PixelRectangle& tile)
{
  return { scene.Pixels.X + tile.X, scene.Pixels.Y + tile.Y, tile.Width, tile.Height };
}

/// Leaves out the segments that begin before a depth.
void RemoveBefore(double depth, CloudSegments& segments)
{
  int kept = 0;
  for (int i = 0; i < segments.Count; ++i)
  {
    if (segments.Depth[0][i] < depth)
    {
      continue;
    }
    segments.Pixel[kept] = segments.Pixel[i];
    for (int end = 0; end < 2; ++end)
    {
      segments.Depth[end][kept] = segments.Depth[end][i];
      for (int component = 0; component < segments.Components; ++component)
      {
        segments.Value[component][end][kept] = segments.Value[component][end][i];
      }
      for (int k = 0; k < 3 * segments.Gradients; ++k)
      {
        segments.Gradient[k][end][kept] = segments.Gradient[k][end][i];
      }
    }
    ++kept;
  }
  segments.Count = kept;
}

}

//------------------------------------------------------------------------------
bool HasClouds(const Scene& scene)
{
  return std::any_of(scene.Fields.begin(), scene.Fields.end(),
    [](const SceneField& field) { return field.Cloud != nullptr; });
}

//------------------------------------------------------------------------------
void MakeCloudRays(const Scene& scene, const PixelRectangle& tile, const Kernels& kernels,
  CloudTile& rays, CloudLighting* lighting)
{
  const Camera& view = scene.Fields.front().View;
  const std::ptrdiff_t stride = scene.Pixels.Width;
  const PixelDepths depths = { scene.Depth ? scene.Depth + tile.Y * stride + tile.X : nullptr,
    stride };
  kernels.MakeCloudRays(MakePixelBlock(view, InViewport(scene, tile), depths),
    view.GetWorldFromObject().data(), rays, lighting);
}

//------------------------------------------------------------------------------
void CutCloudRay(const Fragment* fragments, std::size_t count, int pixel, CloudTile& rays)
{
  if (count > 0 && fragments[count - 1].Opacity >= 1.0)
  {
    rays.End[pixel] = std::min(rays.End[pixel], fragments[count - 1].T * rays.DepthOfT[pixel]);
  }
}

//------------------------------------------------------------------------------
CloudFinder::CloudFinder(const Scene& scene, const Kernels* kernels)
  : TheScene(scene)
{
  std::vector<ViewedCloud> found;
  for (std::size_t i = 0; i < scene.Fields.size(); ++i)
  {
    const SceneField& field = scene.Fields[i];
    if (field.Cloud)
    {
      // The largest value may be one that shows nothing.
      const std::vector<ValueIntervals> shown = field.IsMaximum
        ? std::vector<ValueIntervals>{ { { -Infinity, Infinity } } }
        : field.Cloud->FindShown();
      field.Field->AddClouds(field.View, shown, kernels, found);
      for (ViewedCloud& cloud : found)
      {
        this->Clouds.push_back({ std::move(cloud), i });
      }
      found.clear();
    }
  }
}

//------------------------------------------------------------------------------
void CloudFinder::Begin(const PixelRectangle& tile, const CloudTile& rays, double from)
{
  this->From = from;
  this->Seen.clear();
  for (const Cloud& cloud : this->Clouds)
  {
    cloud.Viewed.Source->Begin(cloud.Viewed.View, InViewport(this->TheScene, tile), rays, from);
    if (cloud.Viewed.Source->GetNextDepth() < Infinity)
    {
      this->Seen.push_back(&cloud);
    }
  }
}

//------------------------------------------------------------------------------
double CloudFinder::GetNextDepth() const
{
  double least = Infinity;
  for (const Cloud* cloud : this->Seen)
  {
    least = std::min(least, cloud->Viewed.Source->GetNextDepth());
  }
  return least;
}

//------------------------------------------------------------------------------
std::size_t CloudFinder::FindMore(
  const std::uint32_t (&open)[CloudTile::Edge], CloudSegments& segments)
{
  const Cloud& cloud = **std::min_element(this->Seen.begin(), this->Seen.end(),
    [](const Cloud* a, const Cloud* b)
    { return a->Viewed.Source->GetNextDepth() < b->Viewed.Source->GetNextDepth(); });
  segments.Count = 0;
  cloud.Viewed.Source->FindMore(open, segments);
  if (this->From > 0.0)
  {
    RemoveBefore(this->From, segments);
  }
  return cloud.Field;
}

}
