// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceVolume
 * @brief   a volume whose isosurfaces are opaque geometry when they are opaque
 *
 * VTK draws volumes last: translucent polygons, and render passes that read the depth of opaque
 * geometry (vtkSSAOPass, vtkEDLShading, shadow maps), come before and miss them. This volume draws
 * its isosurfaces together with the opaque geometry if all that its vtkIsosurfaceRayTraceMapper
 * draws are opaque: then translucent polygons are in front of or behind them by depth, with or
 * without depth peeling. If a surface is translucent, or the mapper is of another class, it behaves
 * as a vtkVolume.
 *
 * The mapper is queried in each frame (vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces); there
 * is nothing to set.
 *
 * Smooth edges (vtkIsosurfaceRayTraceMapper::SetImageSampleDistance below 1,
 * ProgressiveAccumulation) are blended with what is drawn already. VTK draws props in the order in
 * which they were added: add this volume after the polygons that are behind it.
 *
 * A vtkIsosurfaceRayTraceMeshMapper is treated alike.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceRayTraceMeshMapper vtkVolume
 */

#ifndef vtkIsosurfaceVolume_h
#define vtkIsosurfaceVolume_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkVolume.h"

VTK_ABI_NAMESPACE_BEGIN

class VTKISOSURFACERAYTRACING_EXPORT vtkIsosurfaceVolume : public vtkVolume
{
public:
  static vtkIsosurfaceVolume* New();
  vtkTypeMacro(vtkIsosurfaceVolume, vtkVolume);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Returns whether the volume is drawn with the opaque geometry.
   */
  vtkTypeBool HasOpaqueGeometry() override;

  ///@{
  /**
   * WARNING: INTERNAL METHOD - NOT INTENDED FOR GENERAL USE
   * Draw the volume, in the one of the two that suits its surfaces.
   */
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  ///@}

protected:
  vtkIsosurfaceVolume();
  ~vtkIsosurfaceVolume() override;

private:
  vtkIsosurfaceVolume(const vtkIsosurfaceVolume&) = delete;
  void operator=(const vtkIsosurfaceVolume&) = delete;
};

VTK_ABI_NAMESPACE_END

#endif
