// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Ambient occlusion of a floor by a ball above it, pixel by pixel, compared with the exact part of
// the hemisphere that a ball occludes.

#include "AnalyticFields.h"
#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkMath.h>
#include <vtkRectilinearGrid.h>

#include <functional>

using namespace MapperTesting;

namespace
{

using AnalyticFields::Point;

constexpr int Size = 200;
constexpr double Radius = 0.3;
constexpr double Ground = -0.5;
constexpr double Height = 0.4;

/// A ball above a floor.
double Field(const Point& p)
{
  return std::max(Ground - p[2], Radius - std::hypot(p[0], p[1], p[2] - Ground - Height));
}

/// The part of the hemisphere over a point of the floor, weighted by the cosine, that a ball wholly
/// above it does not occlude.
double GetOpenness(const Point& position)
{
  const double distance = std::hypot(position[0], position[1], Height);
  return 1.0 - Radius * Radius * Height / (distance * distance * distance);
}

/// The same samples at uneven distances, from a sixth to twice of those of a cube, with planes
/// where the floor is.
vtkSmartPointer<vtkRectilinearGrid> NewUnevenGrid()
{
  std::array<std::vector<double>, 3> coordinates;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= 80; ++i)
    {
      const double even = i / 40.0 - 1.0;
      const double wave = std::sin(2.0 * vtkMath::Pi() * (axis == 2 ? 2.0 : 1.0) * even);
      coordinates[axis].push_back(even + (axis == 2 ? 0.06 : -0.13) * wave);
    }
  }
  return NewGrid(coordinates, Field);
}

void SetLook(Scene& scene)
{
  scene.SetSurface(0.0, { 1.0, 1.0, 1.0 }, 1.0);
  scene.Property()->SetAmbient(1.0);
  scene.Property()->SetDiffuse(0.0);
  scene.Property()->SetSpecular(0.0);
  scene.Mapper->AmbientOcclusionOn();
}

/// The mean of the first channel less what geometry says, over the floor, and the largest such
/// difference.
std::array<double, 2> Compare(Scene& scene, const std::function<double(const Point&)>& openness)
{
  const auto picture = scene.RenderToImage();
  vtkPointData* data = picture->GetPointData();
  double sum = 0.0;
  double largest = 0.0;
  int count = 0;
  for (vtkIdType i = 0; i < picture->GetNumberOfPoints(); ++i)
  {
    Point position;
    data->GetArray("Position")->GetTuple(i, position.data());
    if (!(std::abs(position[2] - Ground) < 1e-6))
    {
      continue;
    }
    const double difference = data->GetArray("Colors")->GetTuple(i)[0] / 255.0 - openness(position);
    sum += difference;
    largest = std::max(largest, std::abs(difference));
    ++count;
  }
  return { count > 3000 ? sum / count : 1.0, largest };
}

/// On a grid whose planes are unevenly spaced the hemisphere is that of the world.
void CheckUneven(Checks& check)
{
  Scene scene(NewUnevenGrid(), Size, Size);
  SetLook(scene);
  scene.Mapper->SetNumberOfAmbientOcclusionRays(256);
  for (const double x : { 1.0, -1.0 })
  {
    scene.Volume->SetScale(x, 1.0, 1.0);
    const auto exact = Compare(scene, GetOpenness);
    check.Near(exact[0], 0.0, 0.004, "the mean error on an uneven grid");
    check.Near(exact[1], 0.0, 0.04, "the largest error on an uneven grid");
  }
  // The radius is one of the world.
  scene.Mapper->SetAmbientOcclusionRadius(0.9 * (Height - Radius));
  check.Equal(Compare(scene, [](const Point&) { return 1.0; })[1], 0.0,
    "the occlusion within a small radius on an uneven grid");
  scene.Mapper->SetAmbientOcclusionRadius(1.2 * (Height - Radius));
  check.That(Compare(scene, [](const Point&) { return 1.0; })[1] > 0.01,
    "the occlusion within a larger radius on an uneven grid");
}

}

int TestIsosurfaceRayTraceMapperOcclusion(int argc, char* argv[])
{
  Checks check;
  const auto image = NewCube(61, Field);
  Scene scene(image, Size, Size);
  SetLook(scene);
  check.Equal(scene.Mapper->GetNumberOfAmbientOcclusionRays(), 32, "the number of rays");
  scene.Mapper->SetNumberOfAmbientOcclusionRays(256);
  const auto exact = Compare(scene, GetOpenness);
  check.Near(exact[0], 0.0, 0.004, "the mean error of 256 rays");
  check.Near(exact[1], 0.0, 0.04, "the largest error of 256 rays");
  scene.Mapper->SetNumberOfAmbientOcclusionRays(16);
  const auto rough = Compare(scene, GetOpenness);
  check.Near(rough[0], 0.0, 0.006, "the mean error of 16 rays");
  check.Near(rough[1], 0.0, 0.3, "the largest error of 16 rays");

  // Nothing is nearer than the lowest point of the ball.
  scene.Mapper->SetAmbientOcclusionRadius(0.9 * (Height - Radius));
  check.Equal(Compare(scene, [](const Point&) { return 1.0; })[1], 0.0,
    "the occlusion within a small radius");
  scene.Mapper->SetAmbientOcclusionRadius(0.0);
  scene.Mapper->AmbientOcclusionOff();
  check.Equal(
    Compare(scene, [](const Point&) { return 1.0; })[1], 0.0, "the occlusion without occlusion");

  // The same bits in whatever tiles, by whatever number of threads.
  scene.Mapper->AmbientOcclusionOn();
  scene.Property()->SetAmbient(0.6);
  scene.Property()->SetDiffuse(0.5);
  const Picture expected = RenderAndCapture(scene.Window);
  for (const int threads : { 1, 3 })
  {
    scene.Mapper->SetNumberOfThreads(threads);
    scene.Mapper->SetTileSize(7 * threads, 5);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference with " + std::to_string(threads) + " threads");
  }
  scene.Property()->ShadeOff();
  scene.Mapper->AmbientOcclusionOff();
  const Picture unlit = RenderAndCapture(scene.Window);
  scene.Mapper->AmbientOcclusionOn();
  check.Equal(
    GetDifference(RenderAndCapture(scene.Window), unlit, 0), 0.0, "the occlusion without shading");

  CheckUneven(check);

  scene.Property()->ShadeOn();
  scene.Mapper->SetNumberOfAmbientOcclusionRays(64);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");
  return check.Result();
}
