// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceVolume.h"

#include "vtkIsosurfaceRayTraceEngine.h"
#include "vtkIsosurfaceRayTraceLayers.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkAssembly.h"
#include "vtkCollection.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp3DCollection.h"
#include "vtkPropAssembly.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

/// Whether a renderer peels depths by itself, as it does not with some passes. Selections show ids
/// instead.
bool PeelsDepths(vtkRenderer* renderer)
{
  return renderer->GetUseDepthPeeling() != 0 && !renderer->GetUseSSAO() &&
    renderer->GetUseShadows() == 0 && !renderer->GetPass() && !renderer->GetSelector();
}

/// Those of an assembly; null of other props.
vtkPropCollection* GetParts(vtkProp* prop)
{
  if (auto* assembly = vtkAssembly::SafeDownCast(prop))
  {
    return assembly->GetParts();
  }
  auto* assembly = vtkPropAssembly::SafeDownCast(prop);
  return assembly ? assembly->GetParts() : nullptr;
}

using Opacity = vtkIsosurfaceRayTraceEngine::Opacity;

Opacity FindOpacity(vtkVolume* volume)
{
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(volume->GetMapper());
  return engine ? engine->FindOpacity(volume) : Opacity::None;
}

/// Whether any of some props but one is translucent and peeled. Assemblies are not asked: they make
/// the lists anew by which they are drawn, and that one may be drawn as a part of one.
bool AreOthersTranslucent(vtkPropCollection* props, vtkProp* one)
{
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next))
  {
    if (prop == one || !prop->GetVisibility())
    {
      continue;
    }
    auto* volume = vtkIsosurfaceVolume::SafeDownCast(prop);
    vtkPropCollection* parts = GetParts(prop);
    if (volume  ? FindOpacity(volume) == Opacity::Translucent
        : parts ? AreOthersTranslucent(parts, one)
                : prop->HasTranslucentPolygonalGeometry() != 0)
    {
      return true;
    }
  }
  return false;
}

}

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceVolume);

//------------------------------------------------------------------------------
vtkIsosurfaceVolume::vtkIsosurfaceVolume()
  : Layers(std::make_unique<vtkIsosurfaceRayTraceLayers>())
{
}

//------------------------------------------------------------------------------
vtkIsosurfaceVolume::~vtkIsosurfaceVolume() = default;

//------------------------------------------------------------------------------
vtkTypeBool vtkIsosurfaceVolume::HasOpaqueGeometry()
{
  return FindOpacity(this) == Opacity::Opaque ? 1 : 0;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceLayers* vtkIsosurfaceVolume::FindLayers(
  vtkVolume* volume, vtkRenderer* renderer)
{
  auto* self = vtkIsosurfaceVolume::SafeDownCast(volume);
  return self && self->IsPeeled && PeelsDepths(renderer) ? self->Layers.get() : nullptr;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkIsosurfaceVolume::HasTranslucentPolygonalGeometry()
{
  // The opaque geometry of a frame is drawn before.
  return this->IsPeeled ? 1 : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceVolume::RenderOpaqueGeometry(vtkViewport* viewport)
{
  // vtkVolume draws in this method, which may be called at any time of a frame.
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  const Opacity opacity = FindOpacity(this);
  this->Layers->Clear();
  this->IsPeeled = opacity == Opacity::Translucent && renderer && PeelsDepths(renderer) &&
    AreOthersTranslucent(renderer->GetViewProps(), this);
  return opacity == Opacity::Opaque || this->IsPeeled
    ? this->Superclass::RenderVolumetricGeometry(viewport)
    : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceVolume::RenderTranslucentPolygonalGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window =
    renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  vtkIsosurfaceRayTraceLayers* layers = window ? FindLayers(this, renderer) : nullptr;
  if (!layers)
  {
    return 0;
  }
  layers->Draw(window, this);
  return 1;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceVolume::RenderVolumetricGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  const bool wasDrawn = this->HasOpaqueGeometry() || (renderer && FindLayers(this, renderer));
  return wasDrawn ? 0 : this->Superclass::RenderVolumetricGeometry(viewport);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceVolume::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Layers->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasOpaqueGeometry: " << this->HasOpaqueGeometry() << "\n";
}

VTK_ABI_NAMESPACE_END
