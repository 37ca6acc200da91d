// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Draws a picture with a depth for every pixel into the current framebuffer of an OpenGL render
// window: that of the window, or of a render pass.

#ifndef vtkIsosurfaceRayTraceImageDisplay_h
#define vtkIsosurfaceRayTraceImageDisplay_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                        // for ivars

#include <array>   // for std::array
#include <cstdint> // for std::uint8_t
#include <memory>  // for std::unique_ptr
#include <string>  // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkOpenGLQuadHelper;
class vtkOpenGLRenderPass;
class vtkOpenGLRenderWindow;
class vtkProp;
class vtkTextureObject;
class vtkWindow;

class vtkIsosurfaceRayTraceImageDisplay
{
public:
  /// A picture and its rectangle in the framebuffer, in pixels from the lower left. It may have
  /// fewer columns and rows than the rectangle.
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
    /// The depth of opaque pixels, in [0, 1]; greater than 1 elsewhere.
    const float* Depths;
    /// Whether every pixel is either opaque or empty.
    bool Opaque;
    /// Whether colours are interpolated between columns and rows.
    bool Interpolated;
  };

  /// What a render pass that uses the geometry needs as well: for every pixel the point and the
  /// normal of the surface, in view coordinates.
  struct Geometry
  {
    vtkOpenGLRenderPass* Pass;
    vtkProp* Prop;
    const float* Positions;
    const float* Normals;
  };

  vtkIsosurfaceRayTraceImageDisplay();
  ~vtkIsosurfaceRayTraceImageDisplay();
  vtkIsosurfaceRayTraceImageDisplay(const vtkIsosurfaceRayTraceImageDisplay&) = delete;
  void operator=(const vtkIsosurfaceRayTraceImageDisplay&) = delete;

  /// The viewport of the framebuffer, in pixels: x, y, width and height.
  static std::array<int, 4> GetViewport(vtkOpenGLRenderWindow* window);

  /// Reads the depth buffer in a rectangle of the framebuffer.
  static void ReadDepths(
    vtkOpenGLRenderWindow* window, int x, int y, int width, int height, float* depths);

  /// Blends the colours over the framebuffer, and writes the depths where they are nearer. Colours
  /// that are opaque are drawn where they are nearer, others everywhere. The geometry may be null;
  /// with it, the picture must be opaque, and is not interpolated.
  void Display(vtkOpenGLRenderWindow* window, const Image& image, const Geometry* geometry);

  void ReleaseGraphicsResources(vtkWindow* window);

  /// Makes a quad that is drawn with a fragment shader, or makes its shaders current. Returns
  /// whether it can be drawn.
  static bool MakeReady(vtkOpenGLRenderWindow* window, const std::string& fragmentShader,
    std::unique_ptr<vtkOpenGLQuadHelper>& quad);

private:
  /// What is drawn at a time.
  struct Layer
  {
    bool HasColors;
    bool HasDepths;
    bool TestDepth;
  };

  void Draw(vtkOpenGLRenderWindow* window, const Layer& layer);
  void DrawGeometry(vtkOpenGLRenderWindow* window, const Image& image, const Geometry& geometry);
  /// Draws a quad that is ready, with the textures of colours and depths.
  void Render(vtkOpenGLQuadHelper& quad, bool hasDepths);

  vtkNew<vtkTextureObject> ColorTexture;
  vtkNew<vtkTextureObject> DepthTexture;
  vtkNew<vtkTextureObject> PositionTexture;
  vtkNew<vtkTextureObject> NormalTexture;
  std::unique_ptr<vtkOpenGLQuadHelper> Quad;
  std::unique_ptr<vtkOpenGLQuadHelper> InterpolatingQuad;
  std::unique_ptr<vtkOpenGLQuadHelper> GeometryQuad;
};

VTK_ABI_NAMESPACE_END

#endif
