// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "OffScreenWindow.h"

#include "Samples.h"
#include "vtkIsosurfaceComparisonFilter.h"

#include <vtkCamera.h>
#include <vtkProp.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <sstream>

namespace Benchmark
{

//------------------------------------------------------------------------------
OffScreenWindow::OffScreenWindow(int size)
{
  this->Window->SetOffScreenRendering(true);
  this->Window->SetMultiSamples(0);
  this->Window->SetSize(size, size);
  this->Window->AddRenderer(this->Renderer);
  this->Renderer->SetBackground(0.0, 0.0, 1.0);
  this->Window->Render(); // What OpenGL does once is not measured.
}

//------------------------------------------------------------------------------
OffScreenWindow::~OffScreenWindow() = default;

//------------------------------------------------------------------------------
bool OffScreenWindow::IsPossible()
{
  return vtkIsosurfaceComparisonFilter::WhyNoPictures().empty();
}

//------------------------------------------------------------------------------
void OffScreenWindow::Show(vtkProp* prop)
{
  this->Renderer->RemoveAllViewProps();
  this->Renderer->AddViewProp(prop);
}

//------------------------------------------------------------------------------
double OffScreenWindow::Draw(const View& view)
{
  view.Apply(this->Renderer->GetActiveCamera());
  this->Renderer->ResetCameraClippingRange();
  return Measure(
    [this]()
    {
      this->Window->Render();
      this->Window->WaitForCompletion();
    });
}

//------------------------------------------------------------------------------
std::vector<unsigned char> OffScreenWindow::GetColors()
{
  const int* size = this->Window->GetSize();
  vtkNew<vtkUnsignedCharArray> pixels;
  this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

//------------------------------------------------------------------------------
std::vector<bool> OffScreenWindow::GetDrawn()
{
  const std::vector<unsigned char> colors = this->GetColors();
  std::vector<bool> drawn;
  for (std::size_t i = 0; i < colors.size(); i += 3)
  {
    // No surface has more blue than red: less than half of the pixel is background.
    drawn.push_back(colors[i + 2] - colors[i] < 128);
  }
  return drawn;
}

//------------------------------------------------------------------------------
double OffScreenWindow::GetShareDrawn()
{
  const std::vector<bool> drawn = this->GetDrawn();
  return static_cast<double>(std::count(drawn.begin(), drawn.end(), true)) /
    static_cast<double>(drawn.size());
}

//------------------------------------------------------------------------------
std::array<double, 2> OffScreenWindow::GetClippingRange()
{
  std::array<double, 2> range;
  this->Renderer->GetActiveCamera()->GetClippingRange(range.data());
  return range;
}

//------------------------------------------------------------------------------
std::string OffScreenWindow::GetDriver()
{
  const std::string title = "OpenGL renderer string:";
  std::istringstream capabilities(this->Window->ReportCapabilities());
  std::string line;
  while (std::getline(capabilities, line))
  {
    if (line.compare(0, title.size(), title) == 0)
    {
      return line.substr(line.find_first_not_of(' ', title.size()));
    }
  }
  return "unknown";
}

}
