// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Shadows of a small ball on a large one, pixel by pixel, where geometry puts them; and no others.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMath.h>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

constexpr int Size = 200;
constexpr Point LargeCenter = { 0.0, 0.0, -0.3 };
constexpr double LargeRadius = 0.6;
constexpr Point SmallCenter = { 0.15, 0.0, 0.6 };
constexpr double SmallRadius = 0.2;

double Balls(const Point& p)
{
  return std::max(
    LargeRadius - std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), LargeCenter.data())),
    SmallRadius - std::sqrt(vtkMath::Distance2BetweenPoints(p.data(), SmallCenter.data())));
}

/// How near a line from a point passes by a ball, less its radius: negative if it goes through.
/// Only up to a length.
double GetDistance(
  const Point& from, const Point& direction, double length, const Point& center, double radius)
{
  Point way;
  vtkMath::Subtract(center.data(), from.data(), way.data());
  const double along = std::clamp(vtkMath::Dot(way, direction), 0.0, length);
  double square = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    square += std::pow(from[axis] + along * direction[axis] - center[axis], 2);
  }
  return std::sqrt(square) - radius;
}

/// Draws with one light, and compares what is lit with what geometry says, but near the edges.
void Compare(Checks& check, vtkImageData* image, vtkLight* light, const std::string& name)
{
  Scene scene(image, Size, Size);
  scene.Mapper->ShadowsOn();
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetDiffuse(1.0);
  scene.Property()->SetSpecular(0.0);
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  vtkNew<vtkLightCollection> lights;
  lights->AddItem(light);
  const auto picture = scene.RenderToImage(lights);
  vtkPointData* data = picture->GetPointData();
  int lit = 0;
  int shadowed = 0;
  int wrong = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    if (data->GetArray("CellId")->GetTuple1(i) < 0.0)
    {
      continue;
    }
    Point position;
    data->GetArray("Position")->GetTuple(i, position.data());
    Point normal;
    data->GetArray("Normals")->GetTuple(i, normal.data());
    Point direction;
    double length = 100.0;
    vtkMath::Subtract(light->GetPosition(), light->GetFocalPoint(), direction.data());
    if (light->GetPositional())
    {
      vtkMath::Subtract(light->GetPosition(), position.data(), direction.data());
      length = vtkMath::Norm(direction.data());
    }
    vtkMath::Normalize(direction.data());
    const bool isOnSmall = std::sqrt(vtkMath::Distance2BetweenPoints(
                             position.data(), SmallCenter.data())) < SmallRadius + 0.05;
    const double distance = isOnSmall
      ? GetDistance(position, direction, length, LargeCenter, LargeRadius)
      : GetDistance(position, direction, length, SmallCenter, SmallRadius);
    Point toEye;
    vtkMath::Subtract(
      scene.Renderer->GetActiveCamera()->GetPosition(), position.data(), toEye.data());
    // At the silhouette a smooth normal may look away, and is turned round.
    if (vtkMath::Dot(normal, direction) < 0.15 || vtkMath::Dot(normal, toEye) < 0.1 ||
      std::abs(distance) < 0.03)
    {
      continue;
    }
    const bool isLit = data->GetArray("Colors")->GetComponent(i, 0) > 0.0;
    wrong += isLit == (distance > 0.0) ? 0 : 1;
    (distance > 0.0 ? lit : shadowed) += 1;
  }
  check.That(lit > 1000, std::to_string(lit) + " pixels are lit " + name);
  check.That(shadowed > 100, std::to_string(shadowed) + " pixels are in the shadow " + name);
  check.Equal(wrong, 0, "the number of pixels judged wrong " + name);
}

vtkSmartPointer<vtkLight> NewLamp(const Point& position)
{
  const auto lamp = NewLight(position);
  lamp->PositionalOn();
  lamp->SetConeAngle(180.0);
  return lamp;
}

/// A translucent surface transmits a part of the light.
void CheckTranslucent(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  scene.Property()->SetAmbient(0.0);
  scene.Property()->SetDiffuse(1.0);
  scene.Property()->SetSpecular(0.0);
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 0.5);
  // From below the small ball, at the light behind it: lit through two of its walls.
  vtkCamera* camera = scene.Renderer->GetActiveCamera();
  camera->SetPosition(3.0, 0.0, 0.6);
  camera->SetFocalPoint(0.15, 0.0, 0.3);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetClippingRange(0.1, 10.0);
  vtkNew<vtkLightCollection> lights;
  lights->AddItem(NewLight({ 0.0, 0.0, 1.0 }));
  vtkNew<vtkImageData> picture[2];
  for (const int shadows : { 0, 1 })
  {
    scene.Mapper->SetShadows(shadows != 0);
    scene.Mapper->RenderToImage(scene.Volume, camera, lights, Size, Size, picture[shadows]);
  }
  int quarters = 0;
  int others = 0;
  vtkPointData* data = picture[0]->GetPointData();
  for (vtkIdType i = 0; i < picture[0]->GetNumberOfPoints(); ++i)
  {
    Point position;
    data->GetArray("Position")->GetTuple(i, position.data());
    const double fromAxis = std::hypot(position[0] - SmallCenter[0], position[1] - SmallCenter[1]);
    const double before = data->GetArray("Colors")->GetComponent(i, 0);
    const double after = picture[1]->GetPointData()->GetArray("Colors")->GetComponent(i, 0);
    // The near side of the large ball, below the small one. (Its far side is lit through a wall of
    // its own.)
    if (!(position[2] > 0.0 && position[2] < 0.35 && fromAxis < SmallRadius - 0.03) ||
      before < 40.0)
    {
      continue;
    }
    others += after < before ? 0 : 1;
    quarters += after < before ? 1 : 0;
  }
  check.That(
    quarters > 50, std::to_string(quarters) + " pixels are darker below a translucent ball");
  check.Equal(others, 0, "the number of pixels there that are not");
}

}

int TestIsosurfaceRayTraceMapperShadows(int argc, char* argv[])
{
  Checks check;
  const auto image = NewCube(81, Balls);
  Compare(check, image, NewLight({ 0.1, -0.2, 1.0 }), "by a distant light");
  Compare(check, image, NewLight({ 0.0, 0.0, 1.0 }), "by a light along the lattice");
  Compare(check, image, NewLamp({ 0.4, -0.3, 2.0 }), "by a near light");
  CheckTranslucent(check, image);
  Scene scene(image, Size, Size);
  scene.Mapper->ShadowsOn();
  scene.Renderer->AddLight(NewLight({ 0.2, -0.3, 1.0 }));
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");

  // Between the balls, a light shines on both.
  Scene between(image, Size, Size);
  between.Mapper->ShadowsOn();
  between.Renderer->AddLight(NewLamp({ 0.15, 0.0, 0.35 }));
  const Picture with = RenderAndCapture(between.Window);
  between.Mapper->ShadowsOff();
  const Picture without = RenderAndCapture(between.Window);
  check.That(
    GetDifference(with, without, 1) < 0.005, "a light between the balls has no shadow to cast");
  return check.Result();
}
