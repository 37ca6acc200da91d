// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceVolume.h"

#include "vtkIsosurfaceRayTraceEngine.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN

//------------------------------------------------------------------------------
vtkStandardNewMacro(vtkIsosurfaceVolume);

//------------------------------------------------------------------------------
vtkIsosurfaceVolume::vtkIsosurfaceVolume() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceVolume::~vtkIsosurfaceVolume() = default;

//------------------------------------------------------------------------------
vtkTypeBool vtkIsosurfaceVolume::HasOpaqueGeometry()
{
  auto* engine = vtkIsosurfaceRayTraceEngine::Of(this->Mapper);
  return engine && engine->HasOnlyOpaqueSurfaces(this) ? 1 : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceVolume::RenderOpaqueGeometry(vtkViewport* viewport)
{
  // vtkVolume draws in this method, which may be called at any time of a frame.
  return this->HasOpaqueGeometry() ? this->Superclass::RenderVolumetricGeometry(viewport) : 0;
}

//------------------------------------------------------------------------------
int vtkIsosurfaceVolume::RenderVolumetricGeometry(vtkViewport* viewport)
{
  return this->HasOpaqueGeometry() ? 0 : this->Superclass::RenderVolumetricGeometry(viewport);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "HasOpaqueGeometry: " << this->HasOpaqueGeometry() << "\n";
}

VTK_ABI_NAMESPACE_END
