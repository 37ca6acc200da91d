// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceHints.h"

#include "vtkIsosurfaceRayTraceClouds.h"
#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceRequest.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkVolumeProperty.h"

#include "Math/Matrix.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

using Request = vtkIsosurfaceRayTraceRequest;

std::string FindInIsovalues(const Request::Volume& volume)
{
  double range[2];
  if (volume.GetField().MayHit() || !volume.Input->FindScalarRange(range) ||
    std::any_of(volume.Isovalues.begin(), volume.Isovalues.end(),
      [&range](double isovalue) { return range[0] < isovalue && isovalue <= range[1]; }))
  {
    return "";
  }
  std::ostringstream hint;
  hint << "There is no surface: ";
  if (range[0] < range[1])
  {
    hint << "the scalars of the input are from " << range[0] << " to " << range[1]
         << ". Set an isovalue between them (vtkVolumeProperty::GetIsoSurfaceValues()).";
  }
  else if (range[0] == range[1])
  {
    // Not -0.
    hint << "all scalars of the input are " << range[0] + 0.0
         << ". Show data, or a component, that vary.";
  }
  else
  {
    hint << "no scalar of the input is a number (all are NaN).";
  }
  return hint.str();
}

bool AreAllOff(vtkLightCollection* lights)
{
  const auto range = vtk::Range(lights);
  return std::none_of(range.begin(), range.end(),
    [](vtkLight* light) { return light->GetSwitch() && light->GetIntensity() != 0.0; });
}

/// Whether a picture of a volume depends on lights: what is shaded may have ambient light alone.
bool ReflectsLight(const Request::Volume& volume)
{
  const vtkirt::TraceRequest& traced = volume.GetField().GetRequest();
  if (traced.LitComponents > 0)
  {
    const std::vector<vtkirt::CloudMaterial> materials = vtkIsosurfaceRayTraceClouds::MakeMaterials(
      volume.Input->GetCloudComponents(), volume.Property, volume.Component);
    if (std::any_of(materials.begin(), materials.end(),
          [](const vtkirt::CloudMaterial& material)
          { return material.Diffuse != 0.0 || material.Specular != 0.0; }))
    {
      return true;
    }
  }
  const vtkirt::Material material =
    vtkIsosurfaceRayTraceScene::GetMaterial(volume.Property, volume.Component);
  return !traced.Surfaces.empty() && material.Shade &&
    (material.Diffuse != 0.0 || material.Specular != 0.0);
}

std::string FindInLights(const Request& request, vtkLightCollection* lights)
{
  return lights && AreAllOff(lights) &&
      std::any_of(request.Volumes.begin(), request.Volumes.end(), ReflectsLight)
    ? "No light is on: what is shaded has its ambient light alone. Call AddLight() of the "
      "renderer, or ShadeOff() of the property."
    : "";
}

std::string FindInShading(
  const Request& request, const vtkIsosurfaceRayTraceSettings& settings, vtkLightCollection* lights)
{
  const bool isOccluded = settings.NumberOfAmbientOcclusionRays > 0;
  const auto isShaded = [](const Request::Volume& volume)
  { return volume.Property->GetShade(volume.Component) != 0; };
  const auto hasAmbient = [](const Request::Volume& volume)
  { return volume.Property->GetAmbient(volume.Component) != 0.0; };
  if ((settings.Shadows || isOccluded) &&
    std::none_of(request.Volumes.begin(), request.Volumes.end(), isShaded))
  {
    return "Shadows and ambient occlusion darken shaded surfaces alone: call ShadeOn() of the "
           "property.";
  }
  if (isOccluded && std::none_of(request.Volumes.begin(), request.Volumes.end(), hasAmbient))
  {
    return "Ambient occlusion darkens ambient light alone, and the property has none: call "
           "SetAmbient(0.5).";
  }
  // Occluded ambient light may be all that is meant.
  return isOccluded ? "" : FindInLights(request, lights);
}

std::string FindInCloud(const Request& request)
{
  const bool haveNone = std::none_of(request.Volumes.begin(), request.Volumes.end(),
    [](const Request::Volume& volume) { return volume.Input->MayHaveCloud(); });
  return haveNone
    ? "There is no cloud: images, rectilinear grids and AMR data have none. Make meshes of them "
      "with vtkAppendFilter, or draw them with a mapper for images, such as vtkSmartVolumeMapper."
    : "";
}

/// Whether a box in the object space of a volume is all on one side of what a camera sees.
bool IsOutside(const vtkirt::Bounds& box, const vtkirt::Matrix4& clipFromObject)
{
  bool areBelow[3] = { true, true, true };
  bool areAbove[3] = { true, true, true };
  for (std::size_t corner = 0; corner < 8; ++corner)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = (corner >> axis & 1 ? box.Upper : box.Lower)[axis];
    }
    double clip[4];
    for (std::size_t row = 0; row < 4; ++row)
    {
      const double* numbers = &clipFromObject[4 * row];
      clip[row] = numbers[0] * point[0] + numbers[1] * point[1] + numbers[2] * point[2] +
        numbers[3] * point[3];
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      areBelow[axis] = areBelow[axis] && clip[axis] < -clip[3];
      areAbove[axis] = areAbove[axis] && clip[axis] > clip[3];
    }
  }
  const auto isTrue = [](bool value) { return value; };
  return std::any_of(areBelow, areBelow + 3, isTrue) || std::any_of(areAbove, areAbove + 3, isTrue);
}

}

namespace vtkIsosurfaceRayTraceHints
{

//------------------------------------------------------------------------------
std::string FindInRequest(
  const Request& request, const vtkIsosurfaceRayTraceSettings& settings, vtkLightCollection* lights)
{
  if (settings.HasCloud)
  {
    const std::string hint = FindInCloud(request);
    return hint.empty() ? FindInLights(request, lights) : hint;
  }
  if (request.IsProjection() || request.IsNothing())
  {
    return "";
  }
  const std::string ofFirst = FindInIsovalues(request.Volumes.front());
  const bool areAllEmpty = !ofFirst.empty() &&
    std::all_of(request.Volumes.begin(), request.Volumes.end(),
      [](const Request::Volume& volume) { return !FindInIsovalues(volume).empty(); });
  if (areAllEmpty)
  {
    return ofFirst;
  }
  return FindInShading(request, settings, lights);
}

//------------------------------------------------------------------------------
std::string FindInView(const Request& request, const vtkirt::Matrix4& clipFromWorld)
{
  const bool areAllOutside = std::all_of(request.Volumes.begin(), request.Volumes.end(),
    [&clipFromWorld](const Request::Volume& volume)
    {
      return IsOutside(
        volume.GetField().GetBounds(), vtkirt::Multiply(clipFromWorld, volume.WorldFromObject));
    });
  return areAllOutside
    ? "The camera sees nothing of the input, or its clipping range ends before it. Place it with "
      "vtkRenderer::ResetCamera(bounds), which needs no window, where the bounds are those of the "
      "volume."
    : "";
}

}

VTK_ABI_NAMESPACE_END
