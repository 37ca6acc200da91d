// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The colours and opacities of values by a volume property. They are copies of its transfer
// functions: threads read no object of VTK that makes or builds something at its first use, and an
// observer that edits the functions while a frame is traced changes nothing in that frame.

#ifndef vtkIsosurfaceRayTraceValueColors_h
#define vtkIsosurfaceRayTraceValueColors_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkMTimeType

#include "Picture/Scene.h"

#include <array>  // for std::array
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkColorTransferFunction;
class vtkPiecewiseFunction;
class vtkVolumeProperty;

class vtkIsosurfaceRayTraceValueColors final : public vtkIsosurfaceRayTracing::ValueColors
{
public:
  vtkIsosurfaceRayTraceValueColors(vtkVolumeProperty* property, int component);

  /// Whether they are still those of a component of a property. (A copy of large functions takes
  /// time, and need not be made for every frame.)
  bool AreOf(vtkVolumeProperty* property, int component) const;

  ///@{
  /// The colour of a value, without its opacity; and the opacity, as the function says: it may be
  /// negative, or more than 1.
  vtkIsosurfaceRayTracing::Vector3 GetColor(double value) const;
  double GetOpacity(double value) const;
  ///@}
  /// Both; the opacity from 0 to 1.
  std::array<double, 4> Get(double value) const override;

  ///@{
  /// What of vectors has these colours: the magnitude, or a component.
  bool AreOfMagnitudes() const;
  int GetVectorComponent() const;
  ///@}

  /// The values at the nodes of the functions, in order, each once.
  std::vector<double> FindNodes() const;

private:
  /// To compare with, not to use.
  const vtkVolumeProperty* Property;
  vtkMTimeType PropertyTime;
  int Component;
  /// One of the two is null.
  vtkSmartPointer<vtkColorTransferFunction> Color;
  vtkSmartPointer<vtkPiecewiseFunction> Gray;
  vtkSmartPointer<vtkPiecewiseFunction> Opacity;
};

VTK_ABI_NAMESPACE_END

#endif
