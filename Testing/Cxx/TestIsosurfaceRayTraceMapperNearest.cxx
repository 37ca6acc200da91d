// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Samples as boxes: the picture is that of the outer polygons of the boxes that vtkThreshold keeps,
// and the properties of a pixel are those of the face it shows.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "SceneChecks.h"
#include "Selection.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"

#include <vtkCellData.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkPlane.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkThreshold.h>

#include <algorithm>
#include <set>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

constexpr int Size = 160;

/// A ball with waves, above 0 inside.
double Blob(const Point& p)
{
  return 0.8 - std::hypot(p[0], p[1], p[2]) + 0.1 * std::sin(6.0 * p[0]) * std::cos(5.0 * p[2]);
}

struct BoxScene : Scene
{
  explicit BoxScene(vtkImageData* image)
    : Scene(image, Size, Size)
  {
    this->Mapper->SetInterpolationModeToNearest();
  }
};

/// The image of which every sample is a cell.
vtkSmartPointer<vtkImageData> NewDual(vtkImageData* image)
{
  auto dual = vtkSmartPointer<vtkImageData>::New();
  const int* dimensions = image->GetDimensions();
  const double* spacing = image->GetSpacing();
  const double* origin = image->GetOrigin();
  dual->SetDimensions(dimensions[0] + 1, dimensions[1] + 1, dimensions[2] + 1);
  dual->SetSpacing(spacing[0], spacing[1], spacing[2]);
  dual->SetOrigin(
    origin[0] - 0.5 * spacing[0], origin[1] - 0.5 * spacing[1], origin[2] - 0.5 * spacing[2]);
  dual->GetCellData()->SetScalars(image->GetPointData()->GetScalars());
  return dual;
}

/// The outer polygons of the cells from an isovalue on.
vtkSmartPointer<vtkActor> NewBoxes(vtkImageData* dual, double isovalue, vtkVolumeProperty* look)
{
  vtkNew<vtkThreshold> threshold;
  threshold->SetInputData(dual);
  threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "field");
  threshold->SetUpperThreshold(isovalue);
  threshold->SetThresholdFunction(vtkThreshold::THRESHOLD_UPPER);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(threshold->GetOutputPort());
  auto actor = NewActor(surface);
  actor->GetMapper()->ScalarVisibilityOff();
  double color[3];
  look->GetRGBTransferFunction()->GetColor(isovalue, color);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToFlat();
  property->SetColor(color);
  property->SetAmbient(look->GetAmbient());
  property->SetDiffuse(look->GetDiffuse());
  return actor;
}

//------------------------------------------------------------------------------
/// The pictures of polygons, of samples at points and at the centres of cells, whole and cut.
void CheckPolygons(Checks& check)
{
  const auto image = NewCube(17, Blob);
  const auto dual = NewDual(image);
  for (const bool areOfCells : { false, true })
  {
    for (const bool isCut : { false, true })
    {
      BoxScene scene(areOfCells ? dual.Get() : image.Get());
      scene.Property()->SetSpecular(0.0);
      if (isCut)
      {
        vtkNew<vtkPlane> plane;
        plane->SetNormal(-0.3, 1.0, -0.2);
        plane->SetOrigin(0.0, -0.41, 0.0);
        scene.Mapper->AddClippingPlane(plane);
      }
      const Picture traced = RenderAndCapture(scene.Window);
      scene.Renderer->RemoveVolume(scene.Volume);
      const auto boxes = NewBoxes(dual, 0.0, scene.Property());
      boxes->GetMapper()->SetClippingPlanes(scene.Mapper->GetClippingPlanes());
      scene.Renderer->AddActor(boxes);
      const Picture polygons = RenderAndCapture(scene.Window);
      const double difference = GetDifference(traced, polygons, 2);
      std::cout << "Boxes and polygons, " << (areOfCells ? "cells, " : "points, ")
                << (isCut ? "cut" : "whole") << ": " << 100.0 * difference
                << " % of the pixels differ\n";
      check.That(difference < 0.005, "the boxes are those of vtkThreshold");
      scene.Mapper->SetInterpolationModeToTrilinear();
      scene.Renderer->RemoveActor(boxes);
      scene.Renderer->AddVolume(scene.Volume);
      check.That(GetDifference(RenderAndCapture(scene.Window), polygons, 2) > 0.1,
        "the trilinear surface is another one");
    }
  }
}

