// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Window_h
#define Window_h

#include "ClipPlane.h"
#include "FrameTimes.h"
#include "NumberEntry.h"
#include "PickedPoint.h"
#include "Refinement.h"
#include "Scene.h"
#include "SurfacePanel.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
class vtkObject;
class vtkOrientationMarkerWidget;
class vtkRenderWindow;
class vtkRenderWindowInteractor;
class vtkTextActor;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

class Scalars;

/// What --help and the window say of keys and mouse.
extern const char* const Controls;

/// The window: what keys and the mouse do in it.
class Window
{
public:
  /// The isovalues are those of Scene.
  Window(vtkDataObject* data, const Scalars& scalars, const std::vector<double>& isovalues,
    const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Returns when the window is closed.
  void Run();

  std::string SummarizeFrameTimes() const { return this->Times.Summarize(); }

private:
  void SetUpTexts();
  void SetUpAxes();
  void OnKey();
  void OnProblem(vtkObject*, unsigned long, void* report);
  void OnPress();
  void OnRelease();
  void UpdateTexts();
  void Do(const std::string& key);
  void FinishNumber();
  void StepIsovalue(double part);
  void ChangeColor();
  void ToggleSecondSurface();
  void Pick();
  void SetControlsVisible(bool areVisible);
  void WriteScreenshot();

  vtkNew<vtkRenderWindow> TheWindow;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkOrientationMarkerWidget> Axes;
  vtkNew<vtkTextActor> Status;
  vtkNew<vtkTextActor> Help;
  const double Lowest;
  const double Highest;
  Scene TheScene;
  FrameTimes Times;
  Refinement TheRefinement;
  SurfacePanel Panel;
  ClipPlane Clip;
  PickedPoint Picked;
  NumberEntry Entry;
  std::string Message;
  /// Of the left button, outside of the widgets.
  bool IsPressed = false;
  int PressedAt[2] = { 0, 0 };
};

}

#endif
