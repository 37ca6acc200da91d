// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A row of the table of vtkIsosurfaceComparisonFilter, which says what the columns mean.

#ifndef vtkIsosurfaceComparisonRow_h
#define vtkIsosurfaceComparisonRow_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkType.h"

#include <limits>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

/// The value of what was not measured, or cannot be.
constexpr double NotMeasured = std::numeric_limits<double>::quiet_NaN();

struct Row
{
  std::string Method;
  double Isovalue = NotMeasured;

  double BuildTime = NotMeasured;
  double ExtractionTime = NotMeasured;
  double FirstPictureTime = NotMeasured;
  double NextPictureTime = NotMeasured;
  double NewIsovaluePictureTime = NotMeasured;

  vtkIdType Triangles = 0;
  vtkIdType Points = 0;
  vtkIdType Bytes = 0;
  double PeakBytes = NotMeasured;

  double MedianDistanceInCells = NotMeasured;
  double P99DistanceInCells = NotMeasured;
  double MaximumDistanceInCells = NotMeasured;
  double MedianDistance = NotMeasured;
  double P99Distance = NotMeasured;
  double MaximumDistance = NotMeasured;
  double MedianNormalError = NotMeasured;
  double P99NormalError = NotMeasured;
  double MaximumNormalError = NotMeasured;
  double LostPoints = NotMeasured;

  double CoveredPixels = NotMeasured;
  double DifferentPixels = NotMeasured;
  double IsosurfaceAlonePixels = NotMeasured;
  double MeshAlonePixels = NotMeasured;

  double AmbiguousCells = NotMeasured;
  double TopologyDifferences = NotMeasured;

  /// Why something could not be measured, in sentences.
  std::string Note;

  void AddNote(const std::string& sentence);
};

/// Has all columns even if there are no rows.
void AddColumns(vtkTable* table);
void AddRow(vtkTable* table, const Row& row);

}

#endif
