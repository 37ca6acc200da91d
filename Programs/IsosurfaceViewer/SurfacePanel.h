// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SurfacePanel_h
#define SurfacePanel_h

#include "Scene.h"
#include "Slider.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <array>
#include <cstddef>
#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor2D;
class vtkRenderWindowInteractor;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

class Scalars;

/// The sliders of the surfaces, isovalue and opacity, above a histogram of the values.
class SurfacePanel
{
public:
  SurfacePanel(vtkRenderWindowInteractor* interactor, Scene& scene, const Scalars& scalars);
  SurfacePanel(const SurfacePanel&) = delete;
  SurfacePanel& operator=(const SurfacePanel&) = delete;

  /// After a change of a surface, or of the one that is active.
  void Update();
  void SetVisible(bool isVisible);

  /// The number of the surface that keys change.
  std::size_t GetActive() const { return this->Active; }
  void SetActive(std::size_t number);

private:
  struct Sliders
  {
    std::unique_ptr<Slider> Isovalue;
    std::unique_ptr<Slider> Opacity;
  };

  Scene& TheScene;
  std::size_t Active = 0;
  bool IsVisible = true;
  std::array<Sliders, NumberOfSurfaces> SlidersOf;
  vtkSmartPointer<vtkActor2D> Histogram;
};

}

#endif
