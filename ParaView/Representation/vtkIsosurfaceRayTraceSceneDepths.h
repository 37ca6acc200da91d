// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The depths of the opaque geometry that this process has in a renderer, before the frame is drawn:
// it is drawn into a framebuffer of its own.

#ifndef vtkIsosurfaceRayTraceSceneDepths_h
#define vtkIsosurfaceRayTraceSceneDepths_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars
#include "vtkSmartPointer.h"               // for Find

VTK_ABI_NAMESPACE_BEGIN

class vtkFloatArray;
class vtkOpenGLFramebufferObject;
class vtkRenderer;
class vtkWindow;

class vtkIsosurfaceRayTraceSceneDepths
{
public:
  vtkIsosurfaceRayTraceSceneDepths();
  ~vtkIsosurfaceRayTraceSceneDepths();
  vtkIsosurfaceRayTraceSceneDepths(const vtkIsosurfaceRayTraceSceneDepths&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSceneDepths&) = delete;

  /// Those of a picture of so many pixels for the camera of the renderer, in rows from the bottom;
  /// null where there is no such geometry. Pictures of isosurfaces (vtkIsosurfacePicture) do not
  /// count. To be called while the renderer begins a frame: its window is current then.
  vtkSmartPointer<vtkFloatArray> Find(vtkRenderer* renderer, int width, int height);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
};

VTK_ABI_NAMESPACE_END

#endif
