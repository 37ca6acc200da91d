// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadData_h
#define ReadData_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataSet;
class vtkPointSet;
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The vtkImageData, vtkUnstructuredGrid or vtkStructuredGrid in a file. The blocks of composite
/// data become one vtkUnstructuredGrid. The active scalars are the array of this name, or if it is
/// empty those of the file, or else its first array; those of cells are averaged to points. Throws
/// std::runtime_error if there are no such data or array, or if they have more than so many MiB.
vtkSmartPointer<vtkDataSet> ReadData(
  const std::string& fileName, const std::string& array, double maxMemory);

/// The same for a mesh alone.
vtkSmartPointer<vtkPointSet> ReadMesh(
  const std::string& fileName, const std::string& array, double maxMemory);

/// A mesh as a vtkUnstructuredGrid, for filters that take nothing else: itself if it is one.
vtkSmartPointer<vtkUnstructuredGrid> MakeUnstructured(vtkPointSet* mesh);

}

#endif
