// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Slider_h
#define Slider_h

#include "Place.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

#include <array>
#include <functional>

VTK_ABI_NAMESPACE_BEGIN
class vtkRenderWindowInteractor;
class vtkSliderRepresentation2D;
class vtkSliderWidget;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

/// A slider at the bottom of the window.
class Slider
{
public:
  /// The middle of the knob moves from Left to Right, halfway between Bottom and Top.
  Slider(vtkRenderWindowInteractor* interactor, const Place& place, const char* title,
    const std::function<void(double)>& onChange);
  ~Slider();
  Slider(const Slider&) = delete;
  Slider& operator=(const Slider&) = delete;

  void SetRange(double lowest, double highest);
  void SetValue(double value);
  void SetColor(const std::array<double, 3>& color);
  /// The slider that keys move is brighter.
  void SetActive(bool isActive);
  void SetVisible(bool isVisible);

private:
  void OnInteraction();

  std::function<void(double)> OnChange;
  vtkNew<vtkSliderRepresentation2D> Representation;
  vtkNew<vtkSliderWidget> Widget;
};

}

#endif
