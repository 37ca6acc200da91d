// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "vtkIsosurfaceComparisonPictures.h"

#include "vtkIsosurfaceComparisonMethods.h"
#include "vtkIsosurfaceComparisonRow.h"
#include "vtkIsosurfaceComparisonTime.h"

#include "vtkActor.h"
#include "vtkAlgorithm.h"
#include "vtkCamera.h"
#include "vtkDataSet.h"
#include "vtkGPUVolumeRayCastMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"
#include "vtksys/DynamicLoader.hxx"

#include <chrono>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace vtkIsosurfaceComparison
{
namespace
{

class TriangleDrawing : public Drawing
{
public:
  TriangleDrawing(const ExtractionMethod& method, vtkDataSet* data)
    : Triangles(method.New(data, true))
  {
    this->Mapper->SetInputConnection(this->Triangles->GetFilter()->GetOutputPort());
    this->Actor->SetMapper(this->Mapper);
  }

  vtkProp* GetProp() override { return this->Actor; }
  void SetIsovalue(double isovalue) override { this->Triangles->SetIsovalue(isovalue); }
  void Prepare() override { this->Triangles->Build(); }

private:
  std::unique_ptr<Extraction> Triangles;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
};

// Asks the library that vtkXOpenGLRenderWindow connects with, and has loaded.
bool CanOpenDisplay()
{
  const char* name = std::getenv("DISPLAY");
  if (!name)
  {
    return false;
  }
  static std::map<std::string, void*> displays;
  void*& display = displays[name];
  using Loader = vtksys::DynamicLoader;
  static const Loader::LibraryHandle library = Loader::OpenLibrary("libX11.so.6");
  static const auto open = library
    ? reinterpret_cast<void* (*)(const char*)>(Loader::GetSymbolAddress(library, "XOpenDisplay"))
    : nullptr;
  // A server that has just lost its last client refuses others for a moment, unless it was started
  // with -noreset. For the same reason this connection stays open.
  for (int attempt = 0; open && !display && attempt < 5; ++attempt)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(attempt * 50));
    display = open(name);
  }
  return display != nullptr;
}

// Where neither X nor EGL gives a context, VTK 9.4 and newer makes this window without looking for
// OSMesa's library. (It also says that it supports OpenGL, whatever there is.)
bool IsWithoutOSMesa(vtkRenderWindow* window)
{
  if (!window->IsA("vtkOSOpenGLRenderWindow"))
  {
    return false;
  }
  vtkOpenGLRenderWindow::SafeDownCast(window)->Initialize();
  return window->GetGenericContext() == nullptr;
}

class IsosurfaceDrawing : public Drawing
{
public:
  explicit IsosurfaceDrawing(vtkDataSet* data)
    : Isosurface(TracedIsosurface::New(data))
  {
  }

  vtkProp* GetProp() override { return this->Isosurface->GetVolume(); }
  void SetIsovalue(double isovalue) override { this->Isosurface->SetIsovalue(isovalue); }

private:
  std::unique_ptr<TracedIsosurface> Isosurface;
};

class CastVolume : public Drawing
{
public:
  CastVolume(vtkDataSet* image, bool isShaded)
  {
    this->Mapper->SetInputDataObject(image);
    this->Mapper->SetBlendModeToIsoSurface();
    this->Surface.Get()->SetMapper(this->Mapper);
    this->Surface.Get()->GetProperty()->SetShade(isShaded);
  }

  vtkProp* GetProp() override { return this->Surface.Get(); }
  void SetIsovalue(double isovalue) override { this->Surface.SetIsovalue(isovalue); }

private:
  vtkNew<vtkGPUVolumeRayCastMapper> Mapper;
  SurfaceVolume Surface;
};

}

