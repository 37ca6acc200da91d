// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Windows that come and go, events, aborting, selecting, and depth peeling beside a volume.

#include "Checks.h"
#include "Pictures.h"
#include "TestImages.h"
#include "TestScene.h"

#include <vtkHardwareSelector.h>
#include <vtkInformation.h>
#include <vtkInformationObjectBaseKey.h>
#include <vtkProperty.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>

using namespace MapperTesting;

namespace
{

/// One mapper in two windows at once, one after the other, after release, and after a resize.
void CheckWindows(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  const Picture expected = RenderAndCapture(scene.Window);
  for (int i = 0; i < 2; ++i)
  {
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(scene.Renderer->GetBackground());
    renderer->AddVolume(scene.Volume);
    renderer->SetActiveCamera(scene.Renderer->GetActiveCamera());
    vtkNew<vtkRenderWindow> window;
    window->SetMultiSamples(0);
    window->SetSize(160, 160);
    window->AddRenderer(renderer);
    check.Equal(GetDifference(RenderAndCapture(window), expected, 0), 0.0,
      "the difference in another window");
    check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
      "the difference back in the first window");
    check.Equal(GetDifference(RenderAndCapture(window), expected, 0), 0.0,
      "the difference in the other window again");
  }
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the other windows are gone");
  scene.Volume->ReleaseGraphicsResources(scene.Window);
  scene.Volume->ReleaseGraphicsResources(scene.Window);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after release");
  scene.Window->SetSize(90, 120);
  scene.Window->Render();
  scene.Window->SetSize(160, 160);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the window was smaller");
  scene.Renderer->GetViewProps()->RemoveItem(scene.Volume); // It is not told what happens.
  scene.Window->Finalize();
  scene.Window->Render();
  scene.Renderer->AddVolume(scene.Volume);
  check.Equal(GetDifference(RenderAndCapture(scene.Window), expected, 0), 0.0,
    "the difference after the window was finalized");
  scene.Window->Finalize();
}

/// So that progress, which is reported fifty times a second, is reported several times in a frame.
void RenderSlowly(Scene& scene)
{
  scene.Mapper->AmbientOcclusionOn();
  scene.Mapper->SetNumberOfAmbientOcclusionRays(256);
  scene.Mapper->SetNumberOfThreads(1);
}

void CheckEvents(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  RenderSlowly(scene);
  vtkNew<EventCounter> starts;
  vtkNew<EventCounter> steps;
  vtkNew<EventCounter> ends;
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderStartEvent, starts);
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderProgressEvent, steps);
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderEndEvent, ends);
  scene.Window->Render();
  check.Equal(starts->Count, 1, "the number of start events");
  check.Equal(ends->Count, 1, "the number of end events");
  check.That(steps->Count > 3, "there is progress");
}

void CheckAbort(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  RenderSlowly(scene);
  const Picture whole = RenderAndCapture(scene.Window);
  scene.Volume->VisibilityOff();
  const Picture empty = RenderAndCapture(scene.Window);
  scene.Volume->VisibilityOn();
  vtkNew<EventCounter> steps;
  scene.Mapper->AddObserver(vtkCommand::VolumeMapperRenderProgressEvent, steps);
  // A tile may be the whole picture: abort is checked after each packet of rays in it.
  for (const int size : { 8, 4096 })
  {
    scene.Mapper->SetTileSize(size, size);
    steps->Count = 0;
    RenderAndAbort(scene.Window);
    check.Equal(steps->Count, 1, "the number of steps before the abort");
    check.Equal(
      GetDifference(Capture(scene.Window), empty, 0), 0.0, "what an aborted frame has drawn");
    check.Equal(GetDifference(RenderAndCapture(scene.Window), whole, 0), 0.0,
      "the difference of the frame after the aborted one");
    check.That(steps->Count > 4, "there is progress, whatever the size of tiles");
  }
}

/// The volume hides from a selection what it hides in the picture.
void CheckSelection(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  const auto sphere = NewSphere(0.3, { 0.0, 1.4, 0.0 }, 40);
  scene.Renderer->AddActor(sphere);
  scene.LookFrom(0.0, -4.0, 0.0);
  const Picture before = RenderAndCapture(scene.Window);
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(scene.Renderer);
  selector->SetArea(0, 0, 159, 159);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  check.Equal(selection->GetNumberOfNodes(), 1U, "the number of props selected");
  if (selection->GetNumberOfNodes() == 1)
  {
    check.That(
      selection->GetNode(0)->GetProperties()->Get(vtkSelectionNode::PROP()) == scene.Volume.Get(),
      "the volume is selected, and not the sphere behind it");
  }
  check.Equal(GetDifference(RenderAndCapture(scene.Window), before, 0), 0.0,
    "the difference after a selection");
}

/// Depth peeling of polygons works beside the volume.
void CheckDepthPeeling(Checks& check, vtkImageData* image)
{
  Scene scene(image);
  const auto glass = NewSphere(0.4, { 0.9, -0.5, 0.0 }, 40);
  glass->GetProperty()->SetOpacity(0.4);
  scene.Renderer->AddActor(glass);
  const Picture plain = RenderAndCapture(scene.Window);
  scene.Window->AlphaBitPlanesOn();
  scene.Renderer->UseDepthPeelingOn();
  const Picture peeled = RenderAndCapture(scene.Window);
  check.That(GetDifference(peeled, plain, 60) < 0.01, "a peeled picture is much the same");
}

}

int TestIsosurfaceRayTraceMapperResources(int, char*[])
{
  Checks check;
  const auto image = NewBall(33, 0.7);
  CheckWindows(check, image);
  CheckEvents(check, image);
  CheckAbort(check, image);
  CheckSelection(check, image);
  CheckDepthPeeling(check, image);
  return check.Result();
}
