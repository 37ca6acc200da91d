// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is rebuilt, and what is not.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <functional>

using namespace MapperTesting;

namespace
{

struct Change
{
  std::string Name;
  std::function<void()> Make;
};

/// Whether the last frame built macrocells.
bool HasBuilt(Scene& scene)
{
  scene.Window->Render();
  return scene.Mapper->GetMacrocellBuildTime() > 0.0;
}

void CheckTimes(Checks& check, Scene& scene)
{
  check.That(HasBuilt(scene), "the first frame builds macrocells");
  check.That(scene.Mapper->GetBrickBuildTime() > 0.0, "the first frame makes bricks");
  check.That(scene.Mapper->GetTraceTime() > 0.0 && scene.Mapper->GetShadeTime() > 0.0 &&
      scene.Mapper->GetDisplayTime() > 0.0 && scene.Mapper->GetTimeToDraw() > 0.0,
    "it takes time");
  const double sum = scene.Mapper->GetMacrocellBuildTime() + scene.Mapper->GetBrickBuildTime() +
    scene.Mapper->GetTraceTime() + scene.Mapper->GetShadeTime() + scene.Mapper->GetDisplayTime();
  check.That(sum <= scene.Mapper->GetTimeToDraw(), "the parts are no more than the whole");
  check.That(!HasBuilt(scene), "the second frame builds no macrocells");
  check.Equal(scene.Mapper->GetBrickBuildTime(), 0.0, "the time for bricks of the second frame");
}

void CheckMemory(Checks& check, Scene& scene)
{
  // 65^3 samples: 8^3 + 1 macrocells of two doubles.
  check.Equal(scene.Mapper->GetMacrocellMemory(), vtkIdType{ (512 + 1) * 16 }, "macrocell memory");
  check.Equal(
    scene.Mapper->GetMaximumNumberOfBricks(), vtkIdType{ 512 }, "the bricks there may be");
  const vtkIdType bricks = scene.Mapper->GetNumberOfBricks();
  check.That(bricks > 0 && bricks < 400, "only bricks with the surface are made");
  // Bricks of 9^3 doubles, in whole cache lines, and masks of three times 512 bits, at most one for
  // every brick; for each of the 512 that there might be, a number in each of two tables.
  const vtkIdType brickMemory = scene.Mapper->GetBrickMemory() - 2 * 512 * 4;
  check.That(brickMemory > bricks * 5888 && brickMemory <= bricks * 5888 + 512 * 192,
    "the memory of bricks and masks");
}

/// Bricks are made where rays go: the near side of the ball first, the far side when it is visible.
void CheckBricksOnDemand(Checks& check, Scene& scene)
{
  scene.Mapper->Modified();
  const vtkIdType near = scene.Mapper->GetNumberOfBricks();
  scene.LookFrom(-1.0, 2.0, -0.8);
  scene.Window->Render();
  const vtkIdType both = scene.Mapper->GetNumberOfBricks();
  check.That(both > near + 20, "the other side of the ball has its own bricks");
  scene.LookFrom(1.0, -2.0, 0.8);
  scene.Window->Render();
  check.Equal(scene.Mapper->GetNumberOfBricks(), both, "the number of bricks of a known view");
}

}

