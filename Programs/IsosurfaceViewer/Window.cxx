// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Window.h"

#include "CameraStyle.h"
#include "ObserveAlways.h"
#include "Scalars.h"
#include "Screenshot.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkOrientationMarkerWidget.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace Viewer
{

const char* const Controls =
  R"(mouse            drag to turn; with Shift to move, with Ctrl to roll; the wheel zooms
click, p         position and value of the surface under the mouse
digits, Return   type the isovalue of the active surface; Escape cancels
Up, Down         raise or lower it by 1 % of the range
Tab              make the other surface the active one
a                add or remove the second surface
c                next colour of the active surface
x                clip plane on or off: drag its edge, its arrow or its centre
k                caps, which close what is clipped, on or off
s, o, i          shadows, ambient occlusion, cubic interpolation on or off
r                show the surfaces whole, from the same side
w                write a picture, vtkIsosurfaceViewer-<number>.png
h, ?             this help on or off
q                quit
)";

namespace
{

/// While something moves. VTK shares the time with the renderer of the axes.
constexpr double FramesPerSecond = 25.0;

/// Where VTK finds no display, its windows are in memory.
bool IsOnScreen(vtkRenderWindow* window)
{
  return !window->IsA("vtkEGLRenderWindow") && !window->IsA("vtkOSOpenGLRenderWindow") &&
    (!window->IsA("vtkXOpenGLRenderWindow") || window->GetGenericDisplayId() != nullptr);
}

/// After the widgets.
constexpr float BeforeStyle = 0.1F;

constexpr std::array<std::array<double, 3>, 8> Palette = { {
  { 0.96, 0.90, 0.80 },
  { 0.90, 0.58, 0.46 },
  { 0.80, 0.25, 0.22 },
  { 0.93, 0.77, 0.32 },
  { 0.45, 0.72, 0.45 },
  { 0.35, 0.65, 0.78 },
  { 0.66, 0.55, 0.80 },
  { 0.80, 0.82, 0.85 },
} };

//------------------------------------------------------------------------------
void PlaceText(vtkTextActor* text, double x, double y, int size)
{
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->GetPositionCoordinate()->SetValue(x, y);
  text->GetTextProperty()->SetVerticalJustificationToTop();
  text->GetTextProperty()->SetFontSize(size);
  text->GetTextProperty()->SetColor(0.95, 0.95, 0.95);
}

}

//------------------------------------------------------------------------------
Window::Window(vtkDataObject* data, const Scalars& scalars, const std::vector<double>& isovalues,
  const std::string& title)
  : Lowest(scalars.GetLowest())
  , Highest(scalars.GetHighest())
  , TheScene(data, scalars, isovalues)
  , Times(this->TheWindow, this->TheScene.GetMapper())
  , TheRefinement(this->Interactor, this->TheScene.GetMapper())
  , Panel(this->Interactor, this->TheScene, scalars)
  , Clip(this->Interactor, this->TheScene)
  , Picked(this->TheScene, scalars)
{
  this->TheWindow->SetWindowName((title + " - vtkIsosurfaceViewer").c_str());
  this->TheWindow->SetMultiSamples(0); // Rays make smooth edges.
  this->TheWindow->SetSize(1000, 800);
  this->TheWindow->AddRenderer(this->TheScene.GetRenderer());
  this->Interactor->SetRenderWindow(this->TheWindow);
  vtkNew<CameraStyle> style;
  this->Interactor->SetInteractorStyle(style);
  this->Interactor->SetDesiredUpdateRate(FramesPerSecond);
  // The window takes a new size from the X server without a word to what is laid out in pixels.
  this->Interactor->AddObserver(
    vtkCommand::ConfigureEvent, this->TheWindow.Get(), &vtkRenderWindow::Modified);
  this->Interactor->AddObserver(vtkCommand::KeyPressEvent, this, &Window::OnKey);
  this->Interactor->AddObserver(
    vtkCommand::LeftButtonPressEvent, this, &Window::OnPress, BeforeStyle);
  ObserveAlways(
    this->Interactor.Get(), vtkCommand::LeftButtonReleaseEvent, this, &Window::OnRelease);
  for (const unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    this->TheScene.GetMapper()->AddObserver(event, this, &Window::OnProblem);
  }
  this->SetUpTexts();
  this->SetUpAxes();
}

//------------------------------------------------------------------------------
Window::~Window() = default;

