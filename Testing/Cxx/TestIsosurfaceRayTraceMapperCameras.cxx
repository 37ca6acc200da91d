// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Cameras, viewports and windows: the ball is where the polygons of a ball are.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkActor.h>
#include <vtkCubeSource.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <functional>

using namespace MapperTesting;

namespace
{

struct Setting
{
  std::string Name;
  std::function<void(vtkRenderer*)> Apply;
};

std::vector<Setting> GetSettings()
{
  return {
    { "perspective", [](vtkRenderer*) {} },
    { "parallel",
      [](vtkRenderer* renderer) { renderer->GetActiveCamera()->ParallelProjectionOn(); } },
    { "off centre",
      [](vtkRenderer* renderer) { renderer->GetActiveCamera()->SetWindowCenter(0.3, -0.2); } },
    { "sheared",
      [](vtkRenderer* renderer)
      {
        renderer->GetActiveCamera()->ParallelProjectionOn();
        renderer->GetActiveCamera()->SetViewShear(0.3, 0.2, 1.0);
      } },
    { "sheared in perspective",
      [](vtkRenderer* renderer) { renderer->GetActiveCamera()->SetViewShear(0.2, -0.1, 1.0); } },
    { "with a user transform",
      [](vtkRenderer* renderer)
      {
        vtkNew<vtkTransform> transform;
        transform->Scale(0.8, 1.1, 1.0);
        transform->RotateZ(20.0);
        transform->Translate(0.1, 0.05, 0.0);
        renderer->GetActiveCamera()->SetUserTransform(transform);
      } },
    { "with a user view transform",
      [](vtkRenderer* renderer)
      {
        vtkNew<vtkTransform> transform;
        transform->RotateX(5.0);
        transform->Translate(0.2, 0.1, 0.1);
        renderer->GetActiveCamera()->SetUserViewTransform(transform);
      } },
    { "with a model transform",
      [](vtkRenderer* renderer)
      {
        vtkNew<vtkTransform> transform;
        transform->RotateY(30.0);
        transform->Translate(0.2, 0.0, -0.1);
        transform->Scale(1.1, 1.1, 1.1);
        renderer->GetActiveCamera()->SetModelTransformMatrix(transform->GetMatrix());
      } },
    { "with a projection of its own",
      [](vtkRenderer* renderer)
      {
        vtkCamera* camera = renderer->GetActiveCamera();
        vtkNew<vtkMatrix4x4> projection;
        projection->DeepCopy(camera->GetProjectionTransformMatrix(1.0, -1.0, 1.0));
        projection->SetElement(0, 0, 0.7 * projection->GetElement(0, 0));
        projection->SetElement(0, 2, 0.1);
        camera->SetExplicitProjectionTransformMatrix(projection);
        camera->UseExplicitProjectionTransformMatrixOn();
      } },
    { "off its axis",
      [](vtkRenderer* renderer)
      {
        // Screen and eye are in view coordinates before VTK 9.3, and in world coordinates since:
        // here these are the same. So are both distances of the eyes if they are 0.
        vtkCamera* camera = renderer->GetActiveCamera();
        camera->SetPosition(0.0, 0.0, 0.0);
        camera->SetFocalPoint(0.0, 0.0, -1.0);
        camera->SetViewUp(0.0, 1.0, 0.0);
        camera->SetClippingRange(1.0, 10.0);
        camera->SetEyeSeparation(0.0);
        vtkNew<vtkMatrix4x4> eye;
        eye->SetElement(0, 3, 0.3);
        eye->SetElement(1, 3, -0.2);
        eye->SetElement(2, 3, 4.0);
        camera->SetEyeTransformMatrix(eye);
        camera->UseOffAxisProjectionOn();
        camera->SetScreenBottomLeft(-0.9, -0.8, 1.0);
        camera->SetScreenBottomRight(0.7, -0.8, 1.0);
        camera->SetScreenTopRight(0.7, 0.8, 1.0);
      } },
    { "rolled and near",
      [](vtkRenderer* renderer)
      {
        renderer->GetActiveCamera()->Roll(30.0);
        renderer->GetActiveCamera()->Dolly(1.2);
        renderer->ResetCameraClippingRange();
      } },
    { "cut by the near plane",
      [](vtkRenderer* renderer)
      {
        const double distance = renderer->GetActiveCamera()->GetDistance();
        renderer->GetActiveCamera()->SetClippingRange(distance - 0.5, distance + 2.0);
      } },
    { "cut by the far plane",
      [](vtkRenderer* renderer)
      {
        const double distance = renderer->GetActiveCamera()->GetDistance();
        renderer->GetActiveCamera()->SetClippingRange(0.1, distance - 0.4);
      } },
    { "from within",
      [](vtkRenderer* renderer)
      {
        renderer->GetActiveCamera()->SetPosition(0.2, 0.1, 0.3);
        renderer->GetActiveCamera()->SetFocalPoint(1.0, 0.4, 0.2);
        renderer->GetActiveCamera()->SetClippingRange(0.01, 5.0);
      } },
    { "viewport", [](vtkRenderer* renderer) { renderer->SetViewport(0.31, 0.12, 0.83, 0.97); } },
  };
}

vtkSmartPointer<vtkActor> NewFlatActor(vtkPolyDataAlgorithm* source)
{
  auto actor = NewActor(source);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1.0, 0.0, 0.0);
  return actor;
}

