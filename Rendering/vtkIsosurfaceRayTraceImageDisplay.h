// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Draws a picture with a depth for every pixel into an OpenGL render window.

#ifndef vtkIsosurfaceRayTraceImageDisplay_h
#define vtkIsosurfaceRayTraceImageDisplay_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars

#include <cstdint> // for std::uint8_t
#include <memory>  // for std::unique_ptr

VTK_ABI_NAMESPACE_BEGIN

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

class vtkIsosurfaceRayTraceImageDisplay
{
public:
  /// A picture and its place in the window, in pixels from the lower left. It may have fewer
  /// columns and rows than that place.
  struct Image
  {
    int X;
    int Y;
    int Width;
    int Height;
    int Columns;
    int Rows;
    /// Red, green, blue and opacity of every pixel, the colours multiplied by the opacity.
    const std::uint8_t* Colors;
    /// The depth of what is opaque, in [0, 1]; greater than 1 where nothing is.
    const float* Depths;
    /// Whether every pixel is either opaque or empty.
    bool Opaque;
  };

  vtkIsosurfaceRayTraceImageDisplay();
  ~vtkIsosurfaceRayTraceImageDisplay();
  vtkIsosurfaceRayTraceImageDisplay(const vtkIsosurfaceRayTraceImageDisplay&) = delete;
  void operator=(const vtkIsosurfaceRayTraceImageDisplay&) = delete;

  /// Blends the colours over what the window shows, and writes the depths where they are nearer.
  void Display(vtkOpenGLRenderWindow* window, const Image& image);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void Draw(vtkOpenGLRenderWindow* window, bool drawColors, bool drawDepths);

  vtkNew<vtkTextureObject> ColorTexture;
  vtkNew<vtkTextureObject> DepthTexture;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
};

VTK_ABI_NAMESPACE_END

#endif
