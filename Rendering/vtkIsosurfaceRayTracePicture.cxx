// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePicture.h"

#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkRenderer.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTracePicture::SetScene(const vtkIsosurfaceRayTraceSettings& settings,
  const vtkIsosurfaceRayTraceRequest& request, const View& view)
{
  vtkirt::SceneField shown;
  shown.Surface = vtkIsosurfaceRayTraceScene::GetMaterial(request.Property, request.Component);
  if (!this->ColorsOfValues || !this->ColorsOfValues->AreOf(request.Property, request.Component))
  {
    this->ColorsOfValues =
      std::make_unique<vtkIsosurfaceRayTraceValueColors>(request.Property, request.Component);
  }
  shown.ColorsOfValues = this->ColorsOfValues.get();
  for (const vtkirt::Isosurface& surface : request.GetTraceRequest().Surfaces)
  {
    shown.Colors.push_back(this->ColorsOfValues->GetColor(surface.Isovalue));
  }
  this->ColorsOfHits = request.Input.MakeColors(*this->ColorsOfValues);
  shown.ColorsOfHits = this->ColorsOfHits.get();
  shown.View = vtkIsosurfaceRayTraceScene::MakeCamera(
    view.ClipFromWorld, request.WorldFromObject, view.Width, view.Height);

  vtkirt::Scene scene;
  scene.TileWidth = settings.TileWidth;
  scene.TileHeight = settings.TileHeight;
  scene.Shadows = settings.Shadows;
  scene.OcclusionRays = settings.NumberOfAmbientOcclusionRays;
  scene.OcclusionRadius = settings.AmbientOcclusionRadius;
  shown.Field = request.Input.GetField();
  shown.CellSize = request.Input.GetCellSize();
  shown.Pixels = vtkIsosurfaceRayTraceScene::GetPixels(shown.View, shown.Field->GetBounds());
  scene.Pixels = shown.Pixels;
  scene.Fields.push_back(shown);
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
bool vtkIsosurfaceRayTracePicture::Trace(
  const vtkirt::Execution& execution, const std::function<bool(double)>& keepGoing)
{
  return vtkirt::RenderTiles(this->Scene, execution, this->Frame, this->Times, keepGoing);
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