//------------------------------------------------------------------------------
void Window::Run()
{
  this->Interactor->Initialize();
  if (!IsOnScreen(this->TheWindow))
  {
    throw std::runtime_error(
      "there is no display to open a window on; vtkIsosurfaceRender and Python's render draw "
      "pictures without one");
  }
  this->TheScene.FrameSurfaces(); // now that the window has its size
  this->SetControlsVisible(true);
  this->Axes->SetEnabled(1);
  this->Axes->InteractiveOff();
  this->Interactor->Render();
  this->TheRefinement.Start();
  this->Interactor->Start();
}

//------------------------------------------------------------------------------
void Window::SetUpTexts()
{
  PlaceText(this->Status, 0.012, 0.985, 15);
  PlaceText(this->Help, 0.05, 0.88, 14);
  this->Help->SetInput(Controls);
  this->Help->GetTextProperty()->SetFontFamilyToCourier();
  this->Help->GetTextProperty()->SetBackgroundColor(0.1, 0.1, 0.12);
  this->Help->GetTextProperty()->SetBackgroundOpacity(0.8);
  this->Help->VisibilityOff();
  vtkRenderer* renderer = this->TheScene.GetRenderer();
  renderer->AddViewProp(this->Status);
  renderer->AddViewProp(this->Help);
  renderer->AddObserver(vtkCommand::StartEvent, this, &Window::UpdateTexts);
}

//------------------------------------------------------------------------------
void Window::SetUpAxes()
{
  vtkNew<vtkAxesActor> axes;
  axes->SetXAxisLabelText("x");
  axes->SetYAxisLabelText("y");
  axes->SetZAxisLabelText("z");
  this->Axes->SetOrientationMarker(axes);
  this->Axes->SetViewport(0.86, 0.82, 1.0, 1.0);
  this->Axes->SetInteractor(this->Interactor);
  this->Axes->KeyPressActivationOff();
}

//------------------------------------------------------------------------------
void Window::UpdateTexts()
{
  const std::string& typed = this->Entry.GetText();
  const std::string last = !typed.empty() ? "isovalue: " + typed + "_"
    : this->Message.empty()               ? "h: help"
                                          : this->Message;
  const std::string& picked = this->Picked.Describe();
  const std::string text =
    this->Times.Describe() + "\n" + last + (picked.empty() ? "" : "\n" + picked);
  this->Status->SetInput(text.c_str());
}

//------------------------------------------------------------------------------
/// Shows what the mapper reports while it draws: the texts are drawn after it.
void Window::OnProblem(vtkObject*, unsigned long, void* report)
{
  const std::string text = static_cast<const char*>(report);
  const std::string afterAddress = "): ";
  const std::size_t place = text.find(afterAddress);
  this->Message = place == std::string::npos ? text : text.substr(place + afterAddress.size());
  this->Message.erase(this->Message.find_last_not_of('\n') + 1);
  this->UpdateTexts();
}

//------------------------------------------------------------------------------
void Window::OnKey()
{
  const std::string key = this->Interactor->GetKeySym() ? this->Interactor->GetKeySym() : "";
  this->Message.clear();
  switch (this->Entry.TakeKey(key, this->Interactor->GetKeyCode()))
  {
    case NumberEntry::Result::Ignored:
      this->Do(key);
      break;
    case NumberEntry::Result::Finished:
      this->FinishNumber();
      break;
    case NumberEntry::Result::Typing:
    case NumberEntry::Result::Cancelled:
      break;
  }
  this->Interactor->Render();
}

//------------------------------------------------------------------------------
void Window::Do(const std::string& key)
{
  struct Action
  {
    const char* Key;
    std::function<void()> Do;
  };
  vtkIsosurfaceRayTraceMapper* mapper = this->TheScene.GetMapper();
  const Action actions[] = {
    { "Up", [this] { this->StepIsovalue(0.01); } },
    { "Down", [this] { this->StepIsovalue(-0.01); } },
    { "Tab", [this] { this->Panel.SetActive((this->Panel.GetActive() + 1) % NumberOfSurfaces); } },
    { "a", [this] { this->ToggleSecondSurface(); } },
    { "c", [this] { this->ChangeColor(); } },
    { "x", [this] { this->Clip.SetOn(!this->Clip.IsOn()); } },
    { "k", [mapper] { mapper->SetCapClippingPlanes(!mapper->GetCapClippingPlanes()); } },
    { "s", [this] { this->TheScene.ToggleShadows(); } },
    { "o", [this] { this->TheScene.ToggleAmbientOcclusion(); } },
    { "i", [this] { this->TheScene.ToggleCubicInterpolation(); } },
    { "p", [this] { this->Pick(); } },
    { "r", [this] { this->TheScene.FrameSurfaces(); } },
    { "w", [this] { this->WriteScreenshot(); } },
    { "h", [this] { this->Help->SetVisibility(!this->Help->GetVisibility()); } },
    { "question", [this] { this->Help->SetVisibility(!this->Help->GetVisibility()); } },
    { "q", [this] { this->Interactor->ExitCallback(); } },
  };
  const auto* action = std::find_if(std::begin(actions), std::end(actions),
    [&key](const Action& candidate) { return key == candidate.Key; });
  if (action != std::end(actions))
  {
    action->Do();
  }
}

