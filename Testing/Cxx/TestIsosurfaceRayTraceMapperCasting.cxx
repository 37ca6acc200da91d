// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays that are cast without a window: where they hit, and that it is what a window shows.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkIdTypeArray.h>
#include <vtkMath.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

using namespace MapperTesting;

namespace
{

/// A mapper in a volume, and no renderer.
struct Bench
{
  explicit Bench(vtkImageData* image)
  {
    this->Mapper->SetInputData(image);
    this->Volume->SetMapper(this->Mapper);
    this->SetSurfaces({ { 0.0, 1.0 } });
  }

  void SetSurfaces(const std::vector<std::pair<double, double>>& surfaces)
  {
    vtkVolumeProperty* property = this->Volume->GetProperty();
    property->GetScalarOpacity()->RemoveAllPoints();
    property->GetIsoSurfaceValues()->SetNumberOfContours(0);
    for (std::size_t i = 0; i < surfaces.size(); ++i)
    {
      property->GetIsoSurfaceValues()->SetValue(static_cast<int>(i), surfaces[i].first);
      property->GetScalarOpacity()->AddPoint(surfaces[i].first, surfaces[i].second);
    }
  }

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
};

/// A square of rays that look along a direction at the middle of the world, from afar.
void MakeRays(const double direction[3], vtkPoints* origins, vtkDoubleArray* directions)
{
  double right[3];
  double up[3];
  vtkMath::Perpendiculars(direction, right, up, 0.3);
  origins->SetDataTypeToDouble();
  directions->SetNumberOfComponents(3);
  for (int i = 0; i < 40 * 40; ++i)
  {
    const double u = (i % 40 - 19.3) * 0.05;
    const double v = (i / 40 - 19.7) * 0.05;
    origins->InsertNextPoint(-5.0 * direction[0] + u * right[0] + v * up[0],
      -5.0 * direction[1] + u * right[1] + v * up[1],
      -5.0 * direction[2] + u * right[2] + v * up[2]);
    directions->InsertNextTuple(direction);
  }
}

/// A plane is hit at its position, with its normal, by every solver; the columns are consistent.
void CheckPlane(Checks& check)
{
  const AnalyticFields::Plane plane = { { 0.48, -0.6, 0.64 }, 0.1 };
  Bench bench(NewCube(9, plane));
  const double direction[3] = { 0.36, -0.48, 0.8 };
  vtkNew<vtkPoints> origins;
  vtkNew<vtkDoubleArray> directions;
  MakeRays(direction, origins, directions);
  for (int solver = vtkIsosurfaceRayTraceMapper::ROBUST;
       solver <= vtkIsosurfaceRayTraceMapper::LINEAR; ++solver)
  {
    bench.Mapper->SetRootSolver(solver);
    vtkNew<vtkPolyData> hits;
    check.That(bench.Mapper->CastRays(bench.Volume, origins, directions, hits), "rays are cast");
    check.That(hits->GetNumberOfPoints() > 500, "hundreds of rays hit the plane");
    vtkPointData* data = hits->GetPointData();
    double worst = 0.0;
    double worstNormal = 0.0;
    double worstT = 0.0;
    for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
    {
      AnalyticFields::Point p;
      hits->GetPoint(i, p.data());
      worst = std::max(worst, std::abs(plane(p)));
      double normal[3];
      data->GetNormals()->GetTuple(i, normal);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        // Outside is where values are smaller.
        worstNormal = std::max(worstNormal, std::abs(normal[axis] + plane.Normal[axis]));
        const auto ray = static_cast<vtkIdType>(data->GetArray("RayId")->GetTuple1(i));
        const double t = data->GetArray("T")->GetTuple1(i);
        worstT =
          std::max(worstT, std::abs(origins->GetPoint(ray)[axis] + t * direction[axis] - p[axis]));
      }
    }
    // The closed form as published divides by a cubic coefficient that is only rounding.
    if (solver != vtkIsosurfaceRayTraceMapper::ANALYTIC)
    {
      check.Near(worst, 0.0, 1e-14, "the distance to the plane");
    }
    check.Near(worstNormal, 0.0, 1e-12, "the error of the normal");
    check.Near(worstT, 0.0, 1e-14 * 100, "the point at T along the ray");
  }
}

