// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Lights and materials: against polygons of the same ball, which VTK lights itself, and a baseline.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkActor.h>
#include <vtkLightCollection.h>
#include <vtkProperty.h>

#include <functional>

using namespace MapperTesting;

namespace
{

struct Setting
{
  std::string Name;
  std::function<void(vtkRenderer*)> AddLights;
};

std::vector<Setting> GetSettings()
{
  const std::array<double, 3> white = { 1.0, 1.0, 1.0 };
  std::vector<Setting> settings;
  settings.push_back({ "scene light", [=](vtkRenderer* renderer) {
                        renderer->AddLight(NewLight({ 3.0, -3.0, 2.0 }));
                      } });
  settings.push_back(
    { "camera light", [=](vtkRenderer* renderer) {
       renderer->AddLight(NewLight({ -1.0, 1.0, 0.5 }, white, VTK_LIGHT_TYPE_CAMERA_LIGHT));
     } });
  settings.push_back({ "two colours and one switched off",
    [=](vtkRenderer* renderer)
    {
      renderer->AddLight(NewLight({ 3.0, -2.0, 2.0 }, { 1.0, 0.3, 0.2 }));
      const auto blue = NewLight({ -3.0, -2.0, 0.0 }, { 0.2, 0.4, 1.0 });
      blue->SetIntensity(0.6);
      renderer->AddLight(blue);
      const auto off = NewLight({ 0.0, -3.0, 0.0 });
      off->SwitchOff();
      renderer->AddLight(off);
    } });
  settings.push_back({ "positional light",
    [=](vtkRenderer* renderer)
    {
      const auto light = NewLight({ 0.6, -1.2, 0.8 });
      light->PositionalOn();
      light->SetConeAngle(180.0);
      light->SetAttenuationValues(0.5, 0.2, 0.3);
      renderer->AddLight(light);
    } });
  settings.push_back({ "spot light",
    [=](vtkRenderer* renderer)
    {
      const auto light = NewLight({ 0.6, -1.6, 0.9 });
      light->PositionalOn();
      light->SetConeAngle(12.0);
      light->SetExponent(3.0);
      renderer->AddLight(light);
    } });
  return settings;
}

void SetMaterial(Scene& scene)
{
  scene.Property()->SetAmbient(0.15);
  scene.Property()->SetDiffuse(0.6);
  scene.Property()->SetSpecular(0.5);
  scene.Property()->SetSpecularPower(12.0);
  scene.SetSurface(0.0, { 0.9, 0.6, 0.3 }, 1.0);
}

/// The ball as polygons, of the same material.
vtkSmartPointer<vtkActor> NewPolygons(double radius)
{
  const auto actor = NewSphere(radius, { 0.0, 0.0, 0.0 }, 200);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPhong();
  property->SetColor(0.9, 0.6, 0.3);
  property->SetSpecularColor(1.0, 1.0, 1.0);
  property->SetAmbient(0.15);
  property->SetDiffuse(0.6);
  property->SetSpecular(0.5);
  property->SetSpecularPower(12.0);
  return actor;
}

void CheckAgainstPolygons(Checks& check, vtkImageData* image, const Setting& setting)
{
  Scene scene(image);
  SetMaterial(scene);
  setting.AddLights(scene.Renderer);
  const Picture traced = RenderAndCapture(scene.Window);
  scene.Renderer->RemoveVolume(scene.Volume);
  scene.Renderer->AddActor(NewPolygons(0.7));
  const Picture polygons = RenderAndCapture(scene.Window);
  // Silhouettes differ by a pixel here and there; all else to a few steps of colour.
  const double difference = GetDifference(traced, polygons, 3);
  std::cout << setting.Name << ": " << 100.0 * difference << " % of the pixels differ\n";
  check.That(difference < 0.01, setting.Name + " is as on polygons");
}

void CheckTwoSides(Checks& check, vtkImageData* image)
{
  // From within, with light from the eye: the inside of the ball is lit only if both sides are.
  Scene scene(image);
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetSpecular(0.0);
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(0.0, 0.0, 0.0);
  camera->SetFocalPoint(0.0, 1.0, 0.0);
  camera->SetClippingRange(0.01, 10.0);
  scene.Window->Render();
  check.That(GetPixel(scene.Window, 80, 80)[0] > 100, "two-sided lighting lights the inside");
  scene.Renderer->TwoSidedLightingOff();
  scene.Window->Render();
  check.Equal(GetPixel(scene.Window, 80, 80)[0], 0, "one-sided lighting of the inside");
}

}

int TestIsosurfaceRayTraceMapperLights(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(65, 0.7);
  const std::vector<Setting> settings = GetSettings();
  for (const Setting& setting : settings)
  {
    CheckAgainstPolygons(check, image, setting);
  }
  CheckTwoSides(check, image);

  // A picture: the settings above, and the default headlight, each in a viewport.
  Scene scene(image, 480, 320);
  SetMaterial(scene);
  std::vector<vtkSmartPointer<vtkRenderer>> renderers;
  for (std::size_t i = 0; i <= settings.size(); ++i)
  {
    const double x = static_cast<double>(i % 3) / 3.0;
    const double y = static_cast<double>(i / 3) / 2.0;
    renderers.push_back(
      i == 0 ? vtkSmartPointer<vtkRenderer>(scene.Renderer) : vtkSmartPointer<vtkRenderer>::New());
    vtkRenderer* renderer = renderers.back();
    renderer->SetViewport(x, y, x + 1.0 / 3.0, y + 0.5);
    if (i > 0)
    {
      renderer->AddVolume(scene.Volume);
      renderer->SetActiveCamera(scene.Renderer->GetActiveCamera());
      settings[i - 1].AddLights(renderer);
      scene.Window->AddRenderer(renderer);
    }
  }
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
