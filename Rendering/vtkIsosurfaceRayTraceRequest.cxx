// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkIsosurfaceRayTraceInput.h"
#include "vtkIsosurfaceRayTraceScene.h"
#include "vtkIsosurfaceRayTraceSettings.h"

#include "vtkCollectionRange.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"
#include "vtkVolumeProperty.h"

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

/// The half-space that a clipping plane leaves.
vtkirt::HalfSpace ToIndexSpace(vtkPlane* plane, const vtkirt::Matrix4& worldFromIndex)
{
  using vtkirt::operator-;
  vtkirt::Vector3 normal;
  vtkirt::Vector3 origin;
  plane->GetNormal(normal.data());
  plane->GetOrigin(origin.data());
  // Differences first: a volume far from the origin of the world loses nothing.
  const vtkirt::Vector3 first = vtkirt::TransformPoint(worldFromIndex, { 0.0, 0.0, 0.0 });
  return { vtkirt::TransposeTransformDirection(worldFromIndex, normal),
    vtkirt::Dot(normal, first - origin) };
}

}

//------------------------------------------------------------------------------
std::string vtkIsosurfaceRayTraceRequest::FindProblem(
  int blendMode, const vtkIsosurfaceRayTraceSettings& settings)
{
  if (blendMode != vtkVolumeMapper::ISOSURFACE_BLEND && !settings.Projection)
  {
    return "The blend mode is one that this mapper does not have. Call SetBlendModeToIsoSurface(), "
           "SetBlendModeToMaximumIntensity() or SetBlendModeToMinimumIntensity(), or use another "
           "volume mapper.";
  }
  if (settings.Projection && settings.InterpolationMode == vtkirt::Interpolant::Tricubic)
  {
    return "Intensity projections are those of the trilinear interpolant. Call "
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
  , WorldFromIndex(
      vtkIsosurfaceRayTraceScene::GetWorldFromIndex(volume, input.GetPhysicalFromIndex()))
  , NormalMode(settings.NormalMode)
  , Trace(input.MakeTraceRequest())
{
  this->Trace.Projection = settings.Projection;
  if (!settings.Projection)
  {
    this->Trace.Surfaces = vtkIsosurfaceRayTraceScene::GetSurfaces(this->Property, this->Component);
  }
  this->Trace.Field = settings.InterpolationMode;
  this->Trace.Solver = settings.RootSolver;
  this->Trace.Interpolations = settings.NumberOfInterpolations;
  this->Trace.MaximumMemory = settings.MaximumMemory;
  if (clippingPlanes)
  {
    for (vtkPlane* plane : vtk::Range(clippingPlanes))
    {
      this->Trace.Visible.HalfSpaces.push_back(ToIndexSpace(plane, this->WorldFromIndex));
      this->Trace.Visible.HalfSpaces.back().IsCapped = settings.CapClippingPlanes;
    }
  }
}

VTK_ABI_NAMESPACE_END
