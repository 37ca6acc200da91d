// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "ClipPlane.h"

#include "Scene.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkImplicitPlaneRepresentation.h>
#include <vtkImplicitPlaneWidget2.h>
#include <vtkPlane.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace Viewer
{

//------------------------------------------------------------------------------
ClipPlane::ClipPlane(vtkRenderWindowInteractor* interactor, Scene& scene)
  : TheScene(scene)
{
  this->Representation->DrawPlaneOff(); // or it would hide the cut
  this->Representation->DrawOutlineOff();
  this->Representation->OutlineTranslationOff();
  this->Representation->ScaleEnabledOff();
  this->Representation->SetEdgeColor(0.95, 0.8, 0.3);
  this->Widget->SetInteractor(interactor);
  this->Widget->SetRepresentation(this->Representation);
  this->Widget->KeyPressActivationOff();
  this->Widget->AddObserver(vtkCommand::InteractionEvent, this, &ClipPlane::OnInteraction);
}

//------------------------------------------------------------------------------
ClipPlane::~ClipPlane() = default;

//------------------------------------------------------------------------------
void ClipPlane::SetOn(bool on)
{
  if (on && !this->IsPlaced)
  {
    this->PlaceInMiddle();
    this->IsPlaced = true;
  }
  this->On = on;
  this->Widget->SetEnabled(on ? 1 : 0);
  if (on)
  {
    this->TheScene.GetMapper()->AddClippingPlane(this->Plane);
  }
  else
  {
    this->TheScene.GetMapper()->RemoveClippingPlane(this->Plane);
  }
}

//------------------------------------------------------------------------------
void ClipPlane::SetWidgetVisible(bool isVisible)
{
  this->Widget->SetEnabled(this->On && isVisible ? 1 : 0);
}

//------------------------------------------------------------------------------
void ClipPlane::PlaceInMiddle()
{
  double bounds[6];
  this->TheScene.GetMapper()->GetBounds(bounds);
  this->Representation->SetPlaceFactor(1.05);
  this->Representation->PlaceWidget(bounds);
  double center[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    center[axis] = 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]);
  }
  this->Representation->SetOrigin(center);
  // What is on the side of the normal stays.
  double normal[3];
  this->TheScene.GetRenderer()->GetActiveCamera()->GetDirectionOfProjection(normal);
  const double largest =
    std::max({ std::abs(normal[0]), std::abs(normal[1]), std::abs(normal[2]) });
  for (double& component : normal)
  {
    component = std::trunc(component / largest);
  }
  this->Representation->SetNormal(normal);
  this->OnInteraction();
}

//------------------------------------------------------------------------------
void ClipPlane::OnInteraction()
{
  this->Representation->GetPlane(this->Plane);
}

}
