// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// How long a person who sits before a render window waits for a picture.

#ifndef vtkIsosurfaceComparisonPictures_h
#define vtkIsosurfaceComparisonPictures_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <memory>
#include <string>

class vtkCamera;
class vtkImageData;
class vtkProp;
class vtkRenderer;
class vtkRenderWindow;

namespace vtkIsosurfaceComparison
{

struct ExtractionMethod;
struct Row;

/// Why no picture can be drawn, and what to do about it; empty if one can.
std::string WhyNoPictures();

/// Something to look at whose isovalue can be changed.
class Drawing
{
public:
  virtual ~Drawing() = default;
  virtual vtkProp* GetProp() = 0;
  virtual void SetIsovalue(double isovalue) = 0;
  /// What a first picture needs and the window does not ask for by itself.
  virtual void Prepare() {}
};

std::unique_ptr<Drawing> NewTriangles(const ExtractionMethod& method, vtkImageData* image);
std::unique_ptr<Drawing> NewTracedIsosurface(vtkImageData* image);

/// A window off the screen, ready to draw.
class PictureWindow
{
public:
  PictureWindow(vtkCamera* camera, int width, int height);
  ~PictureWindow();
  PictureWindow(const PictureWindow&) = delete;
  PictureWindow& operator=(const PictureWindow&) = delete;

  /// Fills in the times of a row: the medians of so many repeats, each with a new drawing.
  /// Returns early if it is told to stop.
  void Measure(const std::function<std::unique_ptr<Drawing>()>& newDrawing, double isovalue,
    double otherIsovalue, int repeats, const std::function<bool()>& isAborted, Row& row);

private:
  double TimeOfPicture();

  vtkCamera* Camera;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

}

#endif
