// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Features together: cropping with shadows and transparency, a direction matrix with every picker.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkCellPicker.h>
#include <vtkExtractVOI.h>
#include <vtkLight.h>
#include <vtkMath.h>
#include <vtkMatrix3x3.h>
#include <vtkPlane.h>
#include <vtkPlaneSource.h>
#include <vtkProperty.h>
#include <vtkTransform.h>
#include <vtkWorldPointPicker.h>

using namespace MapperTesting;

namespace
{

/// Two surfaces, the outer translucent, with shadows from a lamp at the side.
struct ShadowScene : Scene
{
  explicit ShadowScene(vtkImageData* image)
    : Scene(image, 200, 200)
  {
    this->SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.5);
    this->AddSurface(0.25, { 0.3, 0.6, 0.9 }, 1.0);
    this->Mapper->ShadowsOn();
    this->Mapper->SetNormalModeToInterpolantGradient(); // does not look beyond a cell
    vtkNew<vtkLight> lamp;
    lamp->SetPosition(3.0, -4.0, 5.0);
    lamp->SetFocalPoint(0.0, 0.0, 0.0);
    this->Renderer->AddLight(lamp);
  }
};

/// What cropping leaves equals the picture of cut samples: the same surfaces, visible through each
/// other, with shadows of each other and of nothing that is cut.
void CheckCroppingWithShadows(Checks& check)
{
  const auto image = NewCube(41,
    [](const AnalyticFields::Point& p)
    {
      return 0.6 - std::hypot(p[0], p[1], p[2]) +
        0.15 * std::sin(9.0 * p[0]) * std::cos(8.0 * p[2]);
    });
  ShadowScene cropped(image);
  const Picture whole = RenderAndCapture(cropped.Window);
  // Planes of samples: index 20 to 40, 0 to 30, 10 to 40.
  cropped.Mapper->SetCroppingRegionPlanes(0.0, 1.0, -1.0, 0.5, -0.5, 1.0);
  cropped.Mapper->CroppingOn();
  const Picture picture = RenderAndCapture(cropped.Window);
  cropped.Mapper->ShadowsOff();
  const Picture withoutShadows = RenderAndCapture(cropped.Window);

  vtkNew<vtkExtractVOI> extract;
  extract->SetInputData(image);
  extract->SetVOI(20, 40, 0, 30, 10, 40);
  extract->Update();
  ShadowScene cut(extract->GetOutput());
  cut.Renderer->GetActiveCamera()->DeepCopy(cropped.Renderer->GetActiveCamera());
  const double difference = GetDifference(picture, RenderAndCapture(cut.Window), 2);
  std::cout << "cropped and cut: " << 100.0 * difference << " % of the pixels differ\n";
  check.That(difference < 5e-4, "a cropped volume looks as one of which the rest is cut off");
  check.That(GetDifference(picture, whole, 2) > 0.05, "cropping takes something away");
  check.That(GetDifference(picture, withoutShadows, 2) > 0.01, "there are shadows");
}

/// An image of a ball whose axes are turned, mirrored and stretched, far from the origin.
vtkSmartPointer<vtkImageData> NewTurnedBall(const AnalyticFields::Point& center, double radius)
{
  vtkNew<vtkTransform> turn;
  turn->RotateWXYZ(70.0, 0.3, 1.0, -0.5);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(60, 50, 70);
  image->SetSpacing(0.04, 0.05, 0.035);
  vtkNew<vtkMatrix3x3> directions;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      directions->SetElement(
        row, column, (column == 2 ? -1.0 : 1.0) * turn->GetMatrix()->GetElement(row, column));
    }
  }
  image->SetDirectionMatrix(directions);
  double middle[3];
  image->TransformContinuousIndexToPhysicalPoint(29.5, 24.5, 34.5, middle);
  image->SetOrigin(center[0] - middle[0], center[1] - middle[1], center[2] - middle[2]);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double point[3];
    image->GetPoint(i, point);
    scalars->SetValue(i, radius - std::sqrt(vtkMath::Distance2BetweenPoints(point, center.data())));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

