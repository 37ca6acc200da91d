// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkIsosurfaceRayTraceClouds.h"
#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkCollectionRange.h"
#include "vtkContourValues.h"
#include "vtkMatrix4x4.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

#include <algorithm>
#include <utility>

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
vtkVolumeProperty* vtkIsosurfaceRayTraceRequest::DrawnVolumes::GetProperty(int connection) const
{
  vtkVolume* own = this->OfConnections[static_cast<std::size_t>(connection)];
  return own ? own->GetProperty() : this->Drawn->GetProperty();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRequest::DrawnVolumes::IsVisible(int connection) const
{
  vtkVolume* own = this->OfConnections[static_cast<std::size_t>(connection)];
  return !own || own->GetVisibility() != 0;
}

//------------------------------------------------------------------------------
vtkirt::Matrix4 vtkIsosurfaceRayTraceRequest::DrawnVolumes::FindWorldFromData(int connection) const
{
  vtkVolume* own = this->OfConnections[static_cast<std::size_t>(connection)];
  vtkirt::Matrix4 matrix;
  std::copy_n(this->Drawn->GetMatrix()->GetData(), 16, matrix.begin());
  if (own)
  {
    // It is not in a renderer, which would do so.
    own->ComputeMatrix();
    vtkMatrix4x4::Multiply4x4(
      this->Drawn->GetMatrix()->GetData(), own->GetMatrix()->GetData(), matrix.data());
  }
  return matrix;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceRequest::vtkIsosurfaceRayTraceRequest(
  const vtkIsosurfaceRayTraceSettings& settings, vtkIsosurfaceRayTraceInputs& inputs,
  const DrawnVolumes& volumes, vtkPlaneCollection* clippingPlanes)
  : Inputs(inputs)
  , Budget{ settings.MaximumMemory }
{
  this->Execution.Threads = settings.NumberOfThreads;
  for (int connection = 0; connection < inputs.GetNumber(); ++connection)
  {
    vtkIsosurfaceRayTraceInput& input = inputs.Get(connection);
    this->Objects.push_back(input.GetObjects());
    Volume volume{};
    volume.Input = &input;
    volume.Property = volumes.GetProperty(connection);
    volume.Component = input.GetPropertyComponent();
    vtkContourValues* isovalues = volume.Property->GetIsoSurfaceValues();
    for (int i = 0; i < isovalues->GetNumberOfContours(); ++i)
    {
      volume.Isovalues.push_back(isovalues->GetValue(i));
    }
    vtkMatrix4x4::Multiply4x4(volumes.FindWorldFromData(connection).data(),
      input.GetPhysicalFromObject().data(), volume.WorldFromObject.data());
    input.GetField()->Select(volumes.IsVisible(connection)
        ? this->MakeTraceRequest(settings, volume, clippingPlanes)
        : vtkirt::TraceRequest{},
      this->Execution, this->Budget);
    this->Volumes.push_back(std::move(volume));
  }
}

//------------------------------------------------------------------------------
/// What the field of an input traces, if it is visible.
vtkirt::TraceRequest vtkIsosurfaceRayTraceRequest::MakeTraceRequest(
  const vtkIsosurfaceRayTraceSettings& settings, const Volume& volume,
  vtkPlaneCollection* clippingPlanes) const
{
  vtkirt::TraceRequest request;
  request.Projection = settings.Projection;
  request.HasCloud = settings.HasCloud;
  if (settings.HasCloud && !settings.IsMaximum)
  {
    request.LitComponents = vtkIsosurfaceRayTraceClouds::FindLitComponents(
      volume.Input->GetCloudComponents(), volume.Property, volume.Component);
  }
  if (!settings.Projection && settings.HasSurfaces)
  {
    request.Surfaces = vtkIsosurfaceRayTraceScene::GetSurfaces(volume.Property, volume.Component);
    volume.Input->SetOpacities(request);
  }
  request.Interpolation = settings.InterpolationMode;
  request.Solver = settings.RootSolver;
  request.Interpolations = settings.NumberOfInterpolations;
  request.Normals = settings.NormalMode;
  request.Visible = volume.Input->FindVisible();
  if (clippingPlanes)
  {
    for (vtkPlane* plane : vtk::Range(clippingPlanes))
    {
      request.Visible.HalfSpaces.push_back(ToObjectSpace(plane, volume.WorldFromObject));
      request.Visible.HalfSpaces.back().IsCapped = settings.CapClippingPlanes;
    }
  }
  return request;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceRequest::SelectAgain() const
{
  for (const Volume& volume : this->Volumes)
  {
    vtkirt::TracedField& field = *volume.Input->GetField();
    const vtkirt::TraceRequest request = field.GetRequest();
    field.Select(request, this->Execution, this->Budget);
  }
}

//------------------------------------------------------------------------------
int vtkIsosurfaceRayTraceRequest::Volume::FindIsovalue(double isovalue) const
{
  const auto found = std::find(this->Isovalues.begin(), this->Isovalues.end(), isovalue);
  return found == this->Isovalues.end() ? -1 : static_cast<int>(found - this->Isovalues.begin());
}

//------------------------------------------------------------------------------
const vtkirt::TracedField& vtkIsosurfaceRayTraceRequest::Volume::GetField() const
{
  return *this->Input->GetField();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRequest::IsProjection() const
{
  return std::any_of(this->Volumes.begin(), this->Volumes.end(),
    [](const Volume& volume) { return volume.GetField().GetRequest().Projection.has_value(); });
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceRequest::IsNothing() const
{
  return std::all_of(this->Volumes.begin(), this->Volumes.end(),
    [](const Volume& volume) { return volume.GetField().GetRequest().IsNothing(); });
}

VTK_ABI_NAMESPACE_END
