// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Slider.h"

#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkProperty2D.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSliderRepresentation2D.h>
#include <vtkSliderWidget.h>
#include <vtkTextProperty.h>

namespace Viewer
{
namespace
{

constexpr double KnobLength = 0.012;

}

//------------------------------------------------------------------------------
Slider::Slider(vtkRenderWindowInteractor* interactor, const Place& place, const char* title,
  const std::function<void(double)>& onChange)
  : OnChange(onChange)
{
  const double middle = 0.5 * (place.Bottom + place.Top);
  vtkSliderRepresentation2D* slider = this->Representation;
  slider->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider->GetPoint1Coordinate()->SetValue(place.Left - 0.5 * KnobLength, middle);
  slider->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  slider->GetPoint2Coordinate()->SetValue(place.Right + 0.5 * KnobLength, middle);
  slider->SetTitleText(title);
  slider->SetLabelFormat("%.5g");
  slider->SetSliderLength(KnobLength);
  slider->SetSliderWidth(0.024);
  slider->SetTubeWidth(0.005);
  slider->SetEndCapLength(0.0);
  slider->SetTitleHeight(0.018);
  slider->SetLabelHeight(0.020);
  slider->GetTitleProperty()->BoldOff();
  slider->GetSelectedProperty()->SetColor(1.0, 1.0, 1.0);
  this->Widget->SetInteractor(interactor);
  this->Widget->SetRepresentation(slider);
  this->Widget->SetAnimationModeToJump();
  this->Widget->KeyPressActivationOff();
  this->Widget->AddObserver(vtkCommand::InteractionEvent, this, &Slider::OnInteraction);
}

//------------------------------------------------------------------------------
Slider::~Slider() = default;

//------------------------------------------------------------------------------
void Slider::SetRange(double lowest, double highest)
{
  this->Representation->SetMinimumValue(lowest);
  this->Representation->SetMaximumValue(highest);
}

//------------------------------------------------------------------------------
void Slider::SetValue(double value)
{
  this->Representation->SetValue(value);
}

//------------------------------------------------------------------------------
void Slider::SetColor(const std::array<double, 3>& color)
{
  this->Representation->GetSliderProperty()->SetColor(color[0], color[1], color[2]);
}

//------------------------------------------------------------------------------
void Slider::SetActive(bool isActive)
{
  const double grey = isActive ? 0.95 : 0.5;
  this->Representation->GetTubeProperty()->SetColor(grey, grey, grey);
}

//------------------------------------------------------------------------------
void Slider::SetVisible(bool isVisible)
{
  this->Widget->SetEnabled(isVisible ? 1 : 0);
}

//------------------------------------------------------------------------------
void Slider::OnInteraction()
{
  this->OnChange(this->Representation->GetValue());
}

}
