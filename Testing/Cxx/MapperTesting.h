// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What the tests of the mapper share: a scene, pictures of it, and comparisons.

#ifndef MapperTesting_h
#define MapperTesting_h

#include "AnalyticFields.h"
#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkCommand.h>
#include <vtkContourValues.h>
#include <vtkDoubleArray.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSelection.h>
#include <vtkSelectionNode.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace MapperTesting
{

/// Counts what is not as it should be, and says it.
class Checks
{
public:
  void That(bool isTrue, const std::string& claim)
  {
    if (!isTrue)
    {
      std::cerr << "Not true: " << claim << "\n";
      ++this->Failures;
    }
  }

  template <typename T>
  void Equal(const T& actual, const T& expected, const std::string& what)
  {
    if (!(actual == expected))
    {
      std::cerr << what << " is " << actual << ", not " << expected << "\n";
      ++this->Failures;
    }
  }

  void Near(double actual, double expected, double tolerance, const std::string& what)
  {
    if (!(std::abs(actual - expected) <= tolerance))
    {
      std::cerr << what << " is " << actual << ", not " << expected << " within " << tolerance
                << "\n";
      ++this->Failures;
    }
  }

  int Result() const { return this->Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
  int Failures = 0;
};

/// Counts the events of a kind, and keeps the last text that came with one.
class EventCounter : public vtkCommand
{
public:
  vtkTypeMacro(EventCounter, vtkCommand);
  static EventCounter* New() { return new EventCounter; }
  void Execute(vtkObject*, unsigned long event, void* data) override
  {
    ++this->Count;
    if (event == vtkCommand::ErrorEvent || event == vtkCommand::WarningEvent)
    {
      this->Text = static_cast<const char*>(data);
    }
  }

  int Count = 0;
  std::string Text;
};

/// A cube of so many samples along each edge, from -1 to 1, of a field of points in it.
template <typename Field>
vtkSmartPointer<vtkImageData> NewCube(int samples, const Field& field)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  const double spacing = 2.0 / (samples - 1);
  image->SetDimensions(samples, samples, samples);
  image->SetSpacing(spacing, spacing, spacing);
  image->SetOrigin(-1.0, -1.0, -1.0);
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName("field");
  scalars->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    AnalyticFields::Point point;
    image->GetPoint(i, point.data());
    scalars->SetValue(i, field(point));
  }
  image->GetPointData()->SetScalars(scalars);
  return image;
}

inline vtkSmartPointer<vtkImageData> NewBall(int samples, double radius)
{
  return NewCube(samples, AnalyticFields::Sphere{ { 0.0, 0.0, 0.0 }, radius });
}

/// A sphere of polygons, with so many of them along each of its circles.
inline vtkSmartPointer<vtkActor> NewSphere(
  double radius, const std::array<double, 3>& center, int resolution = 8)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(center[0], center[1], center[2]);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// A volume with its mapper in a renderer of a small window. Its surface is at 0, ivory and opaque.
struct Scene
{
  explicit Scene(vtkDataObject* data, int width = 160, int height = 160)
  {
    this->Mapper->SetInputDataObject(0, data);
    this->Volume->SetMapper(this->Mapper);
    this->Property()->ShadeOn();
    this->SetSurface(0.0, { 0.9, 0.8, 0.7 }, 1.0);
    this->Renderer->AddVolume(this->Volume);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Window->AddRenderer(this->Renderer);
    this->LookFrom(1.0, -2.0, 0.8);
  }

  vtkVolumeProperty* Property() { return this->Volume->GetProperty(); }

  /// The one surface there is.
  void SetSurface(double isovalue, const std::array<double, 3>& color, double opacity)
  {
    this->Property()->GetRGBTransferFunction()->RemoveAllPoints();
    this->Property()->GetScalarOpacity()->RemoveAllPoints();
    this->Property()->GetIsoSurfaceValues()->SetNumberOfContours(0);
    this->AddSurface(isovalue, color, opacity);
  }

  void AddSurface(double isovalue, const std::array<double, 3>& color, double opacity)
  {
    vtkContourValues* isovalues = this->Property()->GetIsoSurfaceValues();
    isovalues->SetValue(isovalues->GetNumberOfContours(), isovalue);
    this->Property()->GetRGBTransferFunction()->AddRGBPoint(isovalue, color[0], color[1], color[2]);
    this->Property()->GetScalarOpacity()->AddPoint(isovalue, opacity);
  }

