// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PickedPoint_h
#define PickedPoint_h

#include "Scalars.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkActor;
class vtkIsosurfacePicker;
class vtkSphereSource;
VTK_ABI_NAMESPACE_END

namespace Viewer
{

class Scene;

/// A point of a surface or a cap, marked by a small sphere.
class PickedPoint
{
public:
  PickedPoint(Scene& scene, const Scalars& scalars);
  ~PickedPoint();
  PickedPoint(const PickedPoint&) = delete;
  PickedPoint& operator=(const PickedPoint&) = delete;

  /// Picks what is seen at a pixel of the window, from the lower left.
  void Pick(int x, int y);

  /// The position and the value there; empty if nothing is picked.
  const std::string& Describe() const { return this->Text; }

private:
  double FindValue();

  Scene& TheScene;
  const Scalars TheScalars;
  std::string Text;
  vtkNew<vtkIsosurfacePicker> Picker;
  vtkNew<vtkSphereSource> Sphere;
  vtkNew<vtkActor> Marker;
};

}

#endif
