// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Isovalues, their colours and opacities: exact colours of pixels, without shading.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkActor.h>
#include <vtkPlaneSource.h>
#include <vtkProperty.h>

using namespace MapperTesting;

namespace
{

using Color = std::array<double, 3>;

const Color Red = { 0.8, 0.2, 0.1 };
const Color Green = { 0.1, 0.7, 0.2 };
const Color Blue = { 0.2, 0.3, 0.9 };
const Color Background = { 0.1, 0.2, 0.3 };

Color Over(const Color& front, double opacity, const Color& back)
{
  Color result;
  for (std::size_t i = 0; i < 3; ++i)
  {
    result[i] = opacity * front[i] + (1.0 - opacity) * back[i];
  }
  return result;
}

void CheckCenter(Checks& check, Scene& scene, const Color& expected, const std::string& what)
{
  scene.Window->Render();
  const std::array<int, 3> pixel = GetPixel(scene.Window, 80, 80);
  for (std::size_t i = 0; i < 3; ++i)
  {
    check.Near(pixel[i], 255.0 * expected[i], 1.01, what + ", channel " + std::to_string(i));
  }
}

/// A square through the middle of the world, across the line of sight.
vtkSmartPointer<vtkActor> NewSquare(double y)
{
  vtkNew<vtkPlaneSource> square;
  square->SetOrigin(-1.0, y, -1.0);
  square->SetPoint1(1.0, y, -1.0);
  square->SetPoint2(-1.0, y, 1.0);
  auto actor = NewActor(square);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
  return actor;
}

}

int TestIsosurfaceRayTraceMapperSurfaces(int argc, char* argv[])
{
  Checks check;
  // The isovalue of a ball is its radius subtracted from 0.5.
  const auto image = NewBall(33, 0.5);
  Scene scene(image);
  scene.Property()->ShadeOff();
  scene.LookFrom(0.0, -4.0, 0.0);

  scene.SetSurface(0.0, Red, 1.0);
  CheckCenter(check, scene, Red, "an opaque surface");
  scene.SetSurface(0.0, Red, 0.25);
  CheckCenter(check, scene, Over(Red, 0.25, Over(Red, 0.25, Background)),
    "a translucent ball has a front and a back");
  scene.AddSurface(0.2, Green, 0.5);
  CheckCenter(check, scene,
    Over(Red, 0.25, Over(Green, 0.5, Over(Green, 0.5, Over(Red, 0.25, Background)))),
    "a translucent ball in another");
  scene.AddSurface(0.3, Blue, 1.0);
  CheckCenter(check, scene, Over(Red, 0.25, Over(Green, 0.5, Blue)), "an opaque ball within two");

  // The same in another order, repeated, and with one that is invisible.
  vtkContourValues* isovalues = scene.Property()->GetIsoSurfaceValues();
  scene.Property()->GetScalarOpacity()->AddPoint(-0.2, 0.0);
  const double jumbled[] = { 0.3, 0.0, -0.2, 0.2, 0.0, 0.3, std::nan("") };
  for (int i = 0; i < 7; ++i)
  {
    isovalues->SetValue(i, jumbled[i]);
  }
  CheckCenter(check, scene, Over(Red, 0.25, Over(Green, 0.5, Blue)), "isovalues in any order");

  // The opacity is that of a surface, whatever the unit of distance.
  scene.SetSurface(0.0, Red, 0.25);
  scene.Property()->SetScalarOpacityUnitDistance(0.01);
  CheckCenter(check, scene, Over(Red, 0.25, Over(Red, 0.25, Background)), "the opacity");

  // Opaque geometry before, between and behind.
  const auto square = NewSquare(0.0);
  scene.Renderer->AddActor(square);
  CheckCenter(check, scene, Over(Red, 0.25, { 1.0, 1.0, 1.0 }), "a square in a translucent ball");
  square->SetPosition(0.0, -0.9, 0.0);
  CheckCenter(check, scene, { 1.0, 1.0, 1.0 }, "a square before the ball");
  square->SetPosition(0.0, 0.9, 0.0);
  CheckCenter(
    check, scene, Over(Red, 0.25, Over(Red, 0.25, { 1.0, 1.0, 1.0 })), "a square behind the ball");
  scene.Renderer->RemoveActor(square);

  // Gray transfer functions.
  vtkNew<vtkPiecewiseFunction> gray;
  gray->AddPoint(0.0, 0.6);
  scene.SetSurface(0.0, Red, 1.0);
  scene.Property()->SetColor(gray);
  CheckCenter(check, scene, { 0.6, 0.6, 0.6 }, "a gray surface");

  // No isovalue, or none in the range of the data: nothing is drawn, and nothing reported.
  vtkNew<EventCounter> errors;
  scene.Mapper->AddObserver(vtkCommand::ErrorEvent, errors);
  isovalues->SetNumberOfContours(0);
  CheckCenter(check, scene, Background, "no isovalue");
  isovalues->SetValue(0, 1e9);
  CheckCenter(check, scene, Background, "an isovalue out of range");
  check.Equal(errors->Count, 0, "the number of errors");

  // A picture of it all, shaded.
  vtkNew<vtkColorTransferFunction> colors;
  scene.Property()->SetColor(colors);
  scene.SetSurface(0.0, Red, 0.4);
  scene.AddSurface(0.2, Green, 0.5);
  scene.AddSurface(0.35, Blue, 1.0);
  scene.Property()->ShadeOn();
  scene.LookFrom(1.0, -2.0, 0.8);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
