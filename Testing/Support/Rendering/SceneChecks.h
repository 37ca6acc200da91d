// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SceneChecks_h
#define SceneChecks_h

#include "Checks.h"
#include "Pictures.h"
#include "TestScene.h"

#include <vtkPlane.h>

#include <string>

// Checks that are the same for every interpolation mode.

namespace MapperTesting
{

/// Lit from above, a convex object casts no shadow on itself and occludes nothing of itself; one
/// object above another does both.
inline void CheckShadows(Checks& check, Scene& scene, bool isConvex)
{
  scene.LookFrom(1.0, -2.0, 1.5);
  scene.Renderer->AddLight(NewLight({ 0.3, -0.2, 2.0 }));
  const Picture plain = RenderAndCapture(scene.Window);
  scene.Mapper->ShadowsOn();
  const double withShadows = GetDifference(RenderAndCapture(scene.Window), plain, 0);
  scene.Mapper->ShadowsOff();
  scene.Mapper->AmbientOcclusionOn();
  const double withOcclusion = GetDifference(RenderAndCapture(scene.Window), plain, 0);
  std::cout << (isConvex ? "One convex object" : "One object above another") << ": "
            << 100.0 * withShadows << " % of the pixels are in shadow, " << 100.0 * withOcclusion
            << " % are occluded\n";
  check.That(isConvex ? withShadows == 0.0 : withShadows > 0.005 && withShadows < 0.2,
    "shadows are where something is in the way of light");
  check.That(isConvex ? withOcclusion == 0.0 : withOcclusion > 0.01,
    "occlusion is where something is in the way of the ambient light");
}

/// The same bits with any number of threads, in any tiles, with any solver and layout.
inline void CheckDeterminism(Checks& check, Scene& scene)
{
  scene.SetSurface(0.0, { 0.9, 0.8, 0.7 }, 0.4);
  scene.AddSurface(0.3, { 0.3, 0.6, 0.9 }, 1.0);
  const Picture expected = RenderAndCapture(scene.Window);
  for (int layout = 0; layout < 3; ++layout)
  {
    scene.Mapper->SetBrickLayout(layout);
    scene.Mapper->SetNumberOfThreads(1 + layout);
    scene.Mapper->SetTileSize(7 + 30 * layout, 5);
    scene.Mapper->SetNumberOfMacrocellLevels(layout);
    scene.Mapper->SetMaximumBrickMemory(1);
    scene.Mapper->SetNormalMode(layout % 2);
    scene.Mapper->SetRootSolver(layout);
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference with layout " + std::to_string(layout));
  }
}

/// The scene of a baseline: shadows of a light beside a headlight, and a clipping plane.
inline void AddShadowsAndClipping(Scene& scene)
{
  scene.Mapper->ShadowsOn();
  scene.Renderer->AddLight(NewLight({ 2.0, -1.0, 3.0 }));
  vtkNew<vtkLight> headlight;
  headlight->SetLightTypeToHeadlight();
  headlight->SetIntensity(0.5);
  scene.Renderer->AddLight(headlight);
  vtkNew<vtkPlane> plane;
  plane->SetNormal(-0.5, 1.0, -0.6);
  plane->SetOrigin(0.0, -0.4, 0.55);
  scene.Mapper->AddClippingPlane(plane);
}

}

#endif
