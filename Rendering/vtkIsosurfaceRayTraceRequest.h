// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is traced of an input for a volume, and how it is coloured.

#ifndef vtkIsosurfaceRayTraceRequest_h
#define vtkIsosurfaceRayTraceRequest_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "vtkSmartPointer.h"   // for ivars
#include "vtkVolumeProperty.h" // for ivars

#include "Field/TracedField.h"

#include <cstddef> // for std::size_t
#include <memory>  // for std::shared_ptr
#include <string>  // for std::string
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceRayTraceInput;
class vtkIsosurfaceRayTraceInputs;
class vtkObject;
class vtkPlaneCollection;
class vtkVolume;
struct vtkIsosurfaceRayTraceSettings;

/// Made in every call that traces, from the current state of the volume.
struct vtkIsosurfaceRayTraceRequest
{
  /// Why the blend mode cannot be drawn; empty if it can.
  static std::string FindProblem(const vtkIsosurfaceRayTraceSettings& settings);

  /// What is traced of an input, and how it is coloured.
  struct Volume
  {
    const vtkIsosurfaceRayTraceInput* Input;
    vtkSmartPointer<vtkVolumeProperty> Property;
    /// That of the property.
    int Component;
    /// Those of the property, by their numbers.
    std::vector<double> Isovalues;
    /// From the object space of the field to the world.
    vtkIsosurfaceRayTracing::Matrix4 WorldFromObject;

    /// The number of an isovalue of the property; -1 if it has no such value.
    int FindIsovalue(double isovalue) const;

    const vtkIsosurfaceRayTracing::TracedField& GetField() const;
  };

  /// The volume that a mapper draws, and for each connection the one that gives it a property and
  /// a place in the former; null for none of its own.
  struct DrawnVolumes
  {
    vtkVolume* Drawn;
    std::vector<vtkVolume*> OfConnections;

    vtkVolumeProperty* GetProperty(int connection) const;
    /// Whether a connection is, by its own volume.
    bool IsVisible(int connection) const;
    /// From the coordinates of the data of a connection to the world.
    vtkIsosurfaceRayTracing::Matrix4 FindWorldFromData(int connection) const;
  };

  /// Selects what the fields of the inputs trace from now on: of what is visible, and not cut off
  /// by clipping planes (which may be null). The inputs must be up to date, and outlive the
  /// request.
  vtkIsosurfaceRayTraceRequest(const vtkIsosurfaceRayTraceSettings& settings,
    vtkIsosurfaceRayTraceInputs& inputs, const DrawnVolumes& volumes,
    vtkPlaneCollection* clippingPlanes);

  /// Selects the same again, after more of the data has been read.
  void SelectAgain() const;

  /// That of a hit.
  const Volume& GetVolume(const vtkIsosurfaceRayTracing::Hit& hit) const
  {
    return this->Volumes[static_cast<std::size_t>(hit.Field)];
  }

  /// Whether projections are selected, and whether nothing is: no surfaces of any volume.
  bool IsProjection() const;
  bool IsNothing() const;

  vtkIsosurfaceRayTraceInputs& Inputs;
  /// One for each connection.
  std::vector<Volume> Volumes;
  vtkIsosurfaceRayTracing::Execution Execution;
  /// What is traced of each connection: it exists as long as the request, whatever becomes of the
  /// inputs of the mapper.
  std::vector<std::shared_ptr<const std::vector<vtkSmartPointer<vtkObject>>>> Objects;

private:
  vtkIsosurfaceRayTracing::TraceRequest MakeTraceRequest(
    const vtkIsosurfaceRayTraceSettings& settings, const Volume& volume,
    vtkPlaneCollection* clippingPlanes) const;

  vtkIsosurfaceRayTracing::MemoryBudget Budget;
};

VTK_ABI_NAMESPACE_END

#endif