/// A translucent ball has a front and a back; an opaque one within hides the rest.
void CheckOrder(Checks& check)
{
  Bench bench(NewBall(33, 0.5));
  bench.SetSurfaces({ { 0.0, 0.5 }, { 0.2, 1.0 } });
  vtkNew<vtkPoints> origins;
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  origins->InsertNextPoint(-4.0, 0.01, 0.02);
  directions->InsertNextTuple3(2.0, 0.0, 0.0);
  origins->InsertNextPoint(-4.0, 0.9, 0.9);
  directions->InsertNextTuple3(2.0, 0.0, 0.0);
  origins->InsertNextPoint(-4.0, 0.4, 0.02);
  directions->InsertNextTuple3(2.0, 0.0, 0.0);
  vtkNew<vtkPolyData> hits;
  bench.Mapper->CastRays(bench.Volume, origins, directions, hits);
  const int rays[] = { 0, 0, 2, 2 };
  const double isovalues[] = { 0.0, 0.2, 0.0, 0.0 };
  const double positions[] = { -0.5, -0.3, -0.3, 0.3 };
  check.Equal(hits->GetNumberOfPoints(), vtkIdType{ 4 }, "the number of hits");
  for (vtkIdType i = 0; i < std::min<vtkIdType>(4, hits->GetNumberOfPoints()); ++i)
  {
    vtkPointData* data = hits->GetPointData();
    check.Equal(static_cast<int>(data->GetArray("RayId")->GetTuple1(i)), rays[i], "the ray");
    check.Equal(data->GetArray("Isovalue")->GetTuple1(i), isovalues[i], "the isovalue");
    check.Near(hits->GetPoint(i)[0], positions[i], 5e-3, "the position of the hit");
    check.Near(data->GetArray("T")->GetTuple1(i), 0.5 * (4.0 + positions[i]), 2e-3, "its T");
  }
}

/// Lines through the world of a volume that is moved: IntersectWithLine says the same as CastRays,
/// and the cell and its coordinates lead back to the point.
void CheckLines(Checks& check)
{
  const auto image = NewBall(33, 0.7);
  image->SetExtent(5, 37, -3, 29, 100, 132);
  image->SetOrigin(-1.0 - 5.0 / 16.0, -1.0 + 3.0 / 16.0, -1.0 - 100.0 / 16.0);
  Bench bench(image);
  bench.Volume->SetPosition(10.0, 20.0, 30.0);
  bench.Volume->SetScale(2.0);
  const double p1[3] = { 10.0, 10.0, 30.3 };
  const double p2[3] = { 10.4, 30.0, 30.1 };
  double t;
  double x[3];
  double pcoords[3];
  vtkIdType cell;
  double isovalue;
  double normal[3];
  check.Equal(
    bench.Mapper->IntersectWithLine(bench.Volume, p1, p2, t, x, pcoords, cell, isovalue, normal), 1,
    "the hit of a line");
  check.Near(
    std::hypot(x[0] - 10.0, x[1] - 20.0, x[2] - 30.0), 1.4, 4e-3, "the distance of the hit");
  for (int axis = 0; axis < 3; ++axis)
  {
    check.Near(x[axis], p1[axis] + t * (p2[axis] - p1[axis]), 1e-12, "the point at t");
    const double center[3] = { 10.0, 20.0, 30.0 };
    check.Near(normal[axis], (x[axis] - center[axis]) / 1.4, 2e-2, "the normal points outwards");
  }
  double bounds[6];
  image->GetCellBounds(cell, bounds);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate =
      bounds[2 * axis] + pcoords[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]);
    const double position[3] = { 10.0, 20.0, 30.0 };
    check.Near(position[axis] + 2.0 * coordinate, x[axis], 1e-12, "cell and coordinates");
  }
  const double before[3] = { 10.0, 15.0, 30.3 };
  check.Equal(bench.Mapper->IntersectWithLine(
                bench.Volume, p1, before, t, x, pcoords, cell, isovalue, normal),
    0, "the hit of a line that ends before the ball");
}

