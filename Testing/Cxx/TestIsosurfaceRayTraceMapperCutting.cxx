// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Clipping planes, cropping regions and blanked cells: the hits are those of the whole volume
// without those that are cut off, along every ray.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "RandomRays.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkCellData.h>
#include <vtkDataSetAttributes.h>
#include <vtkIdTypeArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPlane.h>

#include <functional>
#include <optional>
#include <vector>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

/// A surface that a ray meets many times.
double Gyroid(const Point& p)
{
  return std::sin(7.0 * p[0]) * std::cos(7.0 * p[1]) + std::sin(7.0 * p[1]) * std::cos(7.0 * p[2]) +
    std::sin(7.0 * p[2]) * std::cos(7.0 * p[0]) + 0.1;
}

/// A gyroid with an extent, a direction matrix and a negative spacing along y.
vtkSmartPointer<vtkImageData> NewGyroid()
{
  auto image = NewCube(25, Gyroid);
  const double c = std::cos(0.4);
  const double s = std::sin(0.4);
  image->SetExtent(5, 29, -3, 21, 0, 24);
  image->SetSpacing(1.0 / 12.0, -1.0 / 12.0, 1.0 / 12.0);
  image->SetOrigin(-1.2, 0.7, -1.0);
  image->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  return image;
}

struct Hit
{
  vtkIdType Ray;
  double T;
  vtkIdType Cell;
  Point Crossing;
};

/// How far a hit is from being cut off; negative where it is.
using Margin = std::function<double(const Hit&)>;

/// A volume that is moved, and rays that lead through it.
class Bench
{
public:
  Bench(vtkImageData* image, double opacity)
  {
    this->Mapper->SetInputData(image);
    this->Volume->SetMapper(this->Mapper);
    this->Volume->SetPosition(0.3, -0.1, 0.2);
    this->Volume->RotateX(25.0);
    this->Volume->SetScale(1.0, 1.2, 0.9);
    vtkVolumeProperty* property = this->Volume->GetProperty();
    property->GetIsoSurfaceValues()->SetValue(0, 0.0);
    property->GetScalarOpacity()->AddPoint(0.0, opacity);
    this->Rays.emplace(this->GetCenter(), 1.0, 1500);
  }

  std::vector<Hit> Cast()
  {
    const auto output = this->Rays->Cast(this->Mapper, this->Volume);
    vtkPointData* data = output->GetPointData();
    std::vector<Hit> hits;
    for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
    {
      Hit hit{ static_cast<vtkIdType>(data->GetArray("RayId")->GetTuple1(i)),
        data->GetArray("T")->GetTuple1(i),
        static_cast<vtkIdType>(data->GetArray("CellId")->GetTuple1(i)), {} };
      output->GetPoint(i, hit.Crossing.data());
      hits.push_back(hit);
    }
    return hits;
  }

  Point GetCenter()
  {
    const double* center = this->Volume->GetCenter();
    return { center[0], center[1], center[2] };
  }

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;

private:
  std::optional<RandomRays> Rays;
};

/// Compares the hits of a volume that is cut with the remaining ones of the whole volume. Of every
/// ray the first remains if surfaces are opaque. Rays on the edge of the cut are ignored.
void Compare(Checks& check, const std::vector<Hit>& actual, const std::vector<Hit>& whole,
  bool isOpaque, const Margin& margin, const std::string& name)
{
  std::vector<Hit> expected;
  std::vector<bool> isOnEdge(1500, false);
  std::size_t cutOff = 0;
  for (const Hit& hit : whole)
  {
    const double distance = margin(hit);
    isOnEdge[static_cast<std::size_t>(hit.Ray)] =
      isOnEdge[static_cast<std::size_t>(hit.Ray)] || std::abs(distance) < 1e-9;
    cutOff += distance < 0.0 ? 1 : 0;
    if (distance >= 0.0 && (!isOpaque || expected.empty() || expected.back().Ray != hit.Ray))
    {
      expected.push_back(hit);
    }
  }
  check.That(cutOff > 0 && expected.size() > 50, name + " cuts off hits, and not all");
  check.Equal(actual.size(), expected.size(), "the number of hits with " + name);
  for (std::size_t i = 0; i < std::min(actual.size(), expected.size()); ++i)
  {
    if (isOnEdge[static_cast<std::size_t>(expected[i].Ray)])
    {
      continue;
    }
    if (actual[i].Ray != expected[i].Ray || actual[i].Cell != expected[i].Cell ||
      std::abs(actual[i].T - expected[i].T) > 1e-11)
    {
      check.That(false, "hit " + std::to_string(i) + " with " + name + " is the one expected");
      return;
    }
  }
}