//------------------------------------------------------------------------------
/// Positions in the planes of faces, normals perpendicular to them, the same from every interface.
void CheckPixels(Checks& check)
{
  const auto image = NewCube(17, Blob);
  BoxScene scene(image);
  scene.Window->Render();
  const vtkSmartPointer<vtkImageData> picture = scene.RenderToImage();
  const auto get = [&picture](const char* name) { return picture->GetPointData()->GetArray(name); };
  vtkNew<vtkIsosurfacePicker> picker;
  std::set<vtkIdType> insideVisible;
  auto* samples = image->GetPointData()->GetScalars();
  vtkNew<vtkPoints> origins;
  origins->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> directions;
  directions->SetNumberOfComponents(3);
  int shown = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Point position;
    Point normal;
    get("Position")->GetTuple(i, position.data());
    get("Normals")->GetTuple(i, normal.data());
    const auto x = static_cast<unsigned int>(i % Size);
    const auto y = static_cast<unsigned int>(i / Size);
    const bool isPicked = picker->Pick(x, y, 0.0, scene.Renderer) != 0;
    check.Equal(isPicked, !std::isnan(position[0]), "whether a pixel is picked");
    if (!isPicked)
    {
      continue;
    }
    ++shown;
    const auto axis =
      static_cast<std::size_t>(std::abs(normal[0]) > 0.5 ? 0 : (std::abs(normal[1]) > 0.5 ? 1 : 2));
    Point across = { 0.0, 0.0, 0.0 };
    across[axis] = std::copysign(1.0, normal[axis]);
    check.That(normal == across, "the normal stands across a face");
    double pcoords[3];
    picker->GetPCoords(pcoords);
    check.Equal(pcoords[axis], 0.5, "the parametric coordinate across the face");
    check.That(std::equal(position.begin(), position.end(), picker->GetPickPosition()) &&
        std::equal(normal.begin(), normal.end(), picker->GetPickNormal()),
      "the pick is the pixel");
    check.Equal(static_cast<double>(picker->GetCellId()), get("CellId")->GetTuple1(i), "the cell");
    // Half a cell on both sides of the face there are a sample inside, selected, and one outside.
    Point inside = position;
    inside[axis] -= 0.0625 * normal[axis];
    Point outside = position;
    outside[axis] += 0.0625 * normal[axis];
    const vtkIdType sample = image->FindPoint(inside.data());
    check.That(samples->GetTuple1(sample) >= 0.0 &&
        samples->GetTuple1(image->FindPoint(outside.data())) < 0.0,
      "the face is between samples inside and outside");
    insideVisible.insert(sample);

    double t;
    double point[3];
    double isovalue;
    double lineNormal[3];
    vtkIdType cell;
    check.Equal(scene.Mapper->IntersectWithLine(scene.Volume, outside.data(), inside.data(), t,
                  point, pcoords, cell, isovalue, lineNormal),
      1, "whether a line through the face meets it");
    check.Near(t, 0.5, 1e-12, "the middle of the line");
    origins->InsertNextPoint(outside.data());
    const double direction[3] = { -normal[0], -normal[1], -normal[2] };
    directions->InsertNextTuple(direction);
  }
  check.That(shown > 1000, "faces are visible");
  const std::set<vtkIdType> selected =
    Select(scene.Renderer, scene.Volume, vtkDataObject::FIELD_ASSOCIATION_POINTS);
  check.That(
    selected == insideVisible, "the points selected are the samples inside that are visible");
  vtkNew<vtkPolyData> hits;
  scene.Mapper->CastRays(scene.Volume, origins, directions, hits);
  int first = 0;
  vtkIdType ray = -1;
  for (vtkIdType i = 0; i < hits->GetNumberOfPoints(); ++i)
  {
    const auto number =
      static_cast<vtkIdType>(hits->GetPointData()->GetArray("RayId")->GetTuple1(i));
    const double t = hits->GetPointData()->GetArray("T")->GetTuple1(i);
    first += number != ray && std::abs(t - 0.0625) < 1e-12 ? 1 : 0;
    ray = number;
  }
  check.Equal(first, shown, "the number of rays that meet their face first");
}

//------------------------------------------------------------------------------
/// A box does not occlude itself; a box above another occludes its light.
void CheckShadows(Checks& check)
{
  const auto box = [](const Point& p) {
    return std::max({ std::abs(p[0]), std::abs(p[1]), std::abs(p[2]) }) < 0.5 ? 1.0 : -1.0;
  };
  const auto table = [](const Point& p)
  {
    const bool isTop = std::max(std::abs(p[0]), std::abs(p[1])) < 0.3 && p[2] > 0.3 && p[2] < 0.7;
    const bool isFloor =
      std::max(std::abs(p[0]), std::abs(p[1])) < 0.9 && p[2] < -0.5 && p[2] > -0.8;
    return isTop || isFloor ? 1.0 : -1.0;
  };
  for (const bool isConvex : { true, false })
  {
    BoxScene scene(isConvex ? NewCube(17, box) : NewCube(17, table));
    CheckShadows(check, scene, isConvex);
  }
}

}

int TestIsosurfaceRayTraceMapperNearest(int argc, char* argv[])
{
  Checks check;
  CheckPolygons(check);
  CheckPixels(check);
  CheckShadows(check);
  BoxScene blob(NewCube(33, Blob));
  CheckDeterminism(check, blob);

  BoxScene scene(NewCube(25, Blob));
  scene.SetSurface(0.0, { 0.9, 0.75, 0.5 }, 0.35);
  scene.AddSurface(0.35, { 0.3, 0.55, 0.85 }, 1.0);
  AddShadowsAndClipping(scene);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