  void LookFrom(double x, double y, double z)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(x, y, z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCamera();
    camera->Zoom(1.7);
    camera->SetParallelScale(camera->GetParallelScale() / 1.7);
  }

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

/// Red, green and blue of all pixels of a window, in rows from the bottom.
using Picture = std::vector<unsigned char>;

inline Picture Capture(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return Picture(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
}

inline Picture RenderAndCapture(vtkRenderWindow* window)
{
  window->Render();
  return Capture(window);
}

/// Aborts every frame of a window.
class Aborter : public vtkCommand
{
public:
  vtkTypeMacro(Aborter, vtkCommand);
  static Aborter* New() { return new Aborter; }
  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    static_cast<vtkRenderWindow*>(caller)->SetAbortRender(1);
  }
};

/// Begins a frame that is given up as soon as somebody asks.
inline void RenderAndAbort(vtkRenderWindow* window)
{
  vtkNew<Aborter> aborter;
  const unsigned long observer = window->AddObserver(vtkCommand::AbortCheckEvent, aborter);
  // VTK asks five times a second at most.
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  window->Render();
  window->SetAbortRender(0);
  window->RemoveObserver(observer);
}

inline std::array<int, 3> GetPixel(vtkRenderWindow* window, int x, int y)
{
  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(x, y, x, y, 0, pixel);
  return { pixel->GetValue(0), pixel->GetValue(1), pixel->GetValue(2) };
}

/// The ids of a prop that vtkHardwareSelector finds in the whole window: those of cells or points,
/// by the association (vtkDataObject::FIELD_ASSOCIATION_CELLS).
inline std::set<vtkIdType> Select(vtkRenderer* renderer, vtkProp* prop, int association)
{
  const int* size = renderer->GetRenderWindow()->GetSize();
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(
    0, 0, static_cast<unsigned int>(size[0] - 1), static_cast<unsigned int>(size[1] - 1));
  selector->SetFieldAssociation(association);
  const auto selection = vtk::TakeSmartPointer(selector->Select());
  std::set<vtkIdType> ids;
  for (unsigned int i = 0; selection && i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    auto* list = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    if (node->GetProperties()->Get(vtkSelectionNode::PROP()) == prop && list)
    {
      ids.insert(list->GetPointer(0), list->GetPointer(0) + list->GetNumberOfTuples());
    }
  }
  return ids;
}

/// The share of pixels of which a channel differs by more than so much.
inline double GetDifference(const Picture& a, const Picture& b, int tolerance)
{
  if (a.size() != b.size() || a.empty())
  {
    return 1.0;
  }
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); i += 3)
  {
    const auto differs = [&](std::size_t channel)
    { return std::abs(int{ a[i + channel] } - int{ b[i + channel] }) > tolerance; };
    different += differs(0) || differs(1) || differs(2) ? 1 : 0;
  }
  return 3.0 * static_cast<double>(different) / static_cast<double>(a.size());
}

/// Whether the window shows the baseline that the test driver was given: all but one pixel in 500
/// to within two steps of colour. VTK's own comparison overlooks much more; it is asked only to
/// leave the picture and the difference for people to see.
inline bool IsBaseline(int argc, char* argv[], vtkRenderWindow* window)
{
  std::string fileName;
  for (int i = 0; i + 1 < argc; ++i)
  {
    fileName = std::string(argv[i]) == "-V" ? argv[i + 1] : fileName;
  }
  vtkNew<vtkPNGReader> reader;
  double difference = 1.0;
  if (reader->CanReadFile(fileName.c_str()))
  {
    reader->SetFileName(fileName.c_str());
    reader->Update();
    auto* pixels =
      vtkUnsignedCharArray::SafeDownCast(reader->GetOutput()->GetPointData()->GetScalars());
    const Picture baseline(
      pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
    difference = GetDifference(RenderAndCapture(window), baseline, 2);
  }
  std::cout << "Different from " << fileName << ": " << 100.0 * difference << " % of the pixels\n";
  const int result = vtkRegressionTestImageThreshold(window, difference <= 0.002 ? 1e6 : -1.0);
  return difference <= 0.002 && result != 0;
}

/// Where in the world the depth buffer of a window puts its pixels.
class DepthPicture
{
public:
  DepthPicture(vtkRenderWindow* window, vtkRenderer* renderer)
  {
    const int* size = renderer->GetSize();
    const int* origin = renderer->GetOrigin();
    this->Width = size[0];
    this->Height = size[1];
    this->Depths.resize(static_cast<std::size_t>(this->Width * this->Height));
    window->GetZbufferData(origin[0], origin[1], origin[0] + this->Width - 1,
      origin[1] + this->Height - 1, this->Depths.data());
    this->WorldFromClip->DeepCopy(
      renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
        renderer->GetTiledAspectRatio(), -1.0, 1.0));
    this->WorldFromClip->Invert();
  }

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }

  double GetDepth(int x, int y) const
  {
    return static_cast<double>(this->Depths[static_cast<std::size_t>(x + y * this->Width)]);
  }

  bool IsEmpty(int x, int y) const { return this->GetDepth(x, y) >= 1.0; }

  /// The point at a depth behind the centre of a pixel.
  AnalyticFields::Point GetPoint(int x, int y, double depth) const
  {
    const double clip[4] = { 2.0 * (x + 0.5) / this->Width - 1.0,
      2.0 * (y + 0.5) / this->Height - 1.0, 2.0 * depth - 1.0, 1.0 };
    double world[4];
    this->WorldFromClip->MultiplyPoint(clip, world);
    return { world[0] / world[3], world[1] / world[3], world[2] / world[3] };
  }

  AnalyticFields::Point GetPoint(int x, int y) const
  {
    return this->GetPoint(x, y, this->GetDepth(x, y));
  }

private:
  int Width;
  int Height;
  std::vector<float> Depths;
  vtkNew<vtkMatrix4x4> WorldFromClip;
};

}

#endif