/// A surface around a sample among 200 along each axis, which few rays would pass by.
void CheckBoundsOfSmall(Checks& check)
{
  constexpr int samples = 201;
  vtkNew<vtkImageData> image;
  image->SetDimensions(samples, samples, samples);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(values, image->GetNumberOfPoints(), static_cast<unsigned char>(0));
  *static_cast<unsigned char*>(image->GetScalarPointer(50, 60, 70)) = 255;
  Bench bench(image);
  bench.SetSurfaces({ { 100.0, 1.0 } });
  double bounds[6];
  check.That(bench.Mapper->FindSurfaceBounds(bench.Volume, bounds), "a small surface has bounds");
  for (int side = 0; side < 6; ++side)
  {
    check.Near(bounds[side], 50.0 + 10.0 * (side / 2), 1.0, "the bounds of a small surface");
  }
}

/// The bounds of a ball are smaller than those of its image, those of half a ball are half as long.
void CheckSurfaceBounds(Checks& check)
{
  Bench bench(NewBall(33, 0.5));
  bench.Volume->SetPosition(10.0, 20.0, 30.0);
  double bounds[6];
  check.That(bench.Mapper->FindSurfaceBounds(bench.Volume, bounds), "there are bounds");
  for (int side = 0; side < 6; ++side)
  {
    check.Near(bounds[side], 10.0 * (side / 2 + 1) + (side % 2 == 0 ? -0.5 : 0.5), 5e-3,
      "the bounds of a ball");
  }
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(10.0, 20.0, 30.0);
  plane->SetNormal(0.0, -1.0, 0.0);
  bench.Mapper->AddClippingPlane(plane);
  check.That(bench.Mapper->FindSurfaceBounds(bench.Volume, bounds), "half a ball has bounds");
  check.Near(bounds[2], 19.5, 5e-3, "the lower end of half a ball");
  check.Near(bounds[3], 20.0, 2.0 / 64.0, "the upper end of half a ball");
  bench.SetSurfaces({ { 5.0, 1.0 } });
  bounds[0] = 7.0;
  check.That(!bench.Mapper->FindSurfaceBounds(bench.Volume, bounds), "nothing has no bounds");
  check.Equal(bounds[0], 7.0, "a bound that is left as it is");
}

