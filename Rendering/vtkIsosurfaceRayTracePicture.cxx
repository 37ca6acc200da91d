// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePicture.h"

#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"
#include "vtkIsosurfaceRayTraceValueColors.h"

#include "vtkRenderer.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::SetScene(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const View& view)
{
  this->Volume = request.Input.GetVolume();
  vtkirt::Scene scene;
  scene.Threads = settings.NumberOfThreads;
  scene.TileWidth = settings.TileWidth;
  scene.TileHeight = settings.TileHeight;
  scene.Normals = request.NormalMode;
  scene.Request = request.Trace;
  for (const vtkirt::Isosurface& surface : scene.Request.Surfaces)
  {
    scene.Colors.push_back(
      vtkIsosurfaceRayTraceScene::GetColor(request.Property, request.Component, surface.Isovalue));
  }
  scene.Look = vtkIsosurfaceRayTraceScene::GetMaterial(request.Property, request.Component);
  scene.Shadows = settings.Shadows;
  scene.OcclusionRays = settings.NumberOfAmbientOcclusionRays;
  scene.OcclusionRadius = settings.AmbientOcclusionRadius;
  this->ColorsOfHits = request.Input.MakeColors(request.Property);
  scene.ColorsOfHits = this->ColorsOfHits.get();
  if (scene.Request.Projection || scene.Request.Visible.HasCaps())
  {
    this->ColorsOfValues =
      std::make_unique<vtkIsosurfaceRayTraceValueColors>(request.Property, request.Component);
    scene.ColorsOfValues = this->ColorsOfValues.get();
  }
  scene.View = vtkIsosurfaceRayTraceScene::MakeCamera(
    view.ClipFromWorld, request.WorldFromIndex, view.Width, view.Height);
  scene.Pixels = vtkIsosurfaceRayTraceScene::GetPixels(scene.View, this->Volume->GetDimensions());
  this->Scene = std::move(scene);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::AddLights(vtkRenderer* renderer)
{
  vtkIsosurfaceRayTraceScene::AddLights(
    renderer->GetLights(), renderer->GetActiveCamera(), false, this->Scene);
  this->Scene.TwoSidedLighting = renderer->GetTwoSidedLighting() != 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::Trace(const std::function<bool(double)>& keepGoing)
{
  return vtkirt::RenderTiles(this->Scene, *this->Volume, this->Frame, this->Times, keepGoing);
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePicture::IsVisible(std::size_t pixel) const
{
  return this->Frame.Hits[pixel].Surface != vtkirt::Hit::NoSurface &&
    (!this->Scene.Request.Projection || this->Frame.Colors[4 * pixel + 3] > 0);
}

VTK_ABI_NAMESPACE_END
