// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The depth that the mapper reads and writes: what pierces the surface, before and behind it.

#include "AnalyticFields.h"
#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkProperty.h>
#include <vtkWorldPointPicker.h>

#include <algorithm>
#include <functional>
#include <vector>

using namespace MapperTesting;

namespace
{

vtkSmartPointer<vtkActor> NewCone()
{
  vtkNew<vtkConeSource> cone;
  cone->SetHeight(2.6);
  cone->SetRadius(0.3);
  cone->SetResolution(60);
  cone->SetDirection(1.0, 0.3, 0.2);
  auto actor = NewActor(cone);
  actor->GetProperty()->SetColor(0.2, 0.5, 0.7);
  return actor;
}

void CheckOrders(Checks& check, Scene& scene)
{
  const auto cone = NewCone();
  scene.Renderer->AddActor(cone);
  const Picture volumeFirst = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveAllViewProps();
  scene.Renderer->AddActor(cone);
  scene.Renderer->AddVolume(scene.Volume);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), volumeFirst, 0), 0.0,
    "the difference when the cone is added first");
  check.Equal(GetDifference(RenderAndCapture(scene.Window), volumeFirst, 0), 0.0,
    "the difference of a second frame");
}

/// Every pixel shows what is nearer, by the depths of both drawn separately.
void CheckNearest(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Property()->ShadeOff();
  scene.SetSurface(0.0, { 1.0, 0.0, 0.0 }, 1.0);
  scene.Window->Render();
  const DepthPicture ball(scene.Window, scene.Renderer);
  const auto cone = NewCone();
  cone->GetProperty()->LightingOff();
  cone->GetProperty()->SetColor(0.0, 1.0, 0.0);
  scene.Renderer->RemoveVolume(scene.Volume);
  scene.Renderer->AddActor(cone);
  scene.Window->Render();
  const DepthPicture cones(scene.Window, scene.Renderer);
  scene.Renderer->AddVolume(scene.Volume);
  const Picture both = RenderAndCapture(scene.Window);
  const DepthPicture nearest(scene.Window, scene.Renderer);
  int wrong = 0;
  int visible[2] = { 0, 0 };
  for (int y = 0; y < ball.GetHeight(); ++y)
  {
    for (int x = 0; x < ball.GetWidth(); ++x)
    {
      const double difference = ball.GetDepth(x, y) - cones.GetDepth(x, y);
      if (std::abs(difference) < 1e-6)
      {
        continue; // Both empty, or too near to call.
      }
      const bool isBall = difference < 0.0;
      ++visible[isBall ? 0 : 1];
      const std::size_t pixel = static_cast<std::size_t>(3 * (x + y * ball.GetWidth()));
      const double expected = std::min(ball.GetDepth(x, y), cones.GetDepth(x, y));
      wrong += both[pixel + (isBall ? 0 : 1)] == 255 && both[pixel + (isBall ? 1 : 0)] == 0 &&
          std::abs(nearest.GetDepth(x, y) - expected) < 1e-6
        ? 0
        : 1;
    }
  }
  std::cout << visible[0] << " pixels of the ball, " << visible[1] << " of the cone\n";
  check.That(visible[0] > 1000 && visible[1] > 500, "both are visible");
  check.Equal(wrong, 0, "the number of pixels that show the wrong one");
}

/// Two volumes that pierce each other look the same in both orders.
void CheckTwoVolumes(Checks& check, vtkImageData* image)
{
  Picture pictures[2];
  for (const bool swapped : { false, true })
  {
    Scene scene(image);
    vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
    mapper->SetInputData(image);
    vtkNew<vtkVolume> other;
    other->SetMapper(mapper);
    other->GetProperty()->DeepCopy(scene.Property());
    other->GetProperty()->ShadeOff();
    other->SetPosition(0.5, 0.3, 0.2);
    scene.Renderer->RemoveAllViewProps();
    scene.Renderer->AddVolume(swapped ? other.Get() : scene.Volume.Get());
    scene.Renderer->AddVolume(swapped ? scene.Volume.Get() : other.Get());
    pictures[swapped ? 1 : 0] = RenderAndCapture(scene.Window);
  }
  check.Equal(GetDifference(pictures[0], pictures[1], 0), 0.0,
    "the difference when the other volume is drawn first");
}

/// A translucent surface leaves no depth.
void CheckTranslucent(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 0.5);
  scene.Window->Render();
  check.That(DepthPicture(scene.Window, scene.Renderer).IsEmpty(80, 80),
    "a translucent surface writes no depth");
  scene.AddSurface(0.3, { 1.0, 0.0, 0.0 }, 1.0);
  scene.Window->Render();
  const AnalyticFields::Point p = DepthPicture(scene.Window, scene.Renderer).GetPoint(80, 80);
  check.Near(std::hypot(p[0], p[1], p[2]), 0.4, 2e-3, "the opaque ball within");
}

/// A translucent surface ends at what an earlier renderer has drawn, if its own keeps that.
void CheckEarlierRenderer(Checks& check, vtkImageData* image)
{
  Scene together(image);
  together.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 0.5);
  together.Renderer->AddActor(NewCone());
  const Picture expected = RenderAndCapture(together.Window);
  const auto erasesNot = [](vtkRenderer* renderer) { renderer->EraseOff(); };
  const auto preserves = [](vtkRenderer* renderer)
  {
    renderer->PreserveColorBufferOn();
    renderer->PreserveDepthBufferOn();
  };
  const std::vector<std::function<void(vtkRenderer*)>> ways = { erasesNot, preserves };
  for (const auto& keep : ways)
  {
    Scene scene(image);
    scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 0.5);
    scene.Window->RemoveRenderer(scene.Renderer);
    vtkNew<vtkRenderer> earlier;
    earlier->SetBackground(scene.Renderer->GetBackground());
    earlier->SetActiveCamera(scene.Renderer->GetActiveCamera());
    earlier->AddActor(NewCone());
    scene.Window->AddRenderer(earlier);
    scene.Window->AddRenderer(scene.Renderer);
    keep(scene.Renderer);
    scene.Renderer->GetActiveCamera()->SetClippingRange(
      together.Renderer->GetActiveCamera()->GetClippingRange());
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference over an earlier renderer");
  }
}

void CheckPicking(Checks& check, Scene& scene)
{
  vtkNew<vtkWorldPointPicker> picker;
  picker->Pick(70, 90, 0.0, scene.Renderer);
  const double* p = picker->GetPickPosition();
  check.Near(std::hypot(p[0], p[1], p[2]), 0.7, 2e-3, "the distance of the point picked");
}

}

int TestIsosurfaceRayTraceMapperDepth(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(33, 0.7);
  CheckNearest(check, image);
  CheckTwoVolumes(check, image);
  CheckTranslucent(check, image);
  CheckEarlierRenderer(check, image);
  Scene scene(image);
  scene.Window->Render();
  CheckPicking(check, scene);
  CheckOrders(check, scene);

  // A window with several samples per pixel is read another way.
  Scene multisampled(image);
  multisampled.Window->SetMultiSamples(8);
  multisampled.Renderer->AddActor(NewCone());
  const double difference =
    GetDifference(RenderAndCapture(multisampled.Window), Capture(scene.Window), 40);
  check.That(difference < 0.03, "with multisampling only the edges of the cone change");
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
