// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What a mesh may be given without being modified: the memory of its points, and its cells.

#ifndef vtkIsosurfaceRayTraceGridLists_h
#define vtkIsosurfaceRayTraceGridLists_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkMTimeType

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkObject;
class vtkPointSet;
class vtkUnstructuredGrid;

struct vtkIsosurfaceRayTraceGridLists
{
  /// The memory of the points of a grid, if they are read where they are; else null.
  static const void* FindPoints(vtkPointSet* grid);

  /// The types of all cells of a grid; null if there are none.
  static vtkDataArray* GetTypes(vtkUnstructuredGrid* grid);

  /// None.
  vtkIsosurfaceRayTraceGridLists() = default;
  explicit vtkIsosurfaceRayTraceGridLists(vtkPointSet* grid);

  bool operator==(const vtkIsosurfaceRayTraceGridLists& other) const
  {
    return this->Points == other.Points && this->Cells == other.Cells &&
      this->Types == other.Types && this->TimeOfTypes == other.TimeOfTypes;
  }

  const void* Points = nullptr;
  /// Of an unstructured grid.
  const vtkObject* Cells = nullptr;
  const vtkObject* Types = nullptr;
  vtkMTimeType TimeOfTypes = 0;
};

VTK_ABI_NAMESPACE_END

#endif