void CheckAgainstPolygons(
  Checks& check, vtkImageData* image, vtkPolyDataAlgorithm* source, const Setting& setting)
{
  Scene scene(image);
  scene.Property()->ShadeOff();
  scene.SetSurface(0.0, { 1.0, 0.0, 0.0 }, 1.0);
  setting.Apply(scene.Renderer);
  const Picture traced = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveVolume(scene.Volume);
  const Picture empty = RenderAndCapture(scene.Window);
  scene.Renderer->AddActor(NewFlatActor(source));
  const Picture polygons = RenderAndCapture(scene.Window);
  const double covered = GetDifference(polygons, empty, 2);
  const double difference = GetDifference(traced, polygons, 2);
  std::cout << setting.Name << ": it covers " << 100.0 * covered << " %, " << 100.0 * difference
            << " % of the pixels differ\n";
  check.That(covered > 0.05, setting.Name + ": there is something to see");
  check.That(difference < 0.001, setting.Name + ": it is where its polygons are");
}

}

int TestIsosurfaceRayTraceMapperCameras(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(65, 0.7);
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.7);
  sphere->SetThetaResolution(300);
  sphere->SetPhiResolution(300);
  for (const Setting& setting : GetSettings())
  {
    CheckAgainstPolygons(check, image, sphere, setting);
  }

  // A surface that reaches to the borders of the volume, and so of the pixels that are traced.
  const auto box = NewCube(81, AnalyticFields::Box{ { 0.0, 0.0, 0.0 }, 0.975 });
  vtkNew<vtkCubeSource> cube;
  cube->SetXLength(1.95);
  cube->SetYLength(1.95);
  cube->SetZLength(1.95);
  CheckAgainstPolygons(check, box, cube,
    { "a face of a cube",
      [](vtkRenderer* renderer)
      {
        renderer->GetActiveCamera()->SetPosition(0.0, -8.0, 0.0);
        renderer->ResetCamera();
      } });

  // On the screen and off it.
  Scene scene(image);
  const Picture onScreen = RenderAndCapture(scene.Window);
  Scene hidden(image);
  hidden.Window->SetOffScreenRendering(true);
  check.Equal(
    GetDifference(RenderAndCapture(hidden.Window), onScreen, 0), 0.0, "the difference off screen");

  // Two renderers side by side, and one on a layer above both.
  Scene several(image, 320, 160);
  several.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> right;
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  right->AddVolume(several.Volume);
  right->SetBackground(0.3, 0.1, 0.1);
  several.Window->AddRenderer(right);
  right->ResetCamera();
  several.Window->SetNumberOfLayers(2);
  vtkNew<vtkRenderer> above;
  above->SetLayer(1);
  above->SetViewport(0.35, 0.3, 0.65, 0.7);
  vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
  mapper->SetInputData(image);
  vtkNew<vtkVolume> small;
  small->SetMapper(mapper);
  small->GetProperty()->DeepCopy(several.Property());
  small->GetProperty()->GetRGBTransferFunction()->AddRGBPoint(0.0, 0.3, 0.8, 0.4);
  above->AddVolume(small);
  several.Window->AddRenderer(above);
  above->ResetCamera();
  check.That(IsBaseline(argc, argv, several.Window), "the picture is the baseline");
  return check.Result();
}
