// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceScene.h"

#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkCamera.h"
#include "vtkCollectionRange.h"
#include "vtkContourValues.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace vtkIsosurfaceRayTraceScene
{
namespace
{

vtkirt::Light ConvertLight(vtkLight* light, const vtkirt::Matrix4& worldFromLights)
{
  using vtkirt::operator*;
  using vtkirt::operator-;
  vtkirt::Light result;
  vtkirt::Vector3 position;
  vtkirt::Vector3 focus;
  light->GetTransformedPosition(position.data());
  light->GetTransformedFocalPoint(focus.data());
  result.Position = vtkirt::TransformPoint(worldFromLights, position);
  result.Direction =
    vtkirt::Normalized(result.Position - vtkirt::TransformPoint(worldFromLights, focus));
  light->GetDiffuseColor(result.DiffuseColor.data());
  light->GetSpecularColor(result.SpecularColor.data());
  result.DiffuseColor = result.DiffuseColor * light->GetIntensity();
  result.SpecularColor = result.SpecularColor * light->GetIntensity();
  result.Positional = light->GetPositional() != 0;
  result.ConeAngle = light->GetConeAngle();
  result.Exponent = light->GetExponent();
  light->GetAttenuationValues(result.Attenuation.data());
  return result;
}

/// That of the largest number of a matrix.
int FindLargestExponent(const vtkirt::Matrix4& matrix)
{
  double largest = 0.0;
  for (const double number : matrix)
  {
    largest = std::max(largest, std::abs(number));
  }
  return largest > 0.0 && std::isfinite(largest) ? std::ilogb(largest) : 0;
}

vtkirt::Matrix4 ScaleByPowerOfTwo(vtkirt::Matrix4 matrix, int exponent)
{
  for (double& number : matrix)
  {
    number = std::ldexp(number, exponent);
  }
  return matrix;
}

}

//------------------------------------------------------------------------------
int ChooseComponent(vtkVolumeProperty* property, int numberOfComponents)
{
  int chosen = 0;
  for (int component = 1; component < numberOfComponents; ++component)
  {
    if (property->GetComponentWeight(component) > property->GetComponentWeight(chosen))
    {
      chosen = component;
    }
  }
  return chosen;
}

//------------------------------------------------------------------------------
std::vector<vtkirt::Isosurface> GetSurfaces(vtkVolumeProperty* property, int component)
{
  vtkContourValues* contours = property->GetIsoSurfaceValues();
  std::vector<double> isovalues(
    contours->GetValues(), contours->GetValues() + contours->GetNumberOfContours());
  isovalues.erase(std::remove_if(isovalues.begin(), isovalues.end(),
                    [](double isovalue) { return !std::isfinite(isovalue); }),
    isovalues.end());
  std::sort(isovalues.begin(), isovalues.end());
  isovalues.erase(std::unique(isovalues.begin(), isovalues.end()), isovalues.end());
  std::vector<vtkirt::Isosurface> surfaces;
  for (const double isovalue : isovalues)
  {
    const double opacity = property->GetScalarOpacity(component)->GetValue(isovalue);
    if (opacity > 0.0)
    {
      surfaces.push_back({ isovalue, std::min(opacity, 1.0) });
    }
  }
  return surfaces;
}

//------------------------------------------------------------------------------
vtkirt::Material GetMaterial(vtkVolumeProperty* property, int component)
{
  return { property->GetShade(component) != 0, property->GetAmbient(component),
    property->GetDiffuse(component), property->GetSpecular(component),
    property->GetSpecularPower(component) };
}

//------------------------------------------------------------------------------
void AddLights(
  vtkLightCollection* lights, vtkCamera* camera, bool areFollowing, vtkirt::Scene& scene)
{
  // The model transform of a camera moves the props and not the lights.
  vtkirt::Matrix4 worldFromLights = {};
  vtkMatrix4x4::Invert(camera->GetModelTransformMatrix()->GetData(), worldFromLights.data());
  for (vtkLight* light : vtk::Range(lights))
  {
    if (!light->GetSwitch())
    {
      continue;
    }
    vtkNew<vtkLight> own;
    own->DeepCopy(light);
    if (areFollowing && light->LightTypeIsHeadlight())
    {
      own->SetPosition(camera->GetPosition());
      own->SetFocalPoint(camera->GetFocalPoint());
    }
    else if (areFollowing && light->LightTypeIsCameraLight())
    {
      own->SetTransformMatrix(camera->GetCameraLightTransformMatrix());
    }
    scene.Lights.push_back(ConvertLight(own, worldFromLights));
  }
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 GetWorldFromObject(vtkVolume* volume, const vtkirt::Matrix4& physicalFromObject)
{
  vtkirt::Matrix4 worldFromObject;
  vtkMatrix4x4::Multiply4x4(
    volume->GetMatrix()->GetData(), physicalFromObject.data(), worldFromObject.data());
  return worldFromObject;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 GetClipFromWorld(vtkCamera* camera, double aspect)
{
  // This one ignores stereo.
  const double* matrix =
    camera->GetCompositeProjectionTransformMatrix(aspect, -1.0, 1.0)->GetData();
  vtkirt::Matrix4 clipFromWorld;
  std::copy_n(matrix, clipFromWorld.size(), clipFromWorld.data());
  return clipFromWorld;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 GetClipFromWorldOfEye(vtkCamera* camera, double aspect)
{
  vtkirt::Matrix4 clipFromWorld;
  vtkMatrix4x4::Multiply4x4(camera->GetProjectionTransformMatrix(aspect, -1.0, 1.0)->GetData(),
    camera->GetModelViewTransformMatrix()->GetData(), clipFromWorld.data());
  return clipFromWorld;
}

//------------------------------------------------------------------------------
vtkirt::Camera MakeCamera(const vtkirt::Matrix4& clipFromWorld,
  const vtkirt::Matrix4& worldFromObject, double width, double height)
{
  vtkirt::Matrix4 clipFromObject;
  vtkMatrix4x4::Multiply4x4(clipFromWorld.data(), worldFromObject.data(), clipFromObject.data());
  // With the largest number about 1, the determinant of extreme scales neither overflows nor
  // vanishes.
  const int exponent = FindLargestExponent(clipFromObject);
  const vtkirt::Matrix4 scaled = ScaleByPowerOfTwo(clipFromObject, -exponent);
  // Without an inverse, it is left as it is: no ray hits anything then.
  vtkirt::Matrix4 objectFromClip = {};
  if (vtkIsosurfaceRayTraceProblems::IsInvertible(scaled))
  {
    vtkMatrix4x4::Invert(scaled.data(), objectFromClip.data());
    objectFromClip = ScaleByPowerOfTwo(objectFromClip, -exponent);
  }
  return { clipFromObject, objectFromClip, worldFromObject, width, height };
}

//------------------------------------------------------------------------------
vtkirt::PixelRectangle GetPixels(const vtkirt::Camera& camera, const vtkirt::Bounds& bounds)
{
  if (bounds.Lower[0] > bounds.Upper[0])
  {
    return {};
  }
  const double width = std::ceil(camera.GetWidth());
  const double height = std::ceil(camera.GetHeight());
  double low[2] = { width, height };
  double high[2] = { 0.0, 0.0 };
  for (int corner = 0; corner < 8; ++corner)
  {
    double point[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const bool isUpper = (corner >> axis & 1) != 0;
      point[axis] = isUpper ? bounds.Upper[axis] : bounds.Lower[axis];
    }
    double clip[4];
    vtkMatrix4x4::MultiplyPoint(camera.GetClipFromObject().data(), point, clip);
    if (!(clip[3] > 0.0))
    {
      return { 0, 0, static_cast<int>(width), static_cast<int>(height) };
    }
    const double x = 0.5 * (clip[0] / clip[3] + 1.0) * camera.GetWidth();
    const double y = 0.5 * (clip[1] / clip[3] + 1.0) * camera.GetHeight();
    low[0] = std::min(low[0], x);
    low[1] = std::min(low[1], y);
    high[0] = std::max(high[0], x);
    high[1] = std::max(high[1], y);
  }
  // One more pixel than needed, for rounding.
  const int left = static_cast<int>(std::clamp(std::floor(low[0]) - 1.0, 0.0, width));
  const int bottom = static_cast<int>(std::clamp(std::floor(low[1]) - 1.0, 0.0, height));
  const int right = static_cast<int>(std::clamp(std::ceil(high[0]) + 1.0, 0.0, width));
  const int top = static_cast<int>(std::clamp(std::ceil(high[1]) + 1.0, 0.0, height));
  return { left, bottom, std::max(0, right - left), std::max(0, top - bottom) };
}

}

VTK_ABI_NAMESPACE_END
