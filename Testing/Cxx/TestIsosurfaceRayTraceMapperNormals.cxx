// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Where normals come from: the facets of the interpolant on the left, a smooth look on the right.

#include "Checks.h"
#include "DepthPicture.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

using namespace MapperTesting;

int TestIsosurfaceRayTraceMapperNormals(int argc, char* argv[])
{
  Checks check;
  const auto image = NewBall(9, 0.7);
  Scene scene(image, 320, 160);
  check.Equal(scene.Mapper->GetNormalMode(),
    static_cast<int>(vtkIsosurfaceRayTraceMapper::CENTRAL_DIFFERENCES), "the default");
  scene.Mapper->SetNormalModeToInterpolantGradient();
  scene.Renderer->SetViewport(0.0, 0.0, 0.5, 1.0);

  vtkNew<vtkIsosurfaceRayTraceMapper> smooth;
  smooth->SetInputData(image);
  vtkNew<vtkVolume> volume;
  volume->SetMapper(smooth);
  volume->SetProperty(scene.Property());
  vtkNew<vtkRenderer> right;
  right->SetViewport(0.5, 0.0, 1.0, 1.0);
  right->AddVolume(volume);
  right->SetActiveCamera(scene.Renderer->GetActiveCamera());
  right->SetBackground(scene.Renderer->GetBackground());
  scene.Window->AddRenderer(right);
  check.That(IsBaseline(argc, argv, scene.Window), "the picture is the baseline");

  // The mode changes the shading and never the surface.
  const DepthPicture facets(scene.Window, scene.Renderer);
  const DepthPicture smoothed(scene.Window, right);
  int moved = 0;
  for (int y = 0; y < facets.GetHeight(); ++y)
  {
    for (int x = 0; x < facets.GetWidth(); ++x)
    {
      moved += facets.GetDepth(x, y) != smoothed.GetDepth(x, y) ? 1 : 0;
    }
  }
  check.Equal(moved, 0, "the number of pixels whose depth differs");
  return check.Result();
}
