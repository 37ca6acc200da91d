// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceHits.h"

#include "vtkIsosurfaceRayTraceInputs.h"
#include "vtkIsosurfaceRayTraceRequest.h"

#include "vtkCamera.h"
#include "vtkGenericCell.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include "Math/Matrix.h"
#include "Picture/CastRays.h"

#include <algorithm>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceHits::vtkIsosurfaceRayTraceHits(const vtkIsosurfaceRayTraceRequest& request)
  : Request(request)
{
  for (const vtkIsosurfaceRayTraceRequest::Volume& volume : request.Volumes)
  {
    this->WorldFromGradient.push_back(vtkirt::NormalMatrix(volume.WorldFromObject));
  }
}

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
vtkIsosurfaceRayTraceHits::Description vtkIsosurfaceRayTraceHits::Describe(
  const vtkirt::Hit& hit) const
{
  Batch batch;
  batch.Add(0, hit);
  Description description;
  this->Describe(batch, &description);
  vtkNew<vtkGenericCell> any;
  this->MoveToWholeCell(hit, any, description.Parametric);
  return description;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceHits::MoveToWholeCell(
  const vtkirt::Hit& hit, vtkGenericCell* any, vtkirt::Vector3& parametric) const
{
  this->Request.Inputs.Get(hit.Field).MoveToWholeCell(hit, any, parametric);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceHits::Describe(const Batch& batch, Description* descriptions) const
{
  using vtkirt::operator*;
  const vtkIsosurfaceRayTraceRequest::Volume& volume = this->Request.GetVolume(batch.Hits[0]);
  const vtkirt::Matrix4& worldFromGradient =
    this->WorldFromGradient[static_cast<std::size_t>(batch.Hits[0].Field)];
  const vtkirt::TracedField& field = volume.GetField();
  alignas(64) double points[3][Batch::Capacity];
  alignas(64) double gradients[3][Batch::Capacity];
  field.GetPointsAndGradients(
    batch.Hits, static_cast<int>(batch.Count), field.GetRequest().Normals, points, gradients);
  for (std::size_t i = 0; i < batch.Count; ++i)
  {
    Description& description = descriptions[i];
    description.CellId = this->Request.Inputs.FindCell(batch.Hits[i], description.Parametric);
    description.Position =
      vtkirt::TransformPoint(volume.WorldFromObject, { points[0][i], points[1][i], points[2][i] });
    const vtkirt::Vector3 gradient = vtkirt::TransformDirection(
      worldFromGradient, { gradients[0][i], gradients[1][i], gradients[2][i] });
    description.Normal = vtkirt::Normalized(gradient) * -1.0;
    description.Value = field.GetValue(batch.Hits[i]);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceHits::GetGeometry(const std::vector<vtkirt::Hit>& hits, vtkCamera* camera,
  int threads, std::vector<float>& positions, std::vector<float>& normals) const
{
  vtkirt::Matrix4 viewFromWorld;
  std::copy_n(
    camera->GetModelViewTransformMatrix()->GetData(), viewFromWorld.size(), viewFromWorld.data());
  const vtkirt::Matrix4 viewFromNormal = vtkirt::NormalMatrix(viewFromWorld);
  positions.assign(3 * hits.size(), 0.0F);
  normals.assign(3 * hits.size(), 0.0F);
  ForEachShare(hits.size(), threads,
    [&](std::size_t begin, std::size_t count)
    {
      this->DescribeEach(&hits[begin], count,
        [&](std::size_t i, const Description& hit)
        {
          using vtkirt::operator*;
          const vtkirt::Vector3 position = vtkirt::TransformPoint(viewFromWorld, hit.Position);
          vtkirt::Vector3 normal =
            vtkirt::Normalized(vtkirt::TransformDirection(viewFromNormal, hit.Normal));
          // As for polygons: towards the viewer, on the side of positive z.
          normal = normal[2] < 0.0 ? normal * -1.0 : normal;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            positions[3 * (begin + i) + axis] = static_cast<float>(position[axis]);
            normals[3 * (begin + i) + axis] = static_cast<float>(normal[axis]);
          }
        });
    });
}

VTK_ABI_NAMESPACE_END
