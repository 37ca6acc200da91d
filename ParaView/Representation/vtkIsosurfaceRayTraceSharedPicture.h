// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The picture of the pieces of all processes, composited pixel by pixel, which process 0 shows. It
// has the bounds of the whole: ParaView composites nothing outside of the bounds of props.

#ifndef vtkIsosurfaceRayTraceSharedPicture_h
#define vtkIsosurfaceRayTraceSharedPicture_h

#include "vtkBoundingBox.h" // for ivars
#include "vtkIsosurfacePicture.h"
#include "vtkIsosurfaceRayTraceSceneDepths.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"    // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                           // for ivars

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTraceCompositor;
class vtkRenderer;
class vtkVolume;

class vtkIsosurfaceRayTraceSharedPicture : public vtkIsosurfacePicture
{
public:
  static vtkIsosurfaceRayTraceSharedPicture* New();
  vtkTypeMacro(vtkIsosurfaceRayTraceSharedPicture, vtkIsosurfacePicture);

  /// The bounds of the pieces of all processes.
  void SetBounds(const vtkBoundingBox& bounds);
  double* GetBounds() override;

  /// Makes the picture for the camera that the renderer of process 0 has now, before and behind the
  /// opaque geometry of the renderers of all processes. To be called by all processes, whether they
  /// have data or not, while the renderers begin a frame. The picture is smaller than the viewport
  /// by the factor of reduction, for which IceT uses the lower left part of the viewport. A ray is
  /// traced for each square of the given side, in pixels, if that is more than one.
  void Make(vtkVolume* volume, vtkRenderer* renderer, int reduction, double distance);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderVolumetricGeometry(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  vtkIsosurfaceRayTraceSharedPicture();
  ~vtkIsosurfaceRayTraceSharedPicture() override;

private:
  vtkIsosurfaceRayTraceSharedPicture(const vtkIsosurfaceRayTraceSharedPicture&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSharedPicture&) = delete;

  vtkNew<vtkIsosurfaceRayTraceCompositor> Compositor;
  vtkIsosurfaceRayTraceSceneDepths Depths;
  vtkNew<vtkImageData> Image;
  double Bounds[6];
  int Size[2] = { 0, 0 }; // in pixels of the viewport
};

VTK_ABI_NAMESPACE_END

#endif
