// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Scene.h"

#include "Scalars.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkDataObject.h>
#include <vtkLightKit.h>
#include <vtkMatrix4x4.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace Viewer
{
namespace
{

/// Looks at the +y side, slightly from one side and from above, with z up: at the face of a head
/// whose y axis runs to the front.
void PlaceCamera(vtkCamera* camera)
{
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(-0.45, 1.0, 0.3);
  camera->SetViewUp(0.0, 0.0, 1.0);
}

//------------------------------------------------------------------------------
/// How far a box reaches from the middle of the view to its border: 1 is just in the window.
double FindExtent(const double bounds[6], vtkRenderer* renderer)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  const double* middle = camera->GetWindowCenter();
  vtkMatrix4x4* viewFromWorld =
    camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0);
  double extent = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double world[4] = { bounds[corner % 2], bounds[2 + corner / 2 % 2],
      bounds[4 + corner / 4], 1.0 };
    double view[4];
    viewFromWorld->MultiplyPoint(world, view);
    for (int axis = 0; axis < 2; ++axis)
    {
      extent = std::max(extent, std::abs(view[axis] / view[3] + middle[axis]));
    }
  }
  return extent;
}

}

//------------------------------------------------------------------------------
Scene::Scene(vtkDataObject* data, const Scalars& scalars, const std::vector<double>& isovalues)
  : Highest(scalars.GetHighest())
{
  this->Mapper->SetInputDataObject(data);
  scalars.SelectFor(this->Mapper);
  if (scalars.AreVectors())
  {
    this->Mapper->SetVectorModeToMagnitude();
  }
  this->Mapper->LevelOfDetailOn();
  this->Mapper->ProgressiveAccumulationOn();
  // Frames are added while the picture rests, so each may have few.
  this->Mapper->SetNumberOfAmbientOcclusionRays(4);
  this->Mapper->CapClippingPlanesOn();
  this->Volume->SetMapper(this->Mapper);
  this->Volume->GetProperty()->ShadeOn();
  this->UpdateMaterial();

  const bool areTwo = isovalues.size() > 1;
  const double first = isovalues.empty() ? scalars.FindThreshold() : isovalues[0];
  const double second = areTwo ? isovalues[1] : 0.5 * (scalars.GetLowest() + first);
  this->Surfaces[0] = { first, 1.0, { 0.96, 0.90, 0.80 }, true };
  this->Surfaces[1] = { second, 0.4, { 0.90, 0.58, 0.46 }, areTwo };
  this->UpdateColors();

  this->Renderer->SetBackground(0.16, 0.18, 0.22);
  this->Renderer->SetBackground2(0.42, 0.46, 0.52);
  this->Renderer->GradientBackgroundOn();
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(0.9);
  lights->AddLightsToRenderer(this->Renderer);
  this->Renderer->AddVolume(this->Volume);
  PlaceCamera(this->Renderer->GetActiveCamera());
}

//------------------------------------------------------------------------------
Scene::~Scene() = default;

//------------------------------------------------------------------------------
void Scene::SetSurface(std::size_t number, const Surface& surface)
{
  this->Surfaces.at(number) = surface;
  this->UpdateColors();
}

//------------------------------------------------------------------------------
void Scene::UpdateColors()
{
  vtkVolumeProperty* property = this->Volume->GetProperty();
  vtkContourValues* isovalues = property->GetIsoSurfaceValues();
  vtkColorTransferFunction* colors = property->GetRGBTransferFunction();
  vtkPiecewiseFunction* opacities = property->GetScalarOpacity();
  colors->RemoveAllPoints();
  opacities->RemoveAllPoints();
  int count = 0;
  const Surface* innermost = nullptr;
  for (const Surface& surface : this->Surfaces)
  {
    if (surface.IsVisible)
    {
      isovalues->SetValue(count++, surface.Isovalue);
      colors->AddRGBPoint(surface.Isovalue, surface.Color[0], surface.Color[1], surface.Color[2]);
      opacities->AddPoint(surface.Isovalue, surface.Opacity);
      innermost = !innermost || innermost->Isovalue < surface.Isovalue ? &surface : innermost;
    }
  }
  isovalues->SetNumberOfContours(count);
  // Caps show the values inside: from the colour of the surface to a dark one.
  if (innermost && innermost->Isovalue < this->Highest)
  {
    constexpr double dark = 0.2;
    colors->AddRGBPoint(this->Highest, dark * innermost->Color[0], dark * innermost->Color[1],
      dark * innermost->Color[2]);
  }
}

//------------------------------------------------------------------------------
void Scene::UpdateMaterial()
{
  // Only ambient light is occluded, and it alone comes to where all lights are in shadow.
  vtkVolumeProperty* property = this->Volume->GetProperty();
  const bool isOccluded = this->Mapper->GetAmbientOcclusion();
  property->SetAmbient(isOccluded ? 0.45 : this->Mapper->GetShadows() ? 0.25 : 0.1);
  property->SetDiffuse(isOccluded ? 0.65 : 0.9);
  property->SetSpecular(0.2);
  property->SetSpecularPower(30.0);
}

//------------------------------------------------------------------------------
void Scene::ToggleShadows()
{
  this->Mapper->SetShadows(!this->Mapper->GetShadows());
  this->UpdateMaterial();
}

//------------------------------------------------------------------------------
void Scene::ToggleAmbientOcclusion()
{
  this->Mapper->SetAmbientOcclusion(!this->Mapper->GetAmbientOcclusion());
  this->UpdateMaterial();
}

//------------------------------------------------------------------------------
void Scene::ToggleCubicInterpolation()
{
  const bool isCubic = this->Mapper->GetInterpolationMode() == vtkIsosurfaceRayTraceMapper::CUBIC;
  this->Mapper->SetInterpolationMode(
    isCubic ? vtkIsosurfaceRayTraceMapper::TRILINEAR : vtkIsosurfaceRayTraceMapper::CUBIC);
}

//------------------------------------------------------------------------------
void Scene::FrameSurfaces()
{
  double bounds[6];
  this->Volume->GetBounds(bounds);
  this->Mapper->FindSurfaceBounds(this->Volume, bounds);
  this->Renderer->ResetCamera(bounds);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  constexpr double share = 0.84; // of the window
  // Moving the camera changes the perspective a little.
  for (int i = 0; i < 3; ++i)
  {
    camera->Dolly(share / FindExtent(bounds, this->Renderer));
  }
  this->Renderer->ResetCameraClippingRange();
}

}
