// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Comparison_h
#define Comparison_h

#include "Crossover.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkCamera;
class vtkImageData;
class vtkPolyData;
class vtkTable;

namespace Compare
{

/// What was compared, and what came out: what all files are written from.
struct Comparison
{
  std::string Command;
  std::string Input;
  /// The processor and its threads, VTK, how much else it had to do.
  std::string Machine;
  int Repeats;
  vtkSmartPointer<vtkImageData> Volume;
  vtkSmartPointer<vtkCamera> Camera;

  /// The outputs of vtkIsosurfaceComparisonFilter.
  vtkSmartPointer<vtkTable> Table;
  vtkSmartPointer<vtkPolyData> Mesh;
  vtkSmartPointer<vtkImageData> Difference;

  /// Of the first isovalue; measured for a report alone.
  std::vector<Crossover> Crossovers;
};

}

#endif
