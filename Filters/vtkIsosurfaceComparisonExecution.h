// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// One execution of vtkIsosurfaceComparisonFilter: what its measurements share.

#ifndef vtkIsosurfaceComparisonExecution_h
#define vtkIsosurfaceComparisonExecution_h

#include "vtkIsosurfaceComparisonFilter.h" // for the class around
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars
#include "vtkSmartPointer.h"               // for ivars

#include <functional> // for std::function
#include <memory>     // for std::unique_ptr
#include <string>     // for std::string
#include <vector>     // for std::vector

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkDataSet;
class vtkImageData;
class vtkPolyData;
class vtkTable;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{
class Drawing;
class PictureRays;
class PictureWindow;
class TracedIsosurface;
struct ExtractionMethod;
struct Row;
}

VTK_ABI_NAMESPACE_BEGIN

class vtkIsosurfaceComparisonFilter::Comparison
{
public:
  Comparison(vtkIsosurfaceComparisonFilter* self, vtkDataSet* data, vtkPolyData* mesh,
    vtkImageData* difference);
  ~Comparison();
  Comparison(const Comparison&) = delete;
  void operator=(const Comparison&) = delete;

  // Fills the table; returns early when aborted.
  void Run(
    const std::vector<const vtkIsosurfaceComparison::ExtractionMethod*>& methods, vtkTable* table);

private:
  using Drawing = vtkIsosurfaceComparison::Drawing;
  using Row = vtkIsosurfaceComparison::Row;

  // These return false when aborted: the row is not finished.
  bool MeasureTriangles(const vtkIsosurfaceComparison::ExtractionMethod& method, Row& row);
  bool MeasureCastVolume(Row& row);
  bool MeasureRayTracing(Row& row);
  bool MeasurePictures(const std::function<std::unique_ptr<Drawing>()>& newDrawing, Row& row);
  bool MeasureAccuracyOfTriangles(vtkPolyData* extracted, Row& row);
  bool MeasureAccuracyOfHits(Row& row);
  void ComparePixels(const std::vector<double>& ts, Row& row) const;

  std::string WhyNoSurface(double isovalue) const;
  bool FinishStep();
  bool IsOutputRow() const { return this->NumberOfRows == this->Self->OutputRow; }

  vtkIsosurfaceComparisonFilter* Self;
  vtkDataSet* Data;
  vtkSmartPointer<vtkDataSet> Extracted;
  vtkPolyData* Mesh;
  vtkImageData* Difference;
  std::unique_ptr<vtkIsosurfaceComparison::TracedIsosurface> Reference;
  vtkNew<vtkCamera> Camera;
  std::unique_ptr<vtkIsosurfaceComparison::PictureRays> Rays;
  std::unique_ptr<vtkIsosurfaceComparison::PictureWindow> Window;
  std::string WhyNoPictures;
  double Range[2];

  // Where the rays of the picture hit the isosurface of the present isovalue.
  std::vector<double> ReferenceTs;
  int NumberOfRows = 0;
  int Step = 0;
  int NumberOfSteps = 0;
};

VTK_ABI_NAMESPACE_END

#endif
