// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePicture.h"

#include "vtkIsosurfaceRayTraceAccumulation.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkRenderer.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// The pixels of a rectangle, and those to the left and below in the tiles of the whole picture.
vtkirt::PixelRectangle AlignToTiles(const vtkirt::PixelRectangle& pixels)
{
  if (vtkirt::IsEmpty(pixels))
  {
    return pixels;
  }
  const int left = pixels.X % vtkirt::CloudTile::Edge;
  const int below = pixels.Y % vtkirt::CloudTile::Edge;
  return { pixels.X - left, pixels.Y - below, pixels.Width + left, pixels.Height + below };
}

}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::SetScene(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const View& view)
{
  vtkirt::Scene scene;
  scene.TileWidth = settings.TileWidth;
  scene.TileHeight = settings.TileHeight;
  scene.Shadows = settings.Shadows;
  scene.OcclusionRays = settings.NumberOfAmbientOcclusionRays;
  scene.OcclusionRadius = settings.AmbientOcclusionRadius;
  this->Colors.resize(request.Volumes.size());
  for (std::size_t i = 0; i < request.Volumes.size(); ++i)
  {
    const vtkIsosurfaceRayTraceRequest::Volume& volume = request.Volumes[i];
    vtkirt::SceneField shown;
    SetColors(volume, this->Colors[i], shown);
    shown.IsMaximum = settings.IsMaximum;
    shown.Surface = vtkIsosurfaceRayTraceScene::GetMaterial(volume.Property, volume.Component);
    shown.View = vtkIsosurfaceRayTraceScene::MakeCamera(
      view.ClipFromWorld, volume.WorldFromObject, view.Width, view.Height);
    shown.Field = volume.Input->GetField();
    shown.CellSize = volume.Input->GetCellSize();
    if (volume.Input->GetNumberOfParts() > 1)
    {
      // The parts that may be seen are found for each tile.
      constexpr int least = 32;
      scene.TileWidth = std::max(scene.TileWidth, least);
      scene.TileHeight = std::max(scene.TileHeight, least);
    }
    shown.Pixels = vtkIsosurfaceRayTraceScene::GetPixels(shown.View, shown.Field->GetBounds());
    scene.Pixels = i > 0 ? vtkirt::Unite(scene.Pixels, shown.Pixels) : shown.Pixels;
    scene.Fields.push_back(shown);
  }
  if (settings.HasCloud)
  {
    scene.TileWidth = vtkirt::CloudTile::Edge;
    scene.TileHeight = vtkirt::CloudTile::Edge;
    // Where tiles begin changes the last bits: so it does not depend on what is seen of the data.
    scene.Pixels = AlignToTiles(scene.Pixels);
  }
  this->Scene = std::move(scene);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::SetColors(const vtkIsosurfaceRayTraceRequest::Volume& volume,
  ColorsOfField& colors, vtkirt::SceneField& shown)
{
  if (!colors.OfValues || !colors.OfValues->AreOf(volume.Property, volume.Component))
  {
    colors.OfValues =
      std::make_unique<vtkIsosurfaceRayTraceValueColors>(volume.Property, volume.Component);
    colors.OfCloud.reset();
  }
  shown.ColorsOfValues = colors.OfValues.get();
  for (const vtkirt::Isosurface& surface : volume.GetField().GetRequest().Surfaces)
  {
    shown.Colors.push_back(colors.OfValues->GetColor(surface.Isovalue));
  }
  colors.OfHits = volume.Input->MakeColors(*colors.OfValues);
  shown.ColorsOfHits = colors.OfHits.get();
  const bool hasCloud = volume.GetField().GetRequest().HasCloud;
  const vtkIsosurfaceRayTraceClouds::Components& components = volume.Input->GetCloudComponents();
  if (hasCloud && (!colors.OfCloud || !(colors.Components == components)))
  {
    colors.Components = components;
    colors.Property = volume.Property;
    colors.OfCloud =
      vtkIsosurfaceRayTraceClouds::MakeMedium(components, volume.Property, volume.Component);
  }
  shown.Cloud = hasCloud ? colors.OfCloud.get() : nullptr;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::AgreeOnClouds(vtkirt::MessageExchange& exchange)
{
  using vtkIsosurfaceRayTraceClouds::Components;
  constexpr int none = std::numeric_limits<int>::min() / 2;
  std::vector<int> largest;
  for (const ColorsOfField& colors : this->Colors)
  {
    const Components& own = colors.Components;
    const int code = 2 * own.Count + (own.AreBytes ? 1 : 0);
    largest.insert(largest.end(), { code, own.Count > 0 ? -code : none });
  }
  exchange.FindLargest(largest.data(), static_cast<int>(largest.size()));
  for (std::size_t i = 0; i < this->Colors.size(); ++i)
  {
    ColorsOfField& colors = this->Colors[i];
    const int code = largest[2 * i];
    if (code != 0 && code != -largest[2 * i + 1])
    {
      return false;
    }
    if (code != 0 && colors.Components.Count == 0)
    {
      colors.Components = { code / 2, code % 2 != 0 };
      colors.OfCloud =
        vtkIsosurfaceRayTraceClouds::MakeMedium(colors.Components, colors.Property, 0);
      this->Scene.Fields[i].Cloud = colors.OfCloud.get();
    }
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::AddLights(vtkRenderer* renderer)
{
  vtkIsosurfaceRayTraceScene::AddLights(
    renderer->GetLights(), renderer->GetActiveCamera(), false, this->Scene);
  this->Scene.TwoSidedLighting = renderer->GetTwoSidedLighting() != 0;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::SetDepths(const float* depths, int width)
{
  const vtkirt::PixelRectangle& pixels = this->Scene.Pixels;
  this->Depths.clear();
  for (int y = 0; y < pixels.Height; ++y)
  {
    const float* row = depths + pixels.X +
      static_cast<std::ptrdiff_t>(pixels.Y + y) * static_cast<std::ptrdiff_t>(width);
    this->Depths.insert(this->Depths.end(), row, row + pixels.Width);
  }
  this->Scene.Depth = this->Depths.data();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::Trace(
  const vtkirt::Execution& execution, const std::function<bool(double)>& keepGoing)
{
  return vtkirt::RenderTiles(this->Scene, execution, this->Frame, this->Times, keepGoing);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::TraceMean(
  int frames, const vtkirt::Execution& execution, const std::function<bool(double)>& keepGoing)
{
  const vtkirt::Scene first = this->Scene;
  vtkIsosurfaceRayTraceAccumulation accumulation;
  std::vector<vtkirt::Hit> hits;
  vtkirt::FrameTimes times;
  bool isComplete = true;
  for (int frame = 0; frame < frames && isComplete; ++frame)
  {
    this->Scene = first;
    this->Scene.KeepHits = first.KeepHits && frame == 0;
    vtkIsosurfaceRayTraceAccumulation::SetFrame(frame, this->Scene);
    isComplete = this->Trace(execution,
      [&keepGoing, frame, frames](double fraction)
      { return keepGoing((frame + fraction) / frames); });
    accumulation.Add({}, this->Frame);
    if (frame == 0)
    {
      hits = std::move(this->Frame.Hits);
    }
    times.Bricks += this->Times.Bricks;
    times.Trace += this->Times.Trace;
    times.Shade += this->Times.Shade;
  }
  accumulation.GetMean(this->Frame);
  this->Frame.Hits = std::move(hits);
  this->Scene = first;
  this->Times = times;
  return isComplete;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::IsVisible(std::size_t pixel) const
{
  const vtkirt::Hit& hit = this->Frame.Hits[pixel];
  return hit.Surface != vtkirt::Hit::NoSurface &&
    (!this->GetField(hit).Field->GetRequest().Projection || this->Frame.Colors[4 * pixel + 3] > 0);
}

//------------------------------------------------------------------------------
float vtkIsosurfaceRayTracePicture::GetDepth(const vtkirt::Hit& hit) const
{
  const vtkirt::SceneField& field = this->GetField(hit);
  return static_cast<float>(field.View.GetDepth(field.Field->GetPoint(hit)));
}

VTK_ABI_NAMESPACE_END
