// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The scalars that a mapper traces: an array of its input, or a component of it.

#ifndef vtkIsosurfaceRayTraceScalars_h
#define vtkIsosurfaceRayTraceScalars_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for vtkSmartPointer
#include "vtkType.h"                       // for vtkIdType

#include "Field/ScalarType.h"

#include <cstddef>  // for std::ptrdiff_t
#include <optional> // for std::optional
#include <string>   // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkDataArray;
class vtkDataSet;
class vtkVolumeProperty;

struct vtkIsosurfaceRayTraceScalars
{
  /// The values in the memory of an array. Stride is the distance between neighbours, in values.
  struct View
  {
    const void* Values;
    vtkIsosurfaceRayTracing::ScalarType Type;
    std::ptrdiff_t Stride;
    /// All components of the first tuple.
    const void* Components;
  };

  /// Selects the array of a data set that the scalar mode of a mapper names; null if there is none.
  void SelectArray(vtkAbstractVolumeMapper* mapper, vtkDataSet* data);

  /// Says that there is no such array, and what to do.
  static std::string DescribeMissing(vtkAbstractVolumeMapper* mapper, vtkDataSet* data);

  /// Selects a component, or the magnitude; without one, that with the largest weight of the
  /// property. Returns the component of the property that belongs to it, or why there is none.
  std::string SelectComponent(
    std::optional<int> component, vtkVolumeProperty* property, int& propertyComponent);

  /// Why those of an array cannot be traced, of data with so many points and cells; empty if they
  /// can.
  std::string FindProblem(vtkIdType points, vtkIdType cells) const;

  /// The values, which have no problem. What is no plain array in memory is copied to storage: the
  /// component, or all if they are needed.
  View MakeView(vtkSmartPointer<vtkDataArray>& storage, int threads) const;

  vtkDataArray* Array = nullptr;
  bool AreOfCells = false;
  /// Magnitude selects the length of the vector instead of a component.
  int Component = 0;
  /// Whether the other components are needed, too.
  bool HasOthers = false;

  static constexpr int Magnitude = -1;
};

VTK_ABI_NAMESPACE_END

#endif
