// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSharedPicture.h"

#include "vtkIsosurfaceRayTraceCompositor.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkViewport.h"
#include "vtkVolume.h"

#include <algorithm>
#include <cmath>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
//------------------------------------------------------------------------------
int GetNumberOfRays(int pixels, double distance)
{
  return std::max(1, static_cast<int>(std::ceil(pixels / std::max(1.0, distance))));
}

//------------------------------------------------------------------------------
vtkOpenGLState* GetState(vtkViewport* viewport)
{
  return static_cast<vtkOpenGLRenderWindow*>(viewport->GetVTKWindow())->GetState();
}
}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceRayTraceSharedPicture);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSharedPicture::vtkIsosurfaceRayTraceSharedPicture()
{
  vtkMath::UninitializeBounds(this->Bounds);
  this->SetPicture(this->Image);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSharedPicture::~vtkIsosurfaceRayTraceSharedPicture() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::SetBounds(const vtkBoundingBox& bounds)
{
  vtkMath::UninitializeBounds(this->Bounds);
  if (bounds.IsValid())
  {
    bounds.GetBounds(this->Bounds);
  }
}

//------------------------------------------------------------------------------
double* vtkIsosurfaceRayTraceSharedPicture::GetBounds()
{
  return this->Bounds;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::Make(
  vtkVolume* volume, vtkRenderer* renderer, int reduction, double distance)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  this->Compositor->BroadcastCamera(camera);
  renderer->UpdateLightsGeometryToFollowCamera(); // which the renderer itself does later
  int origin[2];
  renderer->GetTiledSizeAndOrigin(&this->Size[0], &this->Size[1], &origin[0], &origin[1]);
  this->Size[0] /= reduction;
  this->Size[1] /= reduction;
  const int columns = GetNumberOfRays(this->Size[0], distance);
  const int rows = GetNumberOfRays(this->Size[1], distance);
  const vtkSmartPointer<vtkFloatArray> depths = this->Depths.Find(renderer, columns, rows);
  if (!this->Compositor->RenderToImage(
        volume, camera, renderer->GetLights(), columns, rows, this->Image, depths))
  {
    this->Image->Initialize();
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceSharedPicture::RenderOpaqueGeometry(vtkViewport* viewport)
{
  vtkOpenGLState* state = GetState(viewport);
  const vtkOpenGLState::ScopedglViewport restoring(state);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
  return this->Superclass::RenderOpaqueGeometry(viewport);
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceSharedPicture::RenderVolumetricGeometry(vtkViewport* viewport)
{
  vtkOpenGLState* state = GetState(viewport);
  const vtkOpenGLState::ScopedglViewport restoring(state);
  state->vtkglViewport(0, 0, this->Size[0], this->Size[1]);
  return this->Superclass::RenderVolumetricGeometry(viewport);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSharedPicture::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Depths.ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

VTK_ABI_NAMESPACE_END
