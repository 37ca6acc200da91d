// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "PickedPoint.h"

#include "Scene.h"
#include "vtkIsosurfacePicker.h"
#include "vtkIsosurfaceRayTraceMapper.h"
#include "vtkIsosurfaceVolume.h"

#include <vtkActor.h>
#include <vtkDataSet.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <sstream>

namespace Viewer
{

//------------------------------------------------------------------------------
PickedPoint::PickedPoint(Scene& scene, const Scalars& scalars)
  : TheScene(scene)
  , TheScalars(scalars)
{
  constexpr double sizeOfMarker = 0.008; // of the diagonal of the data
  this->Sphere->SetRadius(sizeOfMarker * scene.GetVolume()->GetLength());
  this->Sphere->SetThetaResolution(24);
  this->Sphere->SetPhiResolution(24);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(this->Sphere->GetOutputPort());
  this->Marker->SetMapper(mapper);
  this->Marker->GetProperty()->SetColor(0.95, 0.25, 0.2);
  this->Marker->PickableOff();
  this->Marker->VisibilityOff();
  scene.GetRenderer()->AddActor(this->Marker);
  this->Picker->PickFromListOn();
  this->Picker->AddPickList(scene.GetVolume());
}

//------------------------------------------------------------------------------
PickedPoint::~PickedPoint() = default;

//------------------------------------------------------------------------------
/// The isovalue, or on a cap, the value of the data that it shows.
double PickedPoint::FindValue()
{
  constexpr double tolerance = 1e-6; // of the diagonal of the data
  vtkPlaneCollection* planes = this->TheScene.GetMapper()->GetClippingPlanes();
  const bool isOfCap = planes && planes->GetNumberOfItems() > 0 &&
    planes->GetItem(0)->DistanceToPlane(this->Picker->GetPickPosition()) <
      tolerance * this->TheScene.GetVolume()->GetLength();
  return isOfCap ? this->TheScalars.GetValue(this->Picker->GetDataSet(), this->Picker->GetCellId(),
                     this->Picker->GetPCoords())
                 : this->Picker->GetIsovalue();
}

//------------------------------------------------------------------------------
void PickedPoint::Pick(int x, int y)
{
  const bool isHit = this->Picker->Pick(x, y, 0.0, this->TheScene.GetRenderer()) != 0;
  this->Marker->SetVisibility(isHit ? 1 : 0);
  this->Text.clear();
  if (isHit)
  {
    const double* position = this->Picker->GetPickPosition();
    this->Sphere->SetCenter(this->Picker->GetPickPosition());
    std::ostringstream text;
    text.precision(5);
    text << "position " << position[0] << ", " << position[1] << ", " << position[2] << "; value "
         << this->FindValue();
    this->Text = text.str();
  }
}

}
