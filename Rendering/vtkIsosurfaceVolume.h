// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceVolume
 * @brief   a volume whose isosurfaces are opaque geometry when they are opaque
 *
 * VTK draws volumes last: translucent polygons, and render passes that look at the depth of opaque
 * geometry (vtkSSAOPass, vtkEDLShading, shadow maps), come before and do not know of them. This one
 * draws its isosurfaces together with the opaque geometry when every one that its
 * vtkIsosurfaceRayTraceMapper draws is opaque: then translucent polygons lie before or behind them
 * as their depth says, with or without depth peeling. When a surface is translucent, or the mapper
 * is another one, it is a vtkVolume like any other.
 *
 * Each frame asks the mapper (vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces); there is nothing
 * to set.
 *
 * Smooth edges (vtkIsosurfaceRayTraceMapper::SetImageSampleDistance below 1,
 * ProgressiveAccumulation) are mixed with what is drawn already. VTK draws props in the order in
 * which they were added: add this volume after the polygons that it is seen before.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkVolume
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
