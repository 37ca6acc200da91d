// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The translucent fragments of a picture, as layers with a depth for every pixel: a render pass
// that peels depths puts them among those of polygons.

#ifndef vtkIsosurfaceRayTraceLayers_h
#define vtkIsosurfaceRayTraceLayers_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkWeakPointer.h"                // for ivars

#include "Picture/Compositor.h"

#include <map>    // for std::map
#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkTextureObject;
class vtkWindow;

class vtkIsosurfaceRayTraceLayers
{
public:
  /// Where a picture is in the viewport: its lower left corner, and how many pixels of the window a
  /// column or a row of it takes.
  struct Placement
  {
    int X;
    int Y;
    int Columns;
    int PixelsOfColumn;
  };

  vtkIsosurfaceRayTraceLayers();
  ~vtkIsosurfaceRayTraceLayers();
  vtkIsosurfaceRayTraceLayers(const vtkIsosurfaceRayTraceLayers&) = delete;
  void operator=(const vtkIsosurfaceRayTraceLayers&) = delete;

  /// Makes the layers of a frame: the first translucent fragment of every pixel, the second, and so
  /// on. Those of a pixel follow each other front to back.
  void Set(vtkOpenGLRenderWindow* window,
    const std::vector<vtkIsosurfaceRayTracing::FragmentOfPixel>& fragments,
    const Placement& placement);
  void Clear();

  /// Draws them as the render passes of the prop have it, into the current viewport.
  void Draw(vtkOpenGLRenderWindow* window, vtkProp* prop);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  /// Its rectangle is in pixels of the viewport.
  struct Layer
  {
    int X;
    int Y;
    int Width;
    int Height;
    vtkSmartPointer<vtkTextureObject> Colors;
    vtkSmartPointer<vtkTextureObject> Depths;
  };

  vtkWeakPointer<vtkOpenGLRenderWindow> Window;
  std::vector<Layer> Layers;
  /// By their fragment shaders: passes draw in several stages.
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> Quads;
};

VTK_ABI_NAMESPACE_END

#endif
