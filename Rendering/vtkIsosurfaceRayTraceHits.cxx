// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceHits.h"

#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"

#include "Math/Matrix.h"
#include "Picture/CastRays.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkirt::RayHits vtkIsosurfaceRayTraceHits::Cast(const std::vector<vtkirt::Vector3>& origins,
  const std::vector<vtkirt::Vector3>& directions, double tEnd, int threads) const
{
  std::vector<vtkirt::TracedField*> fields;
  std::vector<std::vector<vtkirt::CastRay>> rays;
  for (const vtkIsosurfaceRayTraceRequest::Volume& volume : this->Request.Volumes)
  {
    const vtkirt::Matrix4& worldFromObject = volume.WorldFromObject;
    vtkirt::Matrix4 objectFromWorld = {};
    vtkMatrix4x4::Invert(worldFromObject.data(), objectFromWorld.data());
    // Differences first: no digits are lost in a volume far from the origin of the world.
    const vtkirt::Vector3 first = vtkirt::TransformPoint(worldFromObject, { 0.0, 0.0, 0.0 });
    fields.push_back(volume.Input->GetField());
    rays.emplace_back(origins.size());
    for (std::size_t i = 0; i < origins.size(); ++i)
    {
      using vtkirt::operator-;
      rays.back()[i] = { vtkirt::TransformDirection(objectFromWorld, origins[i] - first),
        vtkirt::TransformDirection(objectFromWorld, directions[i]), 0.0, tEnd };
    }
  }
  return vtkirt::CastRays(fields, rays, threads);
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceHits::GetPosition(const vtkirt::Hit& hit) const
{
  const vtkIsosurfaceRayTraceRequest::Volume& volume = this->Request.GetVolume(hit);
  return vtkirt::TransformPoint(volume.WorldFromObject, volume.GetField().GetPoint(hit));
}

//------------------------------------------------------------------------------
vtkirt::Vector3 vtkIsosurfaceRayTraceHits::GetNormal(const vtkirt::Hit& hit) const
{
  using vtkirt::operator*;
  const vtkIsosurfaceRayTraceRequest::Volume& volume = this->Request.GetVolume(hit);
  const vtkirt::TracedField& field = volume.GetField();
  const vtkirt::Vector3 gradient = field.GetGradient(hit, field.GetRequest().Normals);
  return vtkirt::Normalized(vtkirt::GradientToWorld(volume.WorldFromObject, gradient)) * -1.0;
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceHits::Description vtkIsosurfaceRayTraceHits::Describe(
  const vtkirt::Hit& hit) const
{
  Description description;
  description.CellId = this->Request.Inputs.FindCell(hit, description.Parametric);
  description.Position = this->GetPosition(hit);
  description.Normal = this->GetNormal(hit);
  description.Value = this->Request.GetVolume(hit).GetField().GetValue(hit);
  return description;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceHits::GetGeometry(const std::vector<vtkirt::Hit>& hits, vtkCamera* camera,
  int threads, std::vector<float>& positions, std::vector<float>& normals) const
{
  vtkirt::Matrix4 viewFromWorld;
  std::copy_n(
    camera->GetModelViewTransformMatrix()->GetData(), viewFromWorld.size(), viewFromWorld.data());
  const auto count = static_cast<int>(hits.size());
  positions.assign(3 * hits.size(), 0.0F);
  normals.assign(3 * hits.size(), 0.0F);
#pragma omp parallel for schedule(dynamic, 1024) num_threads(threads)
  for (int i = 0; i < count; ++i)
  {
    const auto pixel = static_cast<std::size_t>(i);
    const vtkirt::Hit& hit = hits[pixel];
    if (hit.Surface == vtkirt::Hit::NoSurface)
    {
      continue;
    }
    using vtkirt::operator*;
    const vtkirt::Vector3 position = vtkirt::TransformPoint(viewFromWorld, this->GetPosition(hit));
    vtkirt::Vector3 normal =
      vtkirt::Normalized(vtkirt::GradientToWorld(viewFromWorld, this->GetNormal(hit)));
    // As for polygons: towards the viewer, on the side of positive z.
    normal = normal[2] < 0.0 ? normal * -1.0 : normal;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      positions[3 * pixel + axis] = static_cast<float>(position[axis]);
      normals[3 * pixel + axis] = static_cast<float>(normal[axis]);
    }
  }
}

VTK_ABI_NAMESPACE_END