//------------------------------------------------------------------------------
std::string WhyNoPictures()
{
  vtkNew<vtkRenderWindow> window;
  const std::string name = window->GetClassName();
  if (name == "vtkRenderWindow") // nothing overrides it
  {
    return "No pictures: the module vtkRenderingOpenGL2 is not initialized (VTK_MODULE_INIT, "
           "vtk_module_autoinit, or import vtkmodules.vtkRenderingOpenGL2).";
  }
  if (!window->IsA("vtkOpenGLRenderWindow"))
  {
    return "No pictures: isosurfaces are drawn with OpenGL, and VTK makes windows of the class " +
      name + ". Leave out the module that makes them (VTK 9.7 and newer: or set the environment " +
      "variable VTK_FACTORY_PREFER=RenderingBackend=OpenGL).";
  }
  // Without a display, this window would end the program.
  if (window->IsA("vtkXOpenGLRenderWindow") && !CanOpenDisplay())
  {
    const char* display = std::getenv("DISPLAY");
    const std::string problem = display
      ? std::string("the display ") + display + " cannot be opened"
      : std::string("there is no display");
    return "No pictures: " + problem + ". Set DISPLAY, or run under xvfb-run.";
  }
  if (IsWithoutOSMesa(window))
  {
    return "No pictures: there is no display, no EGL and no OSMesa. Set DISPLAY, run under "
           "xvfb-run, or install libOSMesa.";
  }
  return "";
}

//------------------------------------------------------------------------------
std::unique_ptr<Drawing> NewTriangles(const ExtractionMethod& method, vtkDataSet* data)
{
  return std::make_unique<TriangleDrawing>(method, data);
}

//------------------------------------------------------------------------------
std::unique_ptr<Drawing> NewTracedIsosurface(vtkDataSet* data)
{
  return std::make_unique<IsosurfaceDrawing>(data);
}

//------------------------------------------------------------------------------
std::unique_ptr<Drawing> NewCastVolume(vtkDataSet* image, bool isShaded)
{
  return std::make_unique<CastVolume>(image, isShaded);
}

//------------------------------------------------------------------------------
PictureWindow::PictureWindow(vtkCamera* camera, int width, int height)
  : Camera(camera)
{
  this->Renderer->SetActiveCamera(camera);
  this->Window->SetOffScreenRendering(true);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(width, height);
  this->Window->AddRenderer(this->Renderer);
  this->Window->Render();
}

//------------------------------------------------------------------------------
PictureWindow::~PictureWindow() = default;

//------------------------------------------------------------------------------
double PictureWindow::TimeOfPicture()
{
  const Stopwatch watch;
  this->Window->Render();
  this->Window->WaitForCompletion();
  return watch.GetSeconds();
}

//------------------------------------------------------------------------------
void PictureWindow::Measure(const std::function<std::unique_ptr<Drawing>()>& newDrawing,
  double isovalue, double otherIsovalue, int repeats, const std::function<bool()>& isAborted,
  Row& row)
{
  constexpr double degrees = 2.0;
  std::vector<double> first;
  std::vector<double> next;
  std::vector<double> newIsovalue;
  for (int repeat = 0; repeat < repeats && !isAborted(); ++repeat)
  {
    const Stopwatch watch;
    const std::unique_ptr<Drawing> drawing = newDrawing();
    drawing->SetIsovalue(isovalue);
    drawing->Prepare();
    this->Renderer->AddViewProp(drawing->GetProp());
    this->TimeOfPicture();
    first.push_back(watch.GetSeconds());

    this->Camera->Azimuth(degrees);
    next.push_back(this->TimeOfPicture());
    this->Camera->Azimuth(-degrees);

    drawing->SetIsovalue(otherIsovalue);
    this->TimeOfPicture();
    drawing->SetIsovalue(isovalue);
    newIsovalue.push_back(this->TimeOfPicture());
    this->Renderer->RemoveViewProp(drawing->GetProp());
  }
  row.FirstPictureTime = Median(first);
  row.NextPictureTime = Median(next);
  row.NewIsovaluePictureTime = Median(newIsovalue);
}

//------------------------------------------------------------------------------
std::vector<double> PictureWindow::FindCovered(Drawing& drawing, double isovalue)
{
  drawing.SetIsovalue(isovalue);
  this->Renderer->AddViewProp(drawing.GetProp());
  this->Window->Render();
  this->Renderer->RemoveViewProp(drawing.GetProp());
  const int* size = this->Window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  std::vector<double> covered;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    const bool isBackground = pixels->GetValue(3 * i) == 0;
    covered.push_back(isBackground ? NotMeasured : 0.0);
  }
  return covered;
}

}
