// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadMesh_h
#define ReadMesh_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkPointSet;
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The vtkUnstructuredGrid or vtkStructuredGrid in a file. The blocks of composite data become one
/// vtkUnstructuredGrid. The active scalars are the array of this name, or if it is empty those of
/// the file, or else its first array of points; those of cells are averaged to points. Throws
/// std::runtime_error if there is no such mesh or array, or if the file has more than so many MiB.
vtkSmartPointer<vtkPointSet> ReadMesh(
  const std::string& fileName, const std::string& array, double maxMemory);

/// A mesh as a vtkUnstructuredGrid, for filters that take nothing else: itself if it is one.
vtkSmartPointer<vtkUnstructuredGrid> MakeUnstructured(vtkPointSet* mesh);

}

#endif
