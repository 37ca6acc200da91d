// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Comparison_h
#define Comparison_h

#include "Crossover.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkDataSet;
class vtkImageData;
class vtkPolyData;
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The input and the results of a comparison, from which all files are written.
struct Comparison
{
  std::string Command;
  std::string Input;
  /// The processor and its threads, VTK, the load average.
  std::string Machine;
  int Repeats;
  /// An image, or a mesh.
  vtkSmartPointer<vtkDataSet> Data;
  vtkSmartPointer<vtkCamera> Camera;

  /// The outputs of vtkIsosurfaceComparisonFilter.
  vtkSmartPointer<vtkTable> Table;
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkImageData> Difference;

  /// For the first isovalue; measured only for a report on an image.
  std::vector<Crossover> Crossovers;
};

}

#endif
