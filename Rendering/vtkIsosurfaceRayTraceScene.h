// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What VTK says of a scene, in the words of the ray tracer.

#ifndef vtkIsosurfaceRayTraceScene_h
#define vtkIsosurfaceRayTraceScene_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Scene.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
class vtkIsosurfaceRayTraceSource;
class vtkLightCollection;
class vtkVolume;
class vtkVolumeMapper;
class vtkVolumeProperty;

namespace vtkIsosurfaceRayTraceScene
{

/// The component whose isosurfaces are drawn, as in VTK's own isosurface blend mode.
int ChooseComponent(vtkVolumeProperty* property, int numberOfComponents);

/// The isovalues of the property whose surfaces can be seen at all, in ascending order.
std::vector<vtkIsosurfaceRayTracing::Isosurface> GetSurfaces(
  vtkVolumeProperty* property, int component);

/// The number of an isovalue among those of the property; -1 if it is not there.
int FindIsovalue(vtkVolumeProperty* property, double isovalue);

vtkIsosurfaceRayTracing::Vector3 GetColor(
  vtkVolumeProperty* property, int component, double isovalue);
vtkIsosurfaceRayTracing::Material GetMaterial(vtkVolumeProperty* property, int component);

/// Adds the lights that are on. If asked to, headlights and lights of the camera follow it, as a
/// renderer makes them do before it draws.
void AddLights(vtkLightCollection* lights, vtkCamera* camera, bool areFollowing,
  vtkIsosurfaceRayTracing::Scene& scene);

vtkIsosurfaceRayTracing::Matrix4 GetWorldFromIndex(
  vtkVolume* volume, const vtkIsosurfaceRayTracing::Matrix4& physicalFromIndex);

/// What a camera shows of the world, for both eyes together, in a picture of an aspect (width over
/// height).
vtkIsosurfaceRayTracing::Matrix4 GetClipFromWorld(vtkCamera* camera, double aspect);

/// The same for the eye that the window of the camera draws now, in stereo.
vtkIsosurfaceRayTracing::Matrix4 GetClipFromWorldOfEye(vtkCamera* camera, double aspect);

vtkIsosurfaceRayTracing::Camera MakeCamera(const vtkIsosurfaceRayTracing::Matrix4& clipFromWorld,
  const vtkIsosurfaceRayTracing::Matrix4& worldFromIndex, double width, double height);

/// The pixels that the box of a volume covers: all, if a part of it is beside or behind the eye.
vtkIsosurfaceRayTracing::PixelRectangle GetPixels(
  const vtkIsosurfaceRayTracing::Camera& camera, const vtkIsosurfaceRayTracing::Index3& dimensions);

/// What is wrong with the cropping of a mapper; empty if nothing is.
std::string FindCroppingProblem(vtkVolumeMapper* mapper);

/// What the clipping planes, with caps or without, and the cropping of a mapper, and blanking,
/// leave of the volume.
vtkIsosurfaceRayTracing::Visibility GetVisibility(vtkVolumeMapper* mapper, bool hasCaps,
  const vtkIsosurfaceRayTraceSource& source,
  const vtkIsosurfaceRayTracing::Matrix4& worldFromIndex);

}

VTK_ABI_NAMESPACE_END

#endif
