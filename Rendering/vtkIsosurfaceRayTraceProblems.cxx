// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceProblems.h"

#include "vtkIsosurfaceRayTraceScene.h"

#include "vtkCollectionRange.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <cmath>
#include <sstream>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace vtkIsosurfaceRayTraceProblems
{
namespace
{

bool AreFinite(const double* numbers, int count)
{
  return std::all_of(numbers, numbers + count, [](double number) { return std::isfinite(number); });
}

bool IsFinite(vtkLight* light)
{
  const double numbers[] = { light->GetIntensity(), light->GetConeAngle(), light->GetExponent() };
  double position[3];
  double focalPoint[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focalPoint);
  return AreFinite(numbers, 3) && AreFinite(position, 3) && AreFinite(focalPoint, 3) &&
    AreFinite(light->GetDiffuseColor(), 3) && AreFinite(light->GetSpecularColor(), 3) &&
    AreFinite(light->GetAttenuationValues(), 3);
}

bool HasPerspective(const double* matrix)
{
  constexpr double affine[] = { 0.0, 0.0, 0.0, 1.0 };
  constexpr double rounding = 1e-12; // of those who made the matrix
  return !std::equal(affine, affine + 4, matrix + 12,
    [](double one, double other) { return std::abs(one - other) <= rounding; });
}

std::string FindInMatrix(vtkVolume* volume, const vtkirt::Matrix4& physicalFromObject)
{
  if (!IsInvertible(vtkIsosurfaceRayTraceScene::GetWorldFromObject(volume, physicalFromObject)))
  {
    return "The matrix of the volume has numbers that are not finite, or no inverse. Give "
           "SetPosition, SetOrigin, SetOrientation, SetScale and SetUserMatrix of the vtkVolume "
           "finite numbers, and a scale other than 0.";
  }
  // VTK's pickers ignore perspective, and so do distances along rays.
  if (HasPerspective(volume->GetMatrix()->GetData()))
  {
    return "The matrix of the volume has a perspective part. Give SetUserMatrix of the vtkVolume a "
           "matrix whose last row is 0 0 0 1.";
  }
  return "";
}

std::string FindInMaterial(vtkVolumeProperty* property, int component)
{
  const vtkirt::Material material = vtkIsosurfaceRayTraceScene::GetMaterial(property, component);
  const double coefficients[] = { material.Ambient, material.Diffuse, material.Specular,
    material.SpecularPower };
  if (!AreFinite(coefficients, 4))
  {
    return "The ambient, diffuse or specular coefficient or the specular power of the volume "
           "property is not finite. Give SetAmbient, SetDiffuse, SetSpecular and SetSpecularPower "
           "finite numbers.";
  }
  return "";
}

std::string FindInGhostArray(vtkUnsignedCharArray* array, vtkIdType tuples, const char* kind)
{
  if (!array || (array->GetNumberOfTuples() == tuples && array->GetNumberOfComponents() == 1))
  {
    return "";
  }
  std::ostringstream problem;
  problem << "The array \"" << vtkDataSetAttributes::GhostArrayName() << "\" of the " << kind
          << " has " << array->GetNumberOfTuples() << " tuples of "
          << array->GetNumberOfComponents() << " components for " << tuples << " " << kind
          << ". Give one tuple of one component for each, or remove the array.";
  return problem.str();
}

}

//------------------------------------------------------------------------------
bool IsInvertible(const vtkirt::Matrix4& matrix)
{
  // A determinant that is subnormal has lost digits, and so has the inverse by it.
  if (!AreFinite(matrix.data(), 16) || !std::isnormal(vtkMatrix4x4::Determinant(matrix.data())))
  {
    return false;
  }
  vtkirt::Matrix4 inverse;
  vtkMatrix4x4::Invert(matrix.data(), inverse.data());
  return AreFinite(inverse.data(), 16);
}

//------------------------------------------------------------------------------
std::string FindInVolume(
  vtkVolume* volume, int component, const vtkirt::Matrix4& physicalFromObject)
{
  const std::string problem = FindInMatrix(volume, physicalFromObject);
  return problem.empty() ? FindInMaterial(volume->GetProperty(), component) : problem;
}

//------------------------------------------------------------------------------
std::string FindInPlanes(vtkPlaneCollection* planes)
{
  if (!planes)
  {
    return "";
  }
  for (vtkPlane* plane : vtk::Range(planes))
  {
    if (!AreFinite(plane->GetNormal(), 3) || !AreFinite(plane->GetOrigin(), 3))
    {
      return "A clipping plane has a normal or an origin that is not finite. Give SetNormal and "
             "SetOrigin of the vtkPlane finite numbers, or call RemoveClippingPlane.";
    }
  }
  return "";
}

//------------------------------------------------------------------------------
std::string FindInView(const vtkirt::Matrix4& clipFromWorld, vtkLightCollection* lights)
{
  if (!IsInvertible(clipFromWorld))
  {
    return "The matrix of the camera has numbers that are not finite, or no inverse. Give the "
           "vtkCamera finite numbers, a focal point apart from its position, a view angle (or "
           "parallel scale) and a clipping range that are not empty, and transforms that have an "
           "inverse; ResetCamera() of the renderer makes a view of the scene.";
  }
  if (!lights)
  {
    return "";
  }
  for (vtkLight* light : vtk::Range(lights))
  {
    if (light->GetSwitch() && !IsFinite(light))
    {
      return "A light has numbers that are not finite. Give the vtkLight finite numbers for its "
             "position, focal point, colors, intensity, attenuation, cone angle and exponent, or "
             "call SwitchOff().";
    }
  }
  return "";
}

//------------------------------------------------------------------------------
std::string FindInGhosts(vtkDataSet* grid)
{
  const std::string problem =
    FindInGhostArray(grid->GetPointGhostArray(), grid->GetNumberOfPoints(), "points");
  return problem.empty()
    ? FindInGhostArray(grid->GetCellGhostArray(), grid->GetNumberOfCells(), "cells")
    : problem;
}

}

VTK_ABI_NAMESPACE_END
