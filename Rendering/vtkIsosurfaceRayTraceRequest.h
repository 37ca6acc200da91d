// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is traced of an input for a volume, and how it is coloured.

#ifndef vtkIsosurfaceRayTraceRequest_h
#define vtkIsosurfaceRayTraceRequest_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "vtkSmartPointer.h" // for ivars

#include "Field/TracedField.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceInput;
class vtkObject;
class vtkPlaneCollection;
class vtkVolume;
class vtkVolumeProperty;
struct vtkIsosurfaceRayTraceSettings;

/// Made in every call that traces, from the current state of the volume.
struct vtkIsosurfaceRayTraceRequest
{
  /// Why the blend mode cannot be drawn; empty if it can.
  static std::string FindProblem(const vtkIsosurfaceRayTraceSettings& settings);

  /// Selects what the fields of the input trace from now on: of what is visible, and not cut off by
  /// clipping planes (which may be null). The input must be up to date, and outlive the request.
  vtkIsosurfaceRayTraceRequest(const vtkIsosurfaceRayTraceSettings& settings,
    const vtkIsosurfaceRayTraceInput& input, vtkVolume* volume, vtkPlaneCollection* clippingPlanes);

  /// The number of an isovalue of the property; -1 if it has no such value.
  int FindIsovalue(double isovalue) const;

  /// What was selected: the same of all fields, but for what is visible.
  const vtkIsosurfaceRayTracing::TraceRequest& GetTraceRequest() const;

  const vtkIsosurfaceRayTraceInput& Input;
  vtkVolumeProperty* Property;
  /// Those of the property, by their numbers.
  std::vector<double> Isovalues;
  /// That of the property.
  int Component;
  /// From the object space of the fields to the world.
  vtkIsosurfaceRayTracing::Matrix4 WorldFromObject;
  vtkIsosurfaceRayTracing::Execution Execution;
  /// What is traced, and the property: they exist as long as the request, whatever becomes of the
  /// inputs of the mapper and of the volume.
  std::vector<vtkSmartPointer<vtkObject>> Objects;
};

VTK_ABI_NAMESPACE_END

#endif
