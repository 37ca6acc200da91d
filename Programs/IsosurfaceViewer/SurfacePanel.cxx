// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "SurfacePanel.h"

#include "Histogram.h"
#include "Scalars.h"

#include <vtkActor2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

namespace Viewer
{
namespace
{

constexpr Place PlaceOfHistogram = { 0.05, 0.02, 0.68, 0.10 };

/// The sliders are above the histogram, the first one next to it.
Place FindPlace(std::size_t number, double left, double right)
{
  constexpr double height = 0.065;
  const double bottom = PlaceOfHistogram.Top + height * static_cast<double>(number);
  return { left, bottom, right, bottom + 0.5 * height };
}

}

//------------------------------------------------------------------------------
SurfacePanel::SurfacePanel(
  vtkRenderWindowInteractor* interactor, Scene& scene, const Scalars& scalars)
  : TheScene(scene)
  , Histogram(MakeHistogram(scalars.GetHistogram(), PlaceOfHistogram))
{
  scene.GetRenderer()->AddViewProp(this->Histogram);
  for (std::size_t i = 0; i < NumberOfSurfaces; ++i)
  {
    const auto change = [this, i](double Surface::*member)
    {
      return [this, i, member](double value)
      {
        Surface surface = this->TheScene.GetSurface(i);
        surface.*member = value;
        this->TheScene.SetSurface(i, surface);
        this->SetActive(i);
      };
    };
    Sliders& sliders = this->SlidersOf.at(i);
    sliders.Isovalue = std::make_unique<Slider>(interactor,
      FindPlace(i, PlaceOfHistogram.Left, PlaceOfHistogram.Right), "", change(&Surface::Isovalue));
    sliders.Isovalue->SetRange(scalars.GetLowest(), scalars.GetHighest());
    sliders.Opacity = std::make_unique<Slider>(
      interactor, FindPlace(i, 0.75, 0.95), i == 0 ? "opacity" : "", change(&Surface::Opacity));
    sliders.Opacity->SetRange(0.0, 1.0);
  }
}

//------------------------------------------------------------------------------
void SurfacePanel::Update()
{
  for (std::size_t i = 0; i < NumberOfSurfaces; ++i)
  {
    const Surface& surface = this->TheScene.GetSurface(i);
    Sliders& sliders = this->SlidersOf.at(i);
    sliders.Isovalue->SetValue(surface.Isovalue);
    sliders.Opacity->SetValue(surface.Opacity);
    for (Slider* slider : { sliders.Isovalue.get(), sliders.Opacity.get() })
    {
      slider->SetColor(surface.Color);
      slider->SetActive(i == this->Active);
      slider->SetVisible(this->IsVisible && surface.IsVisible);
    }
  }
  this->Histogram->SetVisibility(this->IsVisible ? 1 : 0);
}

//------------------------------------------------------------------------------
void SurfacePanel::SetVisible(bool isVisible)
{
  this->IsVisible = isVisible;
  this->Update();
}

//------------------------------------------------------------------------------
void SurfacePanel::SetActive(std::size_t number)
{
  this->Active = number;
  this->Update();
}

}
