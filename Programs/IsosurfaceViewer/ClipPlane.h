// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ClipPlane_h
#define ClipPlane_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

VTK_ABI_NAMESPACE_BEGIN
class vtkImplicitPlaneRepresentation;
class vtkImplicitPlaneWidget2;
class vtkPlane;
class vtkRenderWindowInteractor;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

class Scene;

/// A plane that cuts the surfaces, and a widget that moves it.
class ClipPlane
{
public:
  ClipPlane(vtkRenderWindowInteractor* interactor, Scene& scene);
  ~ClipPlane();
  ClipPlane(const ClipPlane&) = delete;
  ClipPlane& operator=(const ClipPlane&) = delete;

  bool IsOn() const { return this->On; }
  /// When it is switched on for the first time, it is in the middle, perpendicular to an axis, and
  /// cuts away what is on the side of the camera.
  void SetOn(bool on);
  /// The plane cuts without its widget.
  void SetWidgetVisible(bool isVisible);

private:
  void PlaceInMiddle();
  void OnInteraction();

  Scene& TheScene;
  bool On = false;
  bool IsPlaced = false;
  vtkNew<vtkPlane> Plane;
  vtkNew<vtkImplicitPlaneRepresentation> Representation;
  vtkNew<vtkImplicitPlaneWidget2> Widget;
};

}

#endif
