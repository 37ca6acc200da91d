// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonRays.h"

#include "vtkIsosurfaceComparisonMethods.h"
#include "vtkIsosurfaceComparisonRow.h"

#include "vtkCamera.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkGenericCell.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStaticCellLocator.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>

namespace vtkIsosurfaceComparison
{
namespace
{

//------------------------------------------------------------------------------
void Unproject(vtkMatrix4x4* worldFromClip, double x, double y, double z, double point[3])
{
  const double clip[4] = { x, y, z, 1.0 };
  double world[4];
  worldFromClip->MultiplyPoint(clip, world);
  for (int i = 0; i < 3; ++i)
  {
    point[i] = world[i] / world[3];
  }
}

}

//------------------------------------------------------------------------------
void LookAt(vtkDataSet* data, vtkCamera* camera)
{
  const double direction[3] = { -0.35, 1.0, 0.15 };
  double center[3];
  data->GetCenter(center);
  const double radius = std::max(0.5 * data->GetLength(), VTK_DBL_MIN);
  camera->SetViewAngle(30.0);
  const double distance = radius / std::sin(vtkMath::RadiansFromDegrees(15.0));
  const double scale = distance / vtkMath::Norm(direction);
  camera->SetFocalPoint(center);
  camera->SetPosition(center[0] + scale * direction[0], center[1] + scale * direction[1],
    center[2] + scale * direction[2]);
  camera->SetViewUp(0.0, 0.0, 1.0);
  // The sphere around the box leaves much of the picture empty.
  camera->Zoom(1.4);
  camera->SetParallelScale(radius / 1.4);
  IncludeWhole(data, camera);
}

//------------------------------------------------------------------------------
void IncludeWhole(vtkDataSet* data, vtkCamera* camera)
{
  double eye[3];
  double direction[3];
  const double* bounds = data->GetBounds();
  camera->GetPosition(eye);
  camera->GetDirectionOfProjection(direction);
  double nearest = VTK_DOUBLE_MAX;
  double farthest = VTK_DOUBLE_MIN;
  for (int corner = 0; corner < 8; ++corner)
  {
    const double toCorner[3] = { bounds[corner & 1] - eye[0],
      bounds[2 + (corner >> 1 & 1)] - eye[1], bounds[4 + (corner >> 2)] - eye[2] };
    const double depth = vtkMath::Dot(toCorner, direction);
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  // Nearer than this, a depth buffer of 24 bits loses too much; and an eye may be in the volume.
  constexpr double smallestRatio = 1e-3;
  const double margin = 1e-3 * (farthest - nearest);
  const double end = std::max(farthest + margin, VTK_DBL_MIN);
  camera->SetClippingRange(std::max(nearest - margin, smallestRatio * end), end);
}

//------------------------------------------------------------------------------
PictureRays::PictureRays(vtkCamera* camera, int width, int height)
  : Width(width)
  , Height(height)
{
  vtkNew<vtkMatrix4x4> worldFromClip;
  worldFromClip->DeepCopy(
    camera->GetCompositeProjectionTransformMatrix(static_cast<double>(width) / height, -1.0, 1.0));
  worldFromClip->Invert();
  const vtkIdType count = static_cast<vtkIdType>(width) * height;
  this->Origins->SetDataTypeToDouble();
  this->Origins->SetNumberOfPoints(count);
  this->Directions->SetNumberOfComponents(3);
  this->Directions->SetNumberOfTuples(count);
  for (vtkIdType pixel = 0; pixel < count; ++pixel)
  {
    const double x = 2.0 * (static_cast<double>(pixel % width) + 0.5) / width - 1.0;
    const double y = 2.0 * (static_cast<double>(pixel / width) + 0.5) / height - 1.0;
    double begin[3];
    double end[3];
    Unproject(worldFromClip, x, y, -1.0, begin);
    Unproject(worldFromClip, x, y, 1.0, end);
    this->Origins->SetPoint(pixel, begin);
    this->Directions->SetTuple3(pixel, end[0] - begin[0], end[1] - begin[1], end[2] - begin[2]);
  }
}

//------------------------------------------------------------------------------
bool PictureRays::FindHits(TracedIsosurface& isosurface, vtkPolyData* hits) const
{
  isosurface.UseExactNormals();
  return isosurface.CastRays(this->Origins, this->Directions, hits);
}

//------------------------------------------------------------------------------
void PictureRays::CastInPortions(TracedIsosurface& isosurface) const
{
  constexpr vtkIdType portion = 4096;
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  vtkNew<vtkPolyData> hits;
  const vtkIdType count = this->Origins->GetNumberOfPoints();
  for (vtkIdType first = 0; first < count; first += portion)
  {
    const vtkIdType size = std::min(portion, count - first);
    origins->SetNumberOfPoints(size);
    origins->InsertPoints(0, size, first, this->Origins);
    directions->SetNumberOfTuples(size);
    directions->InsertTuples(0, size, first, this->Directions);
    isosurface.CastRays(origins, directions, hits);
  }
}

//------------------------------------------------------------------------------
std::vector<double> PictureRays::CastAt(TracedIsosurface& isosurface) const
{
  vtkNew<vtkPolyData> hits;
  std::vector<double> ts(static_cast<std::size_t>(this->Origins->GetNumberOfPoints()), NotMeasured);
  if (!this->FindHits(isosurface, hits))
  {
    return ts;
  }
  auto* rays = vtkIdTypeArray::SafeDownCast(hits->GetPointData()->GetArray("RayId"));
  vtkDataArray* hitTs = hits->GetPointData()->GetArray("T");
  for (vtkIdType hit = 0; hit < hits->GetNumberOfPoints(); ++hit)
  {
    const double t = hitTs->GetComponent(hit, 0);
    if (t <= 1.0)
    {
      ts[static_cast<std::size_t>(rays->GetValue(hit))] = t;
    }
  }
  return ts;
}

//------------------------------------------------------------------------------
std::vector<double> PictureRays::CastAt(vtkPolyData* triangles) const
{
  const vtkIdType count = this->Origins->GetNumberOfPoints();
  std::vector<double> ts(static_cast<std::size_t>(count), NotMeasured);
  if (triangles->GetNumberOfPolys() == 0)
  {
    return ts;
  }
  // vtkPolyData makes its cells at their first use, which must not be on several threads.
  if (triangles->NeedToBuildCells())
  {
    triangles->BuildCells();
  }
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(triangles);
  locator->BuildLocator();
  // A ray through an edge of two triangles must not slip through by rounding.
  const double tolerance = 1e-9 * triangles->GetLength();
  vtkSMPTools::For(0, count,
    [this, &locator, &ts, tolerance](vtkIdType first, vtkIdType last)
    {
      vtkNew<vtkGenericCell> triangle;
      for (vtkIdType ray = first; ray < last; ++ray)
      {
        double from[3];
        double to[3];
        this->Origins->GetPoint(ray, from);
        this->Directions->GetTuple(ray, to);
        vtkMath::Add(from, to, to);
        double t;
        double x[3];
        double pcoords[3];
        int subId;
        vtkIdType cell;
        if (locator->IntersectWithLine(from, to, tolerance, t, x, pcoords, subId, cell, triangle))
        {
          ts[static_cast<std::size_t>(ray)] = t;
        }
      }
    });
  return ts;
}

//------------------------------------------------------------------------------
std::vector<double> PictureRays::GetLengths() const
{
  std::vector<double> lengths;
  for (vtkIdType ray = 0; ray < this->Directions->GetNumberOfTuples(); ++ray)
  {
    double direction[3];
    this->Directions->GetTuple(ray, direction);
    lengths.push_back(vtkMath::Norm(direction));
  }
  return lengths;
}

//------------------------------------------------------------------------------
void WriteDifference(const PictureRays& rays, const std::vector<double>& isosurface,
  const std::vector<double>& mesh, vtkImageData* image)
{
  image->SetDimensions(rays.GetWidth(), rays.GetHeight(), 1);
  vtkNew<vtkDoubleArray> differences;
  differences->SetName("DepthDifference");
  vtkNew<vtkUnsignedCharArray> coverage;
  coverage->SetName("Coverage");
  const std::vector<double> lengths = rays.GetLengths();
  for (std::size_t i = 0; i < lengths.size(); ++i)
  {
    differences->InsertNextValue((mesh[i] - isosurface[i]) * lengths[i]);
    const bool seesIsosurface = !std::isnan(isosurface[i]);
    const bool seesMesh = !std::isnan(mesh[i]);
    coverage->InsertNextValue(
      seesIsosurface ? (seesMesh ? Both : IsosurfaceAlone) : (seesMesh ? MeshAlone : Neither));
  }
  image->GetPointData()->SetScalars(differences);
  image->GetPointData()->AddArray(coverage);
}

//------------------------------------------------------------------------------
double CountPixelsAlone(const std::vector<double>& first, const std::vector<double>& second)
{
  double count = 0.0;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    count += !std::isnan(first[i]) && std::isnan(second[i]) ? 1.0 : 0.0;
  }
  return count;
}

//------------------------------------------------------------------------------
double CountCoveredPixels(const std::vector<double>& isosurface)
{
  return static_cast<double>(
    std::count_if(isosurface.begin(), isosurface.end(), [](double t) { return !std::isnan(t); }));
}

}