//------------------------------------------------------------------------------
void Window::FinishNumber()
{
  const std::optional<double> number = this->Entry.GetNumber();
  if (!number)
  {
    this->Message = "That is not a number.";
    return;
  }
  Surface surface = this->TheScene.GetSurface(this->Panel.GetActive());
  surface.Isovalue = std::clamp(*number, this->Lowest, this->Highest);
  if (surface.Isovalue != *number)
  {
    std::ostringstream text;
    text << "The values are from " << this->Lowest << " to " << this->Highest << ".";
    this->Message = text.str();
  }
  this->TheScene.SetSurface(this->Panel.GetActive(), surface);
  this->Panel.Update();
}

//------------------------------------------------------------------------------
void Window::StepIsovalue(double part)
{
  Surface surface = this->TheScene.GetSurface(this->Panel.GetActive());
  surface.Isovalue = std::clamp(
    surface.Isovalue + part * (this->Highest - this->Lowest), this->Lowest, this->Highest);
  this->TheScene.SetSurface(this->Panel.GetActive(), surface);
  this->Panel.Update();
}

//------------------------------------------------------------------------------
void Window::ChangeColor()
{
  Surface surface = this->TheScene.GetSurface(this->Panel.GetActive());
  const auto place = std::find(Palette.begin(), Palette.end(), surface.Color);
  surface.Color = place + 1 < Palette.end() ? *(place + 1) : Palette.front();
  this->TheScene.SetSurface(this->Panel.GetActive(), surface);
  this->Panel.Update();
}

//------------------------------------------------------------------------------
void Window::ToggleSecondSurface()
{
  Surface surface = this->TheScene.GetSurface(1);
  surface.IsVisible = !surface.IsVisible;
  this->TheScene.SetSurface(1, surface);
  this->Panel.SetActive(surface.IsVisible ? 1 : 0);
}

//------------------------------------------------------------------------------
void Window::OnPress()
{
  this->Interactor->GetEventPosition(this->PressedAt);
  this->IsPressed = true;
}

//------------------------------------------------------------------------------
/// A press that the mouse has not moved since is a click.
void Window::OnRelease()
{
  const int* position = this->Interactor->GetEventPosition();
  constexpr int most = 2; // pixels
  if (this->IsPressed && std::abs(position[0] - this->PressedAt[0]) <= most &&
    std::abs(position[1] - this->PressedAt[1]) <= most)
  {
    this->Pick();
    this->Interactor->Render();
  }
  this->IsPressed = false;
}

//------------------------------------------------------------------------------
void Window::Pick()
{
  const int* position = this->Interactor->GetEventPosition();
  this->Picked.Pick(position[0], position[1]);
  if (this->Picked.Describe().empty())
  {
    this->Message = "There is no surface under the mouse.";
  }
}

//------------------------------------------------------------------------------
void Window::SetControlsVisible(bool areVisible)
{
  this->Panel.SetVisible(areVisible);
  this->Clip.SetWidgetVisible(areVisible);
  this->Status->SetVisibility(areVisible);
  // The sliders leave a window whose middle is higher.
  this->TheScene.GetRenderer()->GetActiveCamera()->SetWindowCenter(0.0, areVisible ? -0.14 : 0.0);
}

//------------------------------------------------------------------------------
/// Of the scene without the controls, when it is as good as it gets.
void Window::WriteScreenshot()
{
  const int help = this->Help->GetVisibility();
  this->Help->VisibilityOff();
  this->SetControlsVisible(false);
  this->TheWindow->SetDesiredUpdateRate(this->Interactor->GetStillUpdateRate());
  do
  {
    this->Interactor->Render();
  } while (!this->TheRefinement.IsFinished());
  try
  {
    this->Message = "written: " + Viewer::WriteScreenshot(this->TheWindow);
  }
  catch (const std::exception& error)
  {
    this->Message = error.what();
  }
  this->SetControlsVisible(true);
  this->Help->SetVisibility(help);
}

}
