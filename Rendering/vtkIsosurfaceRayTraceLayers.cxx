// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceLayers.h"

#include "vtkIsosurfaceRayTraceImageDisplay.h"
#include "vtkIsosurfaceRayTracePasses.h"

#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include "Math/Vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

VTK_ABI_NAMESPACE_BEGIN

namespace vtkirt = vtkIsosurfaceRayTracing;

namespace
{

// With the names that a vtkOpenGLRenderPass looks for in the shaders of polygons.
const char* const FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
//VTK::DepthPeeling::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
void main()
{
  float depth = texture(depths, texCoord).r;
  if (depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = depth;
  //VTK::DepthPeeling::PreColor
  gl_FragData[0] = texture(colors, texCoord);
  //VTK::DepthPeeling::Impl
}
)";

/// The fragments of a layer, in the smallest rectangle of pixels that holds them.
struct LayerImage
{
  int Left = std::numeric_limits<int>::max();
  int Bottom = std::numeric_limits<int>::max();
  int Right = 0;
  int Top = 0;
  /// Red, green, blue, and opacity.
  std::vector<float> Colors;
  std::vector<float> Depths;

  int GetWidth() const { return this->Right - this->Left; }
  int GetHeight() const { return this->Top - this->Bottom; }

  void Include(int column, int row)
  {
    this->Left = std::min(this->Left, column);
    this->Bottom = std::min(this->Bottom, row);
    this->Right = std::max(this->Right, column + 1);
    this->Top = std::max(this->Top, row + 1);
  }

  void MakeEmpty()
  {
    const std::size_t count = vtkirt::Count({ this->GetWidth(), this->GetHeight(), 1 });
    this->Colors.assign(4 * count, 0.0F);
    this->Depths.assign(count, vtkirt::PixelWithoutDepth);
  }

  void Set(int column, int row, const vtkirt::Fragment& fragment)
  {
    const std::size_t pixel = static_cast<std::size_t>(column - this->Left) +
      static_cast<std::size_t>(row - this->Bottom) * static_cast<std::size_t>(this->GetWidth());
    // Polygons have colours that are not multiplied by the opacity.
    std::transform(fragment.Color.begin(), fragment.Color.end(), &this->Colors[4 * pixel],
      [&fragment](double color) { return static_cast<float>(color / fragment.Opacity); });
    this->Colors[4 * pixel + 3] = static_cast<float>(fragment.Opacity);
    this->Depths[pixel] = fragment.Depth;
  }
};

/// Calls a function with the layer, the column, the row and the fragment of each that is
/// translucent.
template <typename Function>
void ForTranslucent(
  const std::vector<vtkirt::FragmentOfPixel>& fragments, int columns, const Function& function)
{
  const auto width = static_cast<std::size_t>(columns);
  std::size_t layer = 0;
  for (std::size_t i = 0; i < fragments.size(); ++i)
  {
    const std::size_t pixel = fragments[i].Pixel;
    layer = i > 0 && pixel == fragments[i - 1].Pixel ? layer + 1 : 0;
    if (fragments[i].Own.Opacity < 1.0)
    {
      function(
        layer, static_cast<int>(pixel % width), static_cast<int>(pixel / width), fragments[i].Own);
    }
  }
}

std::vector<LayerImage> MakeImages(
  const std::vector<vtkirt::FragmentOfPixel>& fragments, int columns)
{
  std::vector<LayerImage> images;
  ForTranslucent(fragments, columns,
    [&images](std::size_t layer, int column, int row, const vtkirt::Fragment&)
    {
      images.resize(std::max(images.size(), layer + 1));
      images[layer].Include(column, row);
    });
  for (LayerImage& image : images)
  {
    image.MakeEmpty();
  }
  ForTranslucent(fragments, columns,
    [&images](std::size_t layer, int column, int row, const vtkirt::Fragment& fragment)
    { images[layer].Set(column, row, fragment); });
  return images;
}

/// The numbers are only read; the interface of vtkTextureObject does not say so.
vtkSmartPointer<vtkTextureObject> NewTexture(vtkOpenGLRenderWindow* window, const LayerImage& image,
  int components, std::vector<float>& numbers)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->Create2DFromRaw(static_cast<unsigned int>(image.GetWidth()),
    static_cast<unsigned int>(image.GetHeight()), components, VTK_FLOAT, numbers.data());
  return texture;
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceLayers::vtkIsosurfaceRayTraceLayers() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceLayers::~vtkIsosurfaceRayTraceLayers() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceLayers::Set(vtkOpenGLRenderWindow* window,
  const std::vector<vtkirt::FragmentOfPixel>& fragments, const Placement& placement)
{
  this->Clear();
  this->Window = window;
  const int size = placement.PixelsOfColumn;
  for (LayerImage& image : MakeImages(fragments, placement.Columns))
  {
    this->Layers.push_back({ placement.X + size * image.Left, placement.Y + size * image.Bottom,
      size * image.GetWidth(), size * image.GetHeight(), NewTexture(window, image, 4, image.Colors),
      NewTexture(window, image, 1, image.Depths) });
    image = {}; // It is large.
  }
}

//------------------------------------------------------------------------------
/// The window may release the shaders of quads between frames.
void vtkIsosurfaceRayTraceLayers::Clear()
{
  this->Layers.clear();
  this->Quads.clear();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceLayers::Draw(vtkOpenGLRenderWindow* window, vtkProp* prop)
{
  if (this->Layers.empty() || this->Window != window)
  {
    return;
  }
  const std::vector<vtkOpenGLRenderPass*> passes = vtkIsosurfaceRayTracePasses::Find(prop);
  const std::string shader = vtkIsosurfaceRayTracePasses::MakeShader(passes, prop, FragmentShader);
  std::unique_ptr<vtkOpenGLQuadHelper>& quad = this->Quads[shader];
  if (!vtkIsosurfaceRayTraceImageDisplay::MakeReady(window, shader, quad))
  {
    return;
  }
  const vtkNew<vtkOpenGLPolyDataMapper> mapper;
  for (vtkOpenGLRenderPass* pass : passes)
  {
    pass->SetShaderParameters(quad->Program, mapper, prop);
  }
  // All else is as the pass has set it.
  vtkOpenGLState* state = window->GetState();
  const std::array<int, 4> whole = vtkIsosurfaceRayTraceImageDisplay::GetViewport(window);
  const vtkOpenGLState::ScopedglViewport viewport(state);
  // Where a pass does not peel any more, it blends: the farthest first.
  for (auto layer = this->Layers.rbegin(); layer != this->Layers.rend(); ++layer)
  {
    state->vtkglViewport(whole[0] + layer->X, whole[1] + layer->Y, layer->Width, layer->Height);
    layer->Colors->Activate();
    layer->Depths->Activate();
    quad->Program->SetUniformi("colors", layer->Colors->GetTextureUnit());
    quad->Program->SetUniformi("depths", layer->Depths->GetTextureUnit());
    quad->Render();
    layer->Depths->Deactivate();
    layer->Colors->Deactivate();
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceLayers::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const Layer& layer : this->Layers)
  {
    layer.Colors->ReleaseGraphicsResources(window);
    layer.Depths->ReleaseGraphicsResources(window);
  }
  this->Clear();
}

VTK_ABI_NAMESPACE_END
