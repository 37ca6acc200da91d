// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCase_h
#define MeshCase_h

#include "Views.h"

#include <vtkContour3DLinearGrid.h>
#include <vtkContourGrid.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>

namespace Benchmark
{

/// A surface of a mesh: that of the active scalars.
struct MeshCase
{
  std::string Name;
  vtkSmartPointer<vtkPointSet> Grid;
  double Isovalue;
  /// The same, for VTK's filters, which do not take every kind of grid.
  vtkSmartPointer<vtkUnstructuredGrid> Unstructured;
  /// The cells split into tetrahedra, with the same active scalars, or null.
  vtkSmartPointer<vtkUnstructuredGrid> Split;

  vtkDataArray* GetScalars() const { return this->Grid->GetPointData()->GetScalars(); }
  double GetNumberOfCells() const { return static_cast<double>(this->Grid->GetNumberOfCells()); }
  Bounds GetBounds() const
  {
    Bounds bounds;
    this->Grid->GetBounds(bounds.data());
    return bounds;
  }
};

/// Triangles and nothing else: no normals, no scalars.
template <typename Filter>
vtkSmartPointer<vtkPolyData> ExtractMesh(const MeshCase& mesh, double isovalue)
{
  vtkNew<Filter> filter;
  filter->SetInputData(mesh.Unstructured);
  filter->SetValue(0, isovalue);
  filter->ComputeNormalsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
}

}

#endif
