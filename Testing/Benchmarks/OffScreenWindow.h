// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OffScreenWindow_h
#define OffScreenWindow_h

#include "Views.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkNew.h>

#include <array>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkProp;
class vtkRenderWindow;
class vtkRenderer;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// A square render window off screen, with a light at the eye before a blue background.
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
  /// Red, green and blue of its pixels, in rows from the bottom.
  std::vector<unsigned char> GetColors();
  /// Whether its pixels show something, in rows from the bottom.
  std::vector<bool> GetDrawn();
  /// The share of its pixels that do.
  double GetShareDrawn();
  /// How far from the eye the nearest and the farthest depth are, along the view.
  std::array<double, 2> GetClippingRange();
  /// The renderer, in the words of OpenGL.
  std::string GetDriver();

private:
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

}

#endif
