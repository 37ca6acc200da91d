// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Pictures_h
#define Pictures_h

#include <vtkCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPointData.h>
#include <vtkRegressionTestImage.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

namespace MapperTesting
{

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

/// Begins a frame that is aborted at the first opportunity.
inline void RenderAndAbort(vtkRenderWindow* window)
{
  vtkNew<Aborter> aborter;
  const unsigned long observer = window->AddObserver(vtkCommand::AbortCheckEvent, aborter);
  // VTK checks five times a second at most.
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
/// to within two steps of colour. VTK's own comparison overlooks much more; it is used only to
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

}

#endif