/// Each picker, at pixels all over the ball.
void CheckPickingWithDirections(Checks& check)
{
  const AnalyticFields::Point center = { 3.0, -2.0, 5.0 };
  constexpr double Radius = 0.7;
  const auto image = NewTurnedBall(center, Radius);
  Scene scene(image);
  // VTK's own pickers require opacity.
  scene.Property()->GetScalarOpacity()->AddPoint(-1e-3, 0.0);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetFocalPoint(center.data());
  camera->SetPosition(center[0] + 3.0, center[1] - 2.0, center[2] + 1.0);
  scene.Renderer->ResetCamera();
  scene.Window->Render();
  const auto background = GetPixel(scene.Window, 0, 0);
  int picked = 0;
  for (int y = 56; y < 105; y += 8)
  {
    for (int x = 56; x < 105; x += 7)
    {
      vtkNew<vtkIsosurfacePicker> picker;
      const bool isPicked = picker->Pick(x, y, 0.0, scene.Renderer) == 1;
      check.Equal(
        isPicked, GetPixel(scene.Window, x, y) != background, "whether a pixel is picked");
      if (!isPicked)
      {
        continue;
      }
      ++picked;
      const double* position = picker->GetPickPosition();
      const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(position, center.data()));
      check.Near(distance, Radius, 2e-3, "the distance of the point picked");
      double normal[3];
      vtkMath::Subtract(position, center.data(), normal);
      vtkMath::Normalize(normal);
      check.Near(vtkMath::Dot(normal, picker->GetPickNormal()), 1.0, 2e-3, "its normal, outwards");

      // (vtkVoxel::EvaluatePosition ignores directions.)
      double index[3];
      image->TransformPhysicalPointToContinuousIndex(position, index);
      for (int axis = 0; axis < 3; ++axis)
      {
        check.Near(picker->GetCellIJK()[axis] + picker->GetPCoords()[axis], index[axis], 1e-9,
          "the position in the cell that was picked");
      }
      int ijk[3];
      picker->GetCellIJK(ijk);
      check.Equal(picker->GetCellId(), image->ComputeCellId(ijk), "the cell that was picked");

      vtkNew<vtkWorldPointPicker> world;
      world->Pick(x, y, 0.0, scene.Renderer);
      check.Near(std::sqrt(vtkMath::Distance2BetweenPoints(world->GetPickPosition(), position)),
        0.0, 0.05, "the distance of vtkWorldPointPicker's point, of two pixels at most,");
    }
  }
  std::cout << picked << " points picked\n";
  check.That(picked > 10, "there is something to pick");
}

/// vtkCellPicker finds the surface where the opacity rises there, within a voxel; it knows nothing
/// of direction matrices, so the axes are those of the world.
void CheckCellPicker(Checks& check)
{
  Scene scene(NewBall(65, 0.7));
  scene.Property()->GetScalarOpacity()->AddPoint(-1e-3, 0.0);
  scene.Window->Render();
  for (const int x : { 70, 80, 95 })
  {
    vtkNew<vtkCellPicker> picker;
    check.Equal(picker->Pick(x, 85, 0.0, scene.Renderer), 1, "vtkCellPicker picks");
    const double* position = picker->GetPickPosition();
    check.Near(std::hypot(position[0], position[1], position[2]), 0.7, 2.0 / 64,
      "the distance of vtkCellPicker's point");
    check.That(picker->GetViewProp() == scene.Volume.Get(), "vtkCellPicker picks the volume");
  }
}

/// A picture for people: cropped, clipped, shadowed, and pierced by a translucent screen.
void Furnish(ShadowScene& scene)
{
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 1.0);
  scene.AddSurface(0.25, { 0.3, 0.6, 0.9 }, 1.0);
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->ShallowCopy(scene.Volume);
  scene.Renderer->RemoveVolume(scene.Volume);
  scene.Renderer->AddVolume(volume);
  scene.Mapper->SetCroppingRegionPlanes(0.0, 1.0, -1.0, 0.0, 0.0, 1.0);
  scene.Mapper->SetCroppingRegionFlags(0x7ffffff & ~VTK_CROP_SUBVOLUME);
  scene.Mapper->CroppingOn();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(0.0, 0.0, -0.3);
  plane->SetNormal(0.2, 0.0, 1.0);
  scene.Mapper->AddClippingPlane(plane);
  vtkNew<vtkPlaneSource> screen;
  screen->SetOrigin(-0.9, 0.3, -0.9);
  screen->SetPoint1(0.9, 0.3, -0.9);
  screen->SetPoint2(-0.9, 0.3, 0.9);
  const auto actor = NewActor(screen);
  actor->GetProperty()->SetOpacity(0.35);
  actor->GetProperty()->SetColor(0.5, 1.0, 0.5);
  actor->GetProperty()->LightingOff();
  scene.Renderer->AddActor(actor);
}

}

int TestIsosurfaceCombinations(int argc, char* argv[])
{
  Checks check;
  CheckCroppingWithShadows(check);
  CheckPickingWithDirections(check);
  CheckCellPicker(check);
  ShadowScene scene(NewBall(41, 0.7));
  Furnish(scene);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
