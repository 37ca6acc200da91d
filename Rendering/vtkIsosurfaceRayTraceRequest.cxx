// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkCollectionRange.h"
#include "vtkContourValues.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// The half-space that a clipping plane leaves.
vtkirt::HalfSpace ToObjectSpace(vtkPlane* plane, const vtkirt::Matrix4& worldFromObject)
{
  using vtkirt::operator-;
  vtkirt::Vector3 normal;
  vtkirt::Vector3 origin;
  plane->GetNormal(normal.data());
  plane->GetOrigin(origin.data());
  // Differences first: no digits are lost in a volume far from the origin of the world.
  const vtkirt::Vector3 first = vtkirt::TransformPoint(worldFromObject, { 0.0, 0.0, 0.0 });
  return { vtkirt::TransposeTransformDirection(worldFromObject, normal),
    vtkirt::Dot(normal, first - origin) };
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceRequest::FindProblem(const vtkIsosurfaceRayTraceSettings& settings)
{
  if (settings.BlendMode != vtkVolumeMapper::ISOSURFACE_BLEND && !settings.Projection)
  {
    return "This mapper does not support the blend mode. Call SetBlendModeToIsoSurface(), "
           "SetBlendModeToMaximumIntensity() or SetBlendModeToMinimumIntensity(), or use another "
           "volume mapper.";
  }
  if (settings.Projection && settings.InterpolationMode == vtkirt::Interpolant::Tricubic)
  {
    return "Intensity projections require the trilinear interpolant. Call "
           "SetInterpolationModeToTrilinear(), or SetBlendModeToIsoSurface().";
  }
  return "";
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRequest::vtkIsosurfaceRayTraceRequest(
  const vtkIsosurfaceRayTraceSettings& settings, const vtkIsosurfaceRayTraceInput& input,
  vtkVolume* volume, vtkPlaneCollection* clippingPlanes)
  : Input(input)
  , Property(volume->GetProperty())
  , Component(input.GetPropertyComponent())
  , WorldFromObject(
      vtkIsosurfaceRayTraceScene::GetWorldFromObject(volume, input.GetPhysicalFromObject()))
{
  for (vtkObject* object : input.GetObjects())
  {
    this->Objects.emplace_back(object);
  }
  this->Objects.emplace_back(this->Property);
  vtkContourValues* isovalues = this->Property->GetIsoSurfaceValues();
  for (int i = 0; i < isovalues->GetNumberOfContours(); ++i)
  {
    this->Isovalues.push_back(isovalues->GetValue(i));
  }
  this->Execution.Threads = settings.NumberOfThreads;
  vtkirt::TraceRequest request;
  request.Projection = settings.Projection;
  if (!settings.Projection)
  {
    request.Surfaces = vtkIsosurfaceRayTraceScene::GetSurfaces(this->Property, this->Component);
  }
  request.Interpolation = settings.InterpolationMode;
  request.Solver = settings.RootSolver;
  request.Interpolations = settings.NumberOfInterpolations;
  request.Normals = settings.NormalMode;
  std::vector<vtkirt::HalfSpace> planes;
  if (clippingPlanes)
  {
    for (vtkPlane* plane : vtk::Range(clippingPlanes))
    {
      planes.push_back(ToObjectSpace(plane, this->WorldFromObject));
      planes.back().IsCapped = settings.CapClippingPlanes;
    }
  }
  request.Visible = input.FindVisible();
  std::vector<vtkirt::HalfSpace>& all = request.Visible.HalfSpaces;
  all.insert(all.end(), planes.begin(), planes.end());
  input.GetField()->Select(request, this->Execution, { settings.MaximumMemory });
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRequest::FindIsovalue(double isovalue) const
{
  const auto found = std::find(this->Isovalues.begin(), this->Isovalues.end(), isovalue);
  return found == this->Isovalues.end() ? -1 : static_cast<int>(found - this->Isovalues.begin());
}

//------------------------------------------------------------------------------
const vtkirt::TraceRequest& vtkIsosurfaceRayTraceRequest::GetTraceRequest() const
{
  return this->Input.GetField()->GetRequest();
}

VTK_ABI_NAMESPACE_END
