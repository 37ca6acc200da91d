// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Converts VTK's description of a scene to the types of the ray tracer.

#ifndef vtkIsosurfaceRayTraceScene_h
#define vtkIsosurfaceRayTraceScene_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Scene.h"

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkLightCollection;
class vtkVolume;
class vtkVolumeProperty;

namespace vtkIsosurfaceRayTraceScene
{

/// The component whose isosurfaces are drawn, as in VTK's own isosurface blend mode.
int ChooseComponent(vtkVolumeProperty* property, int numberOfComponents);

/// The isovalues of the property whose surfaces are visible at all, in ascending order.
std::vector<vtkIsosurfaceRayTracing::Isosurface> GetSurfaces(
  vtkVolumeProperty* property, int component);

vtkIsosurfaceRayTracing::Material GetMaterial(vtkVolumeProperty* property, int component);

/// Adds the lights that are on. On request, headlights and lights of the camera follow it, as a
/// renderer makes them do before it draws.
void AddLights(vtkLightCollection* lights, vtkCamera* camera, bool areFollowing,
  vtkIsosurfaceRayTracing::Scene& scene);

vtkIsosurfaceRayTracing::Matrix4 GetWorldFromObject(
  vtkVolume* volume, const vtkIsosurfaceRayTracing::Matrix4& physicalFromObject);

/// The view of a camera, for both eyes together, in a picture of an aspect (width over height).
vtkIsosurfaceRayTracing::Matrix4 GetClipFromWorld(vtkCamera* camera, double aspect);

/// The same for the eye that the window of the camera draws now, in stereo.
vtkIsosurfaceRayTracing::Matrix4 GetClipFromWorldOfEye(vtkCamera* camera, double aspect);

vtkIsosurfaceRayTracing::Camera MakeCamera(const vtkIsosurfaceRayTracing::Matrix4& clipFromWorld,
  const vtkIsosurfaceRayTracing::Matrix4& worldFromObject, double width, double height);

/// The pixels that a box covers, if there is one: all, if a part of it is beside or behind the eye.
vtkIsosurfaceRayTracing::PixelRectangle GetPixels(
  const vtkIsosurfaceRayTracing::Camera& camera, const vtkIsosurfaceRayTracing::Bounds& bounds);

}

VTK_ABI_NAMESPACE_END

#endif