/// Cuts in the same way where surfaces are opaque and where they are not.
void CheckCut(Checks& check, const std::vector<Hit>& whole,
  const std::function<void(vtkIsosurfaceRayTraceMapper*)>& cut, vtkImageData* image,
  const Margin& margin, const std::string& name)
{
  for (const double opacity : { 1.0, 1e-6 })
  {
    Bench bench(image, opacity);
    cut(bench.Mapper);
    Compare(check, bench.Cast(), whole, opacity == 1.0, margin,
      name + (opacity == 1.0 ? "" : ", translucent"));
  }
}

double Evaluate(vtkPlane* plane, Point point)
{
  return plane->EvaluateFunction(point.data());
}

void CheckClipping(Checks& check)
{
  const auto image = NewGyroid();
  Bench all(image, 1e-6);
  const std::vector<Hit> whole = all.Cast();
  const Point center = all.GetCenter();
  std::vector<vtkSmartPointer<vtkPlane>> planes;
  for (int count = 1; count <= 8; ++count)
  {
    auto plane = vtkSmartPointer<vtkPlane>::New();
    const double angle = 0.8 * count;
    const double normal[3] = { std::cos(angle), std::sin(angle), 0.3 * std::sin(3.0 * angle) };
    plane->SetNormal(normal);
    plane->SetOrigin(
      center[0] - 0.5 * normal[0], center[1] - 0.5 * normal[1], center[2] - 0.5 * normal[2]);
    planes.push_back(plane);
    CheckCut(
      check, whole,
      [&](vtkIsosurfaceRayTraceMapper* mapper)
      {
        for (vtkPlane* one : planes)
        {
          mapper->AddClippingPlane(one);
        }
      },
      image,
      [&](const Hit& hit)
      {
        double least = 1.0;
        for (vtkPlane* one : planes)
        {
          least = std::min(least, Evaluate(one, hit.Crossing));
        }
        return least;
      },
      std::to_string(count) + " clipping planes");
  }
}

/// The region of VTK's cropping that a point of the image, without its direction, is in.
double GetCroppingMargin(const Point& point, const double planes[6], int flags)
{
  int region = 0;
  double margin = 1.0;
  int stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double low = point[axis] - planes[2 * axis];
    const double high = point[axis] - planes[2 * axis + 1];
    region += stride * (low < 0.0 ? 0 : (high > 0.0 ? 2 : 1));
    margin = std::min(margin, std::min(std::abs(low), std::abs(high)));
    stride *= 3;
  }
  return (flags >> region & 1) != 0 ? margin : -margin;
}

void CheckCropping(Checks& check)
{
  const auto image = NewGyroid();
  Bench all(image, 1e-6);
  const std::vector<Hit> whole = all.Cast();
  vtkNew<vtkMatrix4x4> imageFromWorld;
  vtkMatrix4x4::Invert(all.Volume->GetMatrix(), imageFromWorld);
  const double planes[6] = { -0.45, 0.4, -0.6, 0.3, -0.5, 0.37 };
  std::vector<int> flags = { VTK_CROP_SUBVOLUME, VTK_CROP_FENCE, VTK_CROP_INVERTED_FENCE,
    VTK_CROP_CROSS, VTK_CROP_INVERTED_CROSS, 0x2a5f0c3 };
  for (int region = 0; region < 27; ++region)
  {
    flags.push_back(0x7ffffff & ~(1 << region));
  }
  for (const int flag : flags)
  {
    CheckCut(
      check, whole,
      [&](vtkIsosurfaceRayTraceMapper* mapper)
      {
        mapper->CroppingOn();
        mapper->SetCroppingRegionPlanes(planes);
        mapper->SetCroppingRegionFlags(flag);
      },
      image,
      [&](const Hit& hit)
      {
        double point[4] = { hit.Crossing[0], hit.Crossing[1], hit.Crossing[2], 1.0 };
        imageFromWorld->MultiplyPoint(point, point);
        double index[3];
        image->TransformPhysicalPointToContinuousIndex(point, index);
        Point position;
        for (int axis = 0; axis < 3; ++axis)
        {
          position[static_cast<std::size_t>(axis)] =
            image->GetOrigin()[axis] + image->GetSpacing()[axis] * index[axis];
        }
        return GetCroppingMargin(position, planes, flag);
      },
      "cropping " + std::to_string(flag));
  }
}