int TestIsosurfaceRayTraceMapperCaching(int, char*[])
{
  Checks check;
  const auto image = NewBall(65, 0.7);
  Scene scene(image);
  CheckTimes(check, scene);
  CheckMemory(check, scene);
  CheckBricksOnDemand(check, scene);

  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  vtkVolumeProperty* property = scene.Property();
  vtkIsosurfaceRayTraceMapper* mapper = scene.Mapper;
  const std::vector<Change> harmless = {
    { "an isovalue", [=]() { property->GetIsoSurfaceValues()->SetValue(0, 0.1); } },
    { "a second isovalue", [=]() { property->GetIsoSurfaceValues()->SetValue(1, -0.1); } },
    { "a colour", [=]() { property->GetRGBTransferFunction()->AddRGBPoint(0.1, 1.0, 0.0, 0.0); } },
    { "the camera", [&]() { scene.Renderer->GetActiveCamera()->Azimuth(30.0); } },
    { "the material", [=]() { property->SetSpecular(0.7); } },
    { "the matrix of the volume", [&]() { scene.Volume->SetScale(1.1); } },
    { "the normals", [=]() { mapper->SetNormalModeToInterpolantGradient(); } },
    { "the number of threads", [=]() { mapper->SetNumberOfThreads(1); } },
    { "the tiles", [=]() { mapper->SetTileSize(32, 4); } },
  };
  for (const Change& change : harmless)
  {
    const vtkIdType bricks = mapper->GetNumberOfBricks();
    change.Make();
    check.That(!HasBuilt(scene), "nothing is rebuilt for " + change.Name);
    check.That(mapper->GetNumberOfBricks() >= bricks, "bricks are kept for " + change.Name);
  }

  const auto other = NewBall(65, 0.5);
  const auto large = NewBall(70, 0.5);
  const std::vector<Change> rebuilding = {
    { "the scalars, with Modified() of the array", [=]() { scalars->Modified(); } },
    { "the scalars, with Modified() of the image", [=]() { image->Modified(); } },
    { "the scalars and the spacing at once, with Modified() of the array",
      [=]()
      {
        scalars->Modified();
        image->SetSpacing(0.03, 0.032, 0.035);
      } },
    { "the scalars and the spacing at once, with Modified() of the image",
      [=]()
      {
        image->Modified();
        image->SetSpacing(0.031, 0.032, 0.033);
      } },
    { "the scalars and the origin at once",
      [=]()
      {
        image->SetOrigin(-1.0, -1.1, -1.2);
        image->Modified();
      } },
    // Nothing tells it from a change of the scalars.
    { "the direction",
      [=]() { image->SetDirectionMatrix(0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0); } },
    { "another array",
      [=]() { image->GetPointData()->SetScalars(other->GetPointData()->GetScalars()); } },
    { "another image", [=]() { mapper->SetInputData(large); } },
    { "the layout", [=]() { mapper->SetBrickLayoutToTwoLevelBricks(); } },
    { "the size of bricks", [=]() { mapper->SetBrickSize(4); } },
    { "the size of groups", [=]() { mapper->SetBrickGroupSize(2); } },
    { "the number of levels", [=]() { mapper->SetNumberOfMacrocellLevels(3); } },
    { "the branching", [=]() { mapper->SetMacrocellBranching(0, 4); } },
  };
  for (const Change& change : rebuilding)
  {
    check.That(!HasBuilt(scene), "before " + change.Name + " nothing is rebuilt");
    change.Make();
    check.That(HasBuilt(scene), "macrocells are rebuilt for " + change.Name);
  }

  // An isovalue out of range needs no brick at all.
  Scene beyond(other);
  beyond.SetSurface(1e6, { 1.0, 1.0, 1.0 }, 1.0);
  beyond.Window->Render();
  check.Equal(beyond.Mapper->GetNumberOfBricks(), vtkIdType{ 0 }, "bricks of no surface");

  // Values that are changed in memory are visible after Modified().
  const Picture before = RenderAndCapture(beyond.Window);
  vtkDataArray* values = other->GetPointData()->GetScalars();
  values->Fill(0.0);
  for (vtkIdType i = 0; i < values->GetNumberOfTuples() / 2; ++i)
  {
    values->SetComponent(i, 0, 2e6);
  }
  values->Modified();
  check.That(GetDifference(RenderAndCapture(beyond.Window), before, 0) > 0.05,
    "new values in the old array are drawn");
  values->Fill(0.0);
  other->SetOrigin(-0.9, -0.9, -0.9);
  other->Modified();
  check.Equal(GetDifference(RenderAndCapture(beyond.Window), before, 0), 0.0,
    "new values with another origin are drawn");
  return check.Result();
}
