// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfaceVolume
 * @brief   a volume whose isosurfaces are drawn among the polygons of a scene
 *
 * VTK draws volumes last. Translucent polygons, and render passes that read the depth of opaque
 * geometry (vtkSSAOPass, vtkEDLShading, shadow maps), come before them and do not see them. If all
 * isosurfaces that its vtkIsosurfaceRayTraceMapper draws are opaque, this volume draws them
 * together with the opaque geometry: translucent polygons are then in front of or behind them by
 * depth, with or without depth peeling.
 *
 * If some isosurfaces are translucent, and the renderer peels depths (vtkRenderer::UseDepthPeeling)
 * because there are translucent polygons or another such volume, each isosurface is peeled as
 * polygons are: surfaces and polygons are in front of and behind each other by depth. Surfaces are
 * traced once for all peels, with one ray for each pixel, whatever ImageSampleDistance below 1 and
 * ProgressiveAccumulation say. Without a GPU such a frame takes two to three times as long; larger
 * distances between rays, as during interaction, reduce this time only a little. A frame takes 76
 * bytes for each surface at each pixel while it is made, and 20 bytes in textures until the next
 * frame.
 *
 * In all other cases it behaves like a vtkVolume:
 * - where a surface is translucent, without depth peeling, or with render passes of the application
 *   (vtkRenderer::SetPass), UseSSAO or UseShadows
 * - for projections and clouds
 * - with mappers of other classes
 *
 * The mapper is queried in each frame (vtkIsosurfaceRayTraceMapper::HasOnlyOpaqueSurfaces); there
 * is nothing to set.
 *
 * Anti-aliased edges (vtkIsosurfaceRayTraceMapper::SetImageSampleDistance below 1,
 * ProgressiveAccumulation) are blended with what has already been drawn. VTK draws props in the
 * order in which they were added: add this volume after the polygons that are behind it.
 *
 * A vtkIsosurfaceRayTraceMeshMapper is treated in the same way.
 *
 * @sa vtkIsosurfaceRayTraceMapper vtkIsosurfaceRayTraceMeshMapper vtkVolume
 */

#ifndef vtkIsosurfaceVolume_h
#define vtkIsosurfaceVolume_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkIsosurfaceRayTracingModule.h" // for export macro
#include "vtkVolume.h"

#include <memory> // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceFrame;
class vtkIsosurfaceRayTraceLayers;
class vtkRenderer;

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
   * Draw the volume, in the passes that suit its surfaces.
   */
  vtkTypeBool HasTranslucentPolygonalGeometry() override;
  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderTranslucentPolygonalGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  ///@}

protected:
  vtkIsosurfaceVolume();
  ~vtkIsosurfaceVolume() override;

private:
  vtkIsosurfaceVolume(const vtkIsosurfaceVolume&) = delete;
  void operator=(const vtkIsosurfaceVolume&) = delete;

  friend class vtkIsosurfaceRayTraceFrame;

  /// Where the translucent surfaces of a volume are to go, for the renderer to peel them; null if
  /// it does not peel that volume.
  static vtkIsosurfaceRayTraceLayers* FindLayers(vtkVolume* volume, vtkRenderer* renderer);

  /// In the frame that is drawn, if its renderer peels depths.
  bool IsPeeled = false;
  std::unique_ptr<vtkIsosurfaceRayTraceLayers> Layers;
};

VTK_ABI_NAMESPACE_END

#endif
