// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OffScreenWindow_h
#define OffScreenWindow_h

#include "Views.h"

#include <vtkNew.h>

#include <array>
#include <array>
#include <string>
#include <vector>

class vtkProp;
class vtkRenderWindow;
class vtkRenderer;

namespace Benchmark
{

/// A square render window that nobody sees, with a light at the eye before a blue background.
class OffScreenWindow
{
public:
  explicit OffScreenWindow(int size);
  ~OffScreenWindow();
  OffScreenWindow(const OffScreenWindow&) = delete;
  OffScreenWindow& operator=(const OffScreenWindow&) = delete;

  /// Whether windows can be had; VTK itself would end the program where there is no display.
  static bool IsPossible();

  /// Shows this and nothing else.
  void Show(vtkProp* prop);
  /// Seconds until the frame is finished.
  double Draw(const View& view);
  /// Whether its pixels show something, in rows from the bottom.
  std::vector<bool> GetDrawn();
  /// The share of its pixels that do.
  double GetShareDrawn();
  /// The distances, along the view, of the first and last depth of its pixels.
  std::array<double, 2> GetClippingRange();
  /// The depth buffer, between 0 and 1, and the red of the pixels, in rows from the bottom.
  std::vector<float> GetDepths();
  std::vector<unsigned char> GetReds();
  vtkRenderWindow* GetWindow() { return this->Window; }
  /// The distances of the camera's clipping planes.
  std::array<double, 2> GetClippingRange();
  /// Who draws, in the words of OpenGL.
  std::string GetDriver();

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

}

#endif
