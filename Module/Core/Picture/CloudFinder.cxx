// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Picture/CloudFinder.h"

#include "Field/HitCollector.h"
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

/// The rays of rows, with what the kernel finds of them.
void MakeRays(const Scene& scene, const PixelRows& tile, const Kernels& kernels,
  const double* worldFromObject, CloudTile& rays, CloudLighting* lighting)
{
  const Camera& view = scene.Fields.front().View;
  const std::ptrdiff_t stride = scene.Pixels.Width;
  for (int first = 0; first < tile.Count;)
  {
    const PixelRectangle pixels = tile.FindRectangle(first);
    const PixelDepths depths = { scene.Depth ? scene.Depth + pixels.Y * stride + pixels.X : nullptr,
      stride };
    kernels.MakeCloudRays(MakePixelBlock(view, InViewport(scene, pixels), depths), first,
      worldFromObject, rays, lighting);
    first += pixels.Height;
  }
}

}

//------------------------------------------------------------------------------
bool HasClouds(const Scene& scene)
{
  return std::any_of(scene.Fields.begin(), scene.Fields.end(),
    [](const SceneField& field) { return field.Cloud != nullptr; });
}

//------------------------------------------------------------------------------
void MakeCloudRays(
  const Scene& scene, const PixelRows& tile, const Kernels& kernels, CloudTile& rays)
{
  MakeRays(scene, tile, kernels, nullptr, rays, nullptr);
}

//------------------------------------------------------------------------------
void MakeMeasuredCloudRays(const Scene& scene, const PixelRows& tile, const Kernels& kernels,
  CloudTile& rays, CloudLighting* lighting)
{
  const Matrix4& worldFromObject = scene.Fields.front().View.GetWorldFromObject();
  MakeRays(scene, tile, kernels, worldFromObject.data(), rays, lighting);
}

//------------------------------------------------------------------------------
std::size_t CountVisible(const Fragment* fragments, std::size_t count)
{
  double transmittance = 1.0;
  std::size_t visible = 0;
  for (; visible < count && transmittance >= NegligibleTransmittance; ++visible)
  {
    transmittance *= 1.0 - fragments[visible].Opacity;
  }
  return visible;
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
void CloudFinder::Begin(
  const PixelRectangle& tile, const CloudTile& rays, const std::vector<double>* position)
{
  this->Seen.clear();
  for (std::size_t i = 0; i < this->Clouds.size(); ++i)
  {
    const Cloud& cloud = this->Clouds[i];
    const double from = position ? (*position)[i] : -Infinity;
    if (from == Infinity)
    {
      continue;
    }
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
  cloud.Viewed.Source->FindMore(open, false, segments);
  return cloud.Field;
}

//------------------------------------------------------------------------------
bool CloudFinder::IsPaused() const
{
  return std::all_of(this->Seen.begin(), this->Seen.end(),
    [](const Cloud* cloud) { return cloud->Viewed.Source->IsPaused(); });
}

//------------------------------------------------------------------------------
std::size_t CloudFinder::FindMoreToPause(
  const std::uint32_t (&open)[CloudTile::Edge], CloudSegments& segments)
{
  const Cloud& cloud = **std::find_if(this->Seen.begin(), this->Seen.end(),
    [](const Cloud* one) { return !one->Viewed.Source->IsPaused(); });
  segments.Count = 0;
  cloud.Viewed.Source->FindMore(open, true, segments);
  return cloud.Field;
}

//------------------------------------------------------------------------------
std::vector<double> CloudFinder::FindPosition() const
{
  std::vector<double> position;
  for (const Cloud& cloud : this->Clouds)
  {
    const bool isSeen = std::find(this->Seen.begin(), this->Seen.end(), &cloud) != this->Seen.end();
    position.push_back(isSeen ? cloud.Viewed.Source->GetNextDepth() : Infinity);
  }
  return position;
}

}
