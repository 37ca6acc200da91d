// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkCellProjectionMapper.h"

#include "vtkIsosurfaceRayTraceEngine.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkObjectFactory.h"

VTK_ABI_NAMESPACE_BEGIN

vtkStandardNewMacro(vtkCellProjectionMapper);

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSettings vtkCellProjectionMapper::GetSettings() const
{
  vtkIsosurfaceRayTraceSettings settings = this->Superclass::GetSettings();
  settings.HasCloud = true;
  settings.HasSurfaces = this->DrawIsosurfaces;
  settings.IsMaximum = this->BlendMode == MAXIMUM_INTENSITY_BLEND;
  return settings;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceInputSettings vtkCellProjectionMapper::GetInputSettings() const
{
  vtkIsosurfaceRayTraceInputSettings settings = this->Superclass::GetInputSettings();
  settings.TakesComponents = this->BlendMode != MAXIMUM_INTENSITY_BLEND;
  return settings;
}

//------------------------------------------------------------------------------
bool vtkCellProjectionMapper::RenderOwnTiles(vtkVolume* volume, vtkCamera* camera,
  vtkLightCollection* lights, int width, int height,
  const vtkIsosurfaceRayTracing::Sharing& sharing,
  vtkIsosurfaceRayTracing::MessageExchange& exchange,
  vtkIsosurfaceRayTracing::SharingCounts& counts, vtkImageData* output, vtkFloatArray* depths)
{
  return vtkIsosurfaceRayTraceEngine::Of(this)->RenderOwnTiles(
    volume, { camera, lights, width, height, depths, true }, sharing, exchange, counts, output);
}

//------------------------------------------------------------------------------
void vtkCellProjectionMapper::ShallowCopy(vtkAbstractMapper* mapper)
{
  if (auto* other = vtkCellProjectionMapper::SafeDownCast(mapper))
  {
    this->SetDrawIsosurfaces(other->GetDrawIsosurfaces());
  }
  this->Superclass::ShallowCopy(mapper);
}

//------------------------------------------------------------------------------
void vtkCellProjectionMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "DrawIsosurfaces: " << (this->DrawIsosurfaces ? "on" : "off") << "\n";
}

VTK_ABI_NAMESPACE_END
