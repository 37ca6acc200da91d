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
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(this->Mapper);
  return engine && engine->HasOnlyOpaqueSurfaces(this) ? 1 : 0;
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceVolume::HasTranslucentSurfaces()
{
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(this->Mapper);
  return engine && engine->HasTranslucentSurfaces(this);
}

//------------------------------------------------------------------------------
/// Whether any other of some props is translucent and peeled. Assemblies are not asked: they make
/// the lists anew by which they are drawn, and this may be drawn as a part of one.
bool vtkIsosurfaceVolume::IsAmongTranslucent(vtkPropCollection* props)
{
  vtkCollectionSimpleIterator next;
  props->InitTraversal(next);
  while (vtkProp* prop = props->GetNextProp(next))
  {
    if (prop == this || !prop->GetVisibility())
    {
      continue;
    }
    auto* other = vtkIsosurfaceVolume::SafeDownCast(prop);
    vtkPropCollection* parts = GetParts(prop);
    if (other   ? other->HasTranslucentSurfaces()
        : parts ? this->IsAmongTranslucent(parts)
                : prop->HasTranslucentPolygonalGeometry() != 0)
    {
      return true;
    }
  }
  return false;
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
  const bool isOpaque = this->HasOpaqueGeometry() != 0;
  this->Layers->Clear();
  this->IsPeeled = !isOpaque && renderer && PeelsDepths(renderer) &&
    this->HasTranslucentSurfaces() && this->IsAmongTranslucent(renderer->GetViewProps());
  return isOpaque || this->IsPeeled ? this->Superclass::RenderVolumetricGeometry(viewport) : 0;
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