/// Blanked cells, cells of other pieces and cells at a hidden point are not drawn.
void CheckBlanking(Checks& check)
{
  const auto image = NewGyroid();
  Bench all(image, 1e-6);
  const std::vector<Hit> whole = all.Cast();
  const unsigned char flags[] = { 0, vtkDataSetAttributes::HIDDENCELL, 0,
    vtkDataSetAttributes::DUPLICATECELL, vtkDataSetAttributes::REFINEDCELL };
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType i = 0; i < image->GetNumberOfCells(); ++i)
  {
    ghosts->InsertNextValue(flags[i % 5]);
  }
  image->GetCellData()->AddArray(ghosts);
  const auto leave = [](vtkIsosurfaceRayTraceMapper*) {};
  const auto isShown = [](const Hit& hit) { return hit.Cell % 5 == 0 || hit.Cell % 5 == 2; };
  CheckCut(
    check, whole, leave, image, [&](const Hit& hit) { return isShown(hit) ? 1.0 : -1.0; },
    "blanked cells");

  vtkNew<vtkUnsignedCharArray> pointGhosts;
  pointGhosts->SetName(vtkDataSetAttributes::GhostArrayName());
  pointGhosts->SetNumberOfValues(image->GetNumberOfPoints());
  pointGhosts->Fill(0);
  const vtkIdType hidden = 12 + 25 * (12 + 25 * 12);
  for (vtkIdType i = hidden - 3 * 25; i < hidden + 3 * 25; i += 2)
  {
    pointGhosts->SetValue(i, vtkDataSetAttributes::HIDDENPOINT);
  }
  image->GetPointData()->AddArray(pointGhosts);
  CheckCut(
    check, whole, leave, image,
    [&](const Hit& hit)
    {
      vtkNew<vtkIdList> corners;
      image->GetCellPoints(hit.Cell, corners);
      bool isHidden = !isShown(hit);
      for (const vtkIdType corner : *corners)
      {
        isHidden = isHidden || pointGhosts->GetValue(corner) != 0;
      }
      return isHidden ? -1.0 : 1.0;
    },
    "hidden points besides");
}

/// An onion with a corner cropped off and a slice clipped off: a picture for people.
void MakePicture(Scene& scene)
{
  scene.SetSurface(0.0, { 0.9, 0.75, 0.5 }, 1.0);
  scene.AddSurface(0.25, { 0.2, 0.5, 0.9 }, 0.5);
  scene.AddSurface(0.5, { 0.8, 0.2, 0.2 }, 1.0);
  scene.Mapper->CroppingOn();
  scene.Mapper->SetCroppingRegionPlanes(-0.8, 0.2, -0.2, 0.8, -0.8, 0.2);
  scene.Mapper->SetCroppingRegionFlags(0x7ffffff & ~(1 << (2 + 3 * 0 + 9 * 2)));
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1.0, 0.4, -0.3);
  plane->SetOrigin(-0.35, 0.0, 0.0);
  scene.Mapper->AddClippingPlane(plane);
}

}

int TestIsosurfaceRayTraceMapperCutting(int argc, char* argv[])
{
  Checks check;
  CheckClipping(check);
  CheckCropping(check);
  CheckBlanking(check);
  Scene scene(NewBall(41, 0.9), 300, 300);
  MakePicture(scene);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
