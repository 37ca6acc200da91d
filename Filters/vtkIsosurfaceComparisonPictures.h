// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Measures the times of pictures in a render window.

#ifndef vtkIsosurfaceComparisonPictures_h
#define vtkIsosurfaceComparisonPictures_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkDataSet;
class vtkProp;
class vtkRenderer;
class vtkRenderWindow;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

struct ExtractionMethod;
struct Row;

/// Returns why pictures cannot be rendered, and the remedy; empty if they can.
std::string WhyNoPictures();

/// A prop that shows an isosurface, whose isovalue can be changed.
class Drawing
{
public:
  virtual ~Drawing() = default;
  virtual vtkProp* GetProp() = 0;
  virtual void SetIsovalue(double isovalue) = 0;
  /// Computes what the first picture needs and rendering does not update by itself.
  virtual void Prepare() {}
};

/// The method of NewCastVolume, in the table.
constexpr const char* CastVolumeName = "vtkGPUVolumeRayCastMapper";

std::unique_ptr<Drawing> NewTriangles(const ExtractionMethod& method, vtkDataSet* data);
std::unique_ptr<Drawing> NewTracedIsosurface(vtkDataSet* data);
/// By vtkGPUVolumeRayCastMapper; white throughout if it is not shaded.
std::unique_ptr<Drawing> NewCastVolume(vtkDataSet* image, bool isShaded);

/// An off-screen window, initialized.
class PictureWindow
{
public:
  PictureWindow(vtkCamera* camera, int width, int height);
  ~PictureWindow();
  PictureWindow(const PictureWindow&) = delete;
  PictureWindow& operator=(const PictureWindow&) = delete;

  /// Fills in the times of a row: the medians of a number of repeats, each with a new drawing.
  /// Returns early if it is told to stop.
  void Measure(const std::function<std::unique_ptr<Drawing>()>& newDrawing, double isovalue,
    double otherIsovalue, int repeats, const std::function<bool()>& isAborted, Row& row);

  /// Which pixels show a white drawing, rows from the bottom: 0 for those that do, NaN for the
  /// others, so that they can be compared with the Ts of PictureRays.
  std::vector<double> FindCovered(Drawing& drawing, double isovalue);

private:
  double TimeOfPicture();

  vtkCamera* Camera;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

}

#endif