/// What the rays of a camera hit is what the window shows.
void CheckAgainstWindow(Checks& check)
{
  const auto image = NewBall(33, 0.7);
  Scene scene(image);
  scene.Window->Render();
  const DepthPicture picture(scene.Window, scene.Renderer);
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  for (int y = 0; y < picture.GetHeight(); ++y)
  {
    for (int x = 0; x < picture.GetWidth(); ++x)
    {
      const AnalyticFields::Point a = picture.GetPoint(x, y, 0.0);
      const AnalyticFields::Point b = picture.GetPoint(x, y, 1.0);
      origins->InsertNextPoint(a.data());
      directions->InsertNextTuple3(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    }
  }
  vtkNew<vtkPolyData> hits;
  scene.Mapper->CastRays(scene.Volume, origins, directions, hits);
  std::vector<int> isHit(static_cast<std::size_t>(picture.GetWidth() * picture.GetHeight()), 0);
  double worst = 0.0;
  for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
  {
    const auto ray = static_cast<int>(hits->GetPointData()->GetArray("RayId")->GetTuple1(i));
    isHit[static_cast<std::size_t>(ray)] = 1;
    const AnalyticFields::Point p =
      picture.GetPoint(ray % picture.GetWidth(), ray / picture.GetWidth());
    for (int axis = 0; axis < 3; ++axis)
    {
      worst =
        std::max(worst, std::abs(p[static_cast<std::size_t>(axis)] - hits->GetPoint(i)[axis]));
    }
  }
  int different = 0;
  for (int i = 0; i < picture.GetWidth() * picture.GetHeight(); ++i)
  {
    const bool isEmpty = picture.IsEmpty(i % picture.GetWidth(), i / picture.GetWidth());
    different += isEmpty == (isHit[static_cast<std::size_t>(i)] != 0) ? 1 : 0;
  }
  check.Equal(different, 0, "the number of pixels that a ray judges otherwise");
  check.Near(worst, 0.0, 2e-6, "the distance between hit and pixel");
}

/// Rays go on where others hit: their origins and directions are of the output.
void CheckCastingOn(Checks& check)
{
  Bench bench(NewBall(9, 0.5));
  const double direction[3] = { 0.0, 0.0, 1.0 };
  vtkNew<vtkPoints> origins;
  vtkNew<vtkDoubleArray> directions;
  MakeRays(direction, origins, directions);
  vtkNew<vtkPolyData> hits;
  check.That(bench.Mapper->CastRays(bench.Volume, origins, directions, hits), "rays are cast");
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(hits);
  vtkNew<vtkPolyData> expected;
  bench.Mapper->CastRays(
    bench.Volume, copy->GetPoints(), copy->GetPointData()->GetNormals(), expected);
  check.That(bench.Mapper->CastRays(
               bench.Volume, hits->GetPoints(), hits->GetPointData()->GetNormals(), hits),
    "rays are cast on");
  check.That(hits->GetNumberOfPoints() > 0, "they hit something");
  check.Equal(
    hits->GetNumberOfPoints(), expected->GetNumberOfPoints(), "the hits of rays from hits");
  for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
  {
    check.Equal(hits->GetPoint(i)[2], expected->GetPoint(i)[2], "a place");
  }
}

void CheckErrors(Checks& check)
{
  Bench bench(NewBall(9, 0.5));
  vtkNew<EventCounter> errors;
  bench.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  vtkNew<vtkPoints> origins;
  origins->InsertNextPoint(0.0, 0.0, 0.0);
  vtkNew<vtkDoubleArray> directions;
  vtkNew<vtkPolyData> hits;
  check.That(!bench.Mapper->CastRays(bench.Volume, origins, directions, hits),
    "rays without directions are not cast");
  check.Equal(errors->Count, 1, "the number of errors");
  check.That(errors->Text.find("3 components") != std::string::npos, "it says what is required");
  directions->SetNumberOfComponents(3);
  directions->InsertNextTuple3(0.0, 0.0, 0.0);
  check.That(bench.Mapper->CastRays(bench.Volume, origins, directions, hits), "a ray is cast");
  check.Equal(hits->GetNumberOfPoints(), vtkIdType{ 0 }, "the hits of a ray without a direction");
  bench.Mapper->SetInputData(static_cast<vtkImageData*>(nullptr));
  check.That(!bench.Mapper->CastRays(bench.Volume, origins, directions, hits),
    "rays at nothing are not cast");
  check.Equal(errors->Count, 2, "the number of errors without an input");
  double bounds[6];
  check.That(!bench.Mapper->FindSurfaceBounds(nullptr, bounds), "no volume has no bounds");
  check.Equal(errors->Count, 3, "the number of errors without a volume");
}

}

int TestIsosurfaceRayTraceMapperCasting(int, char*[])
{
  Checks check;
  CheckPlane(check);
  CheckOrder(check);
  CheckLines(check);
  CheckSurfaceBounds(check);
  CheckBoundsOfSmall(check);
  CheckAgainstWindow(check);
  CheckCastingOn(check);
  CheckErrors(check);
  return check.Result();
}
