// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Translucent polygons across the view, and depth peeling of them.

#ifndef Screens_h
#define Screens_h

#include "TestScene.h"

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <array>

namespace MapperTesting
{

/// A square across the view, so far towards the camera.
inline vtkSmartPointer<vtkActor> NewScreen(
  double y, const std::array<double, 3>& color, double opacity)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-0.2, y, -0.9);
  plane->SetPoint1(0.9, y, -0.9);
  plane->SetPoint2(-0.2, y, 0.5);
  auto actor = NewActor(plane);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

/// Behind, through and before a ball around the origin.
inline void AddScreens(vtkRenderer* renderer)
{
  renderer->AddActor(NewScreen(-0.9, { 1.0, 0.2, 0.2 }, 0.4));
  renderer->AddActor(NewScreen(0.0, { 0.2, 1.0, 0.2 }, 0.5));
  renderer->AddActor(NewScreen(0.9, { 0.2, 0.2, 1.0 }, 0.6));
  renderer->ResetCameraClippingRange();
}

inline void PeelDepths(vtkRenderer* renderer)
{
  renderer->UseDepthPeelingOn();
  renderer->SetMaximumNumberOfPeels(20);
  renderer->SetOcclusionRatio(0.0);
}

}

#endif
