// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTracePolyhedron.h"

#include "vtkCell.h"
#include "vtkIdList.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"
#include "vtkTetra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

VTK_ABI_NAMESPACE_BEGIN

namespace
{

std::array<double, 3> FindMean(vtkPoints* points)
{
  std::array<double, 3> mean = { 0.0, 0.0, 0.0 };
  const vtkIdType count = points->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      mean[axis] += points->GetPoint(i)[axis] / static_cast<double>(count);
    }
  }
  return mean;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTracePolyhedron::vtkIsosurfaceRayTracePolyhedron() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTracePolyhedron::~vtkIsosurfaceRayTracePolyhedron() = default;

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTracePolyhedron::Divide(vtkCell* cell, vtkIdList* ids)
{
  this->Triangles.clear();
  std::array<double, 3> center = FindMean(cell->GetPoints());
  for (int i = 0; i < cell->GetNumberOfFaces(); ++i)
  {
    this->CopyFace(cell->GetFace(i));
    this->CutFace();
    this->AddTriangles(center.data());
  }
  this->TurnTriangles();
  ids->Reset();
  double inside = 0.0;
  double outside = 0.0;
  for (const Triangle& triangle : this->Triangles)
  {
    ids->InsertNextId(Center);
    for (const vtkIdType corner : triangle.Corners)
    {
      ids->InsertNextId(corner);
    }
    (triangle.Volume < 0.0 ? outside : inside) += std::abs(triangle.Volume);
  }
  this->Volume = inside + outside;
  // Points are rounded.
  constexpr double rounding = 1e-6;
  return std::min(inside, outside) <= rounding * this->Volume;
}

//------------------------------------------------------------------------------
/// From the point with the least id on, towards that of its neighbours with the lesser id.
void vtkIsosurfaceRayTracePolyhedron::CopyFace(vtkCell* face)
{
  const vtkIdType* ids = face->GetPointIds()->GetPointer(0);
  const vtkIdType count = face->GetNumberOfPoints();
  const vtkIdType first = std::min_element(ids, ids + count) - ids;
  const bool isReversed = ids[(first + count - 1) % count] < ids[(first + 1) % count];
  this->Face->GetPointIds()->SetNumberOfIds(count);
  this->Face->GetPoints()->SetNumberOfPoints(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType from = (first + (isReversed ? count - i : i)) % count;
    this->Face->GetPointIds()->SetId(i, ids[from]);
    this->Face->GetPoints()->SetPoint(i, face->GetPoints()->GetPoint(from));
  }
}

//------------------------------------------------------------------------------
/// Cuts a face into triangles: from its first point where VTK does not, as where it has no area.
void vtkIsosurfaceRayTracePolyhedron::CutFace()
{
  if (this->Face->EarCutTriangulation(this->Cut) != 0)
  {
    return;
  }
  this->Cut->Reset();
  for (vtkIdType i = 1; i + 1 < this->Face->GetNumberOfPoints(); ++i)
  {
    for (const vtkIdType corner : { vtkIdType(0), i, i + 1 })
    {
      this->Cut->InsertNextId(corner);
    }
  }
}

//------------------------------------------------------------------------------
/// Adds the triangles of a face.
void vtkIsosurfaceRayTracePolyhedron::AddTriangles(double center[3])
{
  for (vtkIdType i = 0; i + 3 <= this->Cut->GetNumberOfIds(); i += 3)
  {
    Triangle& triangle = this->Triangles.emplace_back();
    double points[3][3];
    for (int k = 0; k < 3; ++k)
    {
      const vtkIdType corner = this->Cut->GetId(i + k);
      triangle.Corners[k] = this->Face->GetPointId(static_cast<int>(corner));
      this->Face->GetPoints()->GetPoint(corner, points[k]);
    }
    triangle.Volume = vtkTetra::ComputeVolume(center, points[0], points[1], points[2]);
  }
}

//------------------------------------------------------------------------------
/// Turns triangles the same way as the first one: across an edge in common they run against each
/// other. (Those of faces in files run as they like.)
void vtkIsosurfaceRayTracePolyhedron::TurnTriangles()
{
  std::map<std::pair<vtkIdType, vtkIdType>, std::vector<std::size_t>> ofEdges;
  for (std::size_t i = 0; i < this->Triangles.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      ofEdges[std::minmax(this->Triangles[i].Get(k), this->Triangles[i].Get(k + 1))].push_back(i);
    }
  }
  std::vector<bool> isTurned(this->Triangles.size(), false);
  std::vector<std::size_t> waiting(std::min<std::size_t>(1, this->Triangles.size()), 0);
  while (!waiting.empty())
  {
    const Triangle triangle = this->Triangles[waiting.back()];
    isTurned[waiting.back()] = true;
    waiting.pop_back();
    for (int k = 0; k < 3; ++k)
    {
      for (const std::size_t other : ofEdges[std::minmax(triangle.Get(k), triangle.Get(k + 1))])
      {
        if (!isTurned[other])
        {
          isTurned[other] = true;
          this->Triangles[other].TurnAgainst(triangle.Get(k), triangle.Get(k + 1));
          waiting.push_back(other);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// Turns it if it runs along an edge.
void vtkIsosurfaceRayTracePolyhedron::Triangle::TurnAgainst(vtkIdType first, vtkIdType second)
{
  for (int k = 0; k < 3; ++k)
  {
    if (this->Get(k) == first && this->Get(k + 1) == second)
    {
      std::swap(this->Corners[0], this->Corners[1]);
      this->Volume = -this->Volume;
      return;
    }
  }
}

VTK_ABI_NAMESPACE_END
