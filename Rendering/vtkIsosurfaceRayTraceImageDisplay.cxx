// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceImageDisplay.h"

#include "vtkIsosurfaceRayTracePasses.h"

#include "vtkNew.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

// Values of OpenGL constants. The header that declares them is GLEW's in some versions of VTK and
// GLAD's in others.
constexpr unsigned int GLOne = 1;
constexpr unsigned int GLOneMinusSourceAlpha = 0x0303;
constexpr unsigned int GLLessOrEqual = 0x0203;
constexpr unsigned int GLDepthTest = 0x0B71;
constexpr unsigned int GLBlend = 0x0BE2;
constexpr unsigned int GLViewport = 0x0BA2;
constexpr unsigned int GLDepthComponent = 0x1902;
constexpr unsigned int GLFloat = 0x1406;

const char* const FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
uniform int drawDepths;
//Geometry::Dec
//Depth::Dec
void main()
{
  vec4 color = texture(colors, texCoord);
  if (drawDepths == 0 && color.a <= 0.0)
  {
    discard;
  }
  float depth = readDepth();
  if (drawDepths != 0 && depth > 1.0)
  {
    discard;
  }
  gl_FragDepth = min(depth, 1.0);
  gl_FragData[0] = color;
  //Geometry::Impl
}
)";

// Shaders of their own, not branches of one: Mesa's renderer on the processor goes through both
// sides of a branch, and the mean takes longer than all the rest.
const char* const DepthOfPixel = R"(float readDepth()
{
  return texture(depths, texCoord).r;
}
)";
const char* const MeanOfDepths = R"(float readDepth()
{
  // Of the four depths around, those that there are, by the weights of a linear filter.
  ivec2 last = textureSize(depths, 0) - 1;
  vec2 position = texCoord * vec2(last + 1) - 0.5;
  ivec2 corner = ivec2(floor(position));
  vec2 upper = fract(position);
  float sum = 0.0;
  float weights = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    ivec2 side = ivec2(i % 2, i / 2);
    float depth = texelFetch(depths, clamp(corner + side, ivec2(0), last), 0).r;
    vec2 weight = mix(1.0 - upper, upper, vec2(side));
    if (depth <= 1.0)
    {
      sum += weight.x * weight.y * depth;
      weights += weight.x * weight.y;
    }
  }
  return weights > 0.0 ? sum / weights : 1.0;
}
)";

// The names that a vtkOpenGLRenderPass looks for in the shaders of polygons.
const char* const GeometryDeclaration = R"(uniform sampler2D positions;
uniform sampler2D normals;
)";
const char* const GeometryImplementation = R"(
  vec4 vertexVC = vec4(texture(positions, texCoord).xyz, 1.0);
  vec3 normalVCVSOutput = texture(normals, texCoord).xyz;
  //VTK::Light::Impl
)";

/// The fragment shader, given the function that reads depths.
std::string MakeShader(const char* readDepth)
{
  std::string shader = FragmentShader;
  vtkShaderProgram::Substitute(shader, "//Depth::Dec", readDepth);
  return shader;
}

/// The fragment shader that a render pass makes from ours.
std::string MakeGeometryShader(const vtkIsosurfaceRayTraceImageDisplay::Geometry& geometry)
{
  std::string shader = MakeShader(DepthOfPixel);
  vtkShaderProgram::Substitute(shader, "//Geometry::Dec", GeometryDeclaration);
  vtkShaderProgram::Substitute(shader, "//Geometry::Impl", GeometryImplementation);
  return vtkIsosurfaceRayTracePasses::MakeShader({ geometry.Pass }, geometry.Prop, shader);
}

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageDisplay::vtkIsosurfaceRayTraceImageDisplay()
{
  // What is interpolated has no other side.
  this->ColorTexture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->ColorTexture->SetWrapT(vtkTextureObject::ClampToEdge);
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageDisplay::~vtkIsosurfaceRayTraceImageDisplay() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ColorTexture->ReleaseGraphicsResources(window);
  this->DepthTexture->ReleaseGraphicsResources(window);
  this->PositionTexture->ReleaseGraphicsResources(window);
  this->NormalTexture->ReleaseGraphicsResources(window);
  this->Quad.reset();
  this->InterpolatingQuad.reset();
  this->GeometryQuad.reset();
}

//------------------------------------------------------------------------------
std::array<int, 4> vtkIsosurfaceRayTraceImageDisplay::GetViewport(vtkOpenGLRenderWindow* window)
{
  std::array<int, 4> viewport;
  window->GetState()->vtkglGetIntegerv(GLViewport, viewport.data());
  return viewport;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::ReadDepths(
  vtkOpenGLRenderWindow* window, int x, int y, int width, int height, float* depths)
{
  unsigned int framebuffer = 0;
  unsigned int buffer = 0;
  window->GetState()->GetCurrentDrawFramebufferState(framebuffer, buffer);
  if (framebuffer == window->GetRenderFramebuffer()->GetFBOIndex())
  {
    // The window resolves several samples per pixel.
    window->GetZbufferData(x, y, x + width - 1, y + height - 1, depths);
    return;
  }
  vtkNew<vtkPixelBufferObject> pixels;
  pixels->SetContext(window);
  int extent[4] = { x, x + width - 1, y, y + height - 1 };
  vtkOpenGLFramebufferObject::Download(
    extent, VTK_FLOAT, 1, static_cast<int>(GLFloat), static_cast<int>(GLDepthComponent), pixels);
  unsigned int size[2] = { static_cast<unsigned int>(width), static_cast<unsigned int>(height) };
  vtkIdType increments[2] = { 0, 0 };
  pixels->Download2D(VTK_FLOAT, depths, size, 1, increments);
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::Display(
  vtkOpenGLRenderWindow* window, const Image& image, const Geometry* geometry)
{
  // A window that is finalized releases its textures and shaders.
  if (this->ColorTexture->GetContext() != window || this->ColorTexture->GetHandle() == 0)
  {
    this->ReleaseGraphicsResources(this->ColorTexture->GetContext());
    this->ColorTexture->SetContext(window);
    this->DepthTexture->SetContext(window);
    this->PositionTexture->SetContext(window);
    this->NormalTexture->SetContext(window);
  }
  const int filter = image.Interpolated ? vtkTextureObject::Linear : vtkTextureObject::Nearest;
  this->ColorTexture->SetMagnificationFilter(filter);
  this->ColorTexture->SetMinificationFilter(filter);
  const auto width = static_cast<unsigned int>(image.Columns);
  const auto height = static_cast<unsigned int>(image.Rows);
  // The textures are only read from; the interface of vtkTextureObject does not say so.
  this->ColorTexture->Create2DFromRaw(
    width, height, 4, VTK_UNSIGNED_CHAR, const_cast<std::uint8_t*>(image.Colors));
  this->DepthTexture->Create2DFromRaw(
    width, height, 1, VTK_FLOAT, const_cast<float*>(image.Depths));

  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GLDepthTest);
  const vtkOpenGLState::ScopedglEnableDisable blend(state, GLBlend);
  const vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  const vtkOpenGLState::ScopedglColorMask colorMask(state);
  const vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  state->vtkglViewport(image.X, image.Y, image.Width, image.Height);
  state->vtkglEnable(GLBlend);
  state->vtkglBlendFuncSeparate(GLOne, GLOneMinusSourceAlpha, GLOne, GLOneMinusSourceAlpha);
  state->vtkglDepthFunc(GLLessOrEqual);

  if (geometry)
  {
    this->DrawGeometry(window, image, *geometry);
  }
  else if (image.Opaque && !image.Interpolated)
  {
    state->vtkglDisable(GLBlend);
    this->Draw(window, { true, true, true });
  }
  else
  {
    // Translucent pixels write no depth, or they would hide what is drawn behind them later. Where
    // rays have been cut at the depth of the scene, there is nothing to test.
    this->Draw(window, { true, false, image.Opaque });
    this->Draw(window, { false, true, true });
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::Draw(vtkOpenGLRenderWindow* window, const Layer& layer)
{
  vtkOpenGLState* state = window->GetState();
  const auto colorMask = static_cast<unsigned char>(layer.HasColors);
  state->vtkglColorMask(colorMask, colorMask, colorMask, colorMask);
  state->vtkglDepthMask(static_cast<unsigned char>(layer.HasDepths));
  layer.TestDepth ? state->vtkglEnable(GLDepthTest) : state->vtkglDisable(GLDepthTest);

  // Depths that are tested and not drawn are those of interpolated colours.
  const bool areInterpolated = layer.TestDepth && !layer.HasDepths;
  auto& quad = areInterpolated ? this->InterpolatingQuad : this->Quad;
  const char* readDepth = areInterpolated ? MeanOfDepths : DepthOfPixel;
  if (vtkIsosurfaceRayTraceImageDisplay::MakeReady(window, MakeShader(readDepth), quad))
  {
    this->Render(*quad, layer.HasDepths);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::DrawGeometry(
  vtkOpenGLRenderWindow* window, const Image& image, const Geometry& geometry)
{
  vtkOpenGLState* state = window->GetState();
  state->vtkglColorMask(1, 1, 1, 1);
  state->vtkglDepthMask(1);
  state->vtkglEnable(GLDepthTest);
  const auto width = static_cast<unsigned int>(image.Columns);
  const auto height = static_cast<unsigned int>(image.Rows);
  this->PositionTexture->Create2DFromRaw(
    width, height, 3, VTK_FLOAT, const_cast<float*>(geometry.Positions));
  this->NormalTexture->Create2DFromRaw(
    width, height, 3, VTK_FLOAT, const_cast<float*>(geometry.Normals));
  if (!vtkIsosurfaceRayTraceImageDisplay::MakeReady(
        window, MakeGeometryShader(geometry), this->GeometryQuad))
  {
    return;
  }
  const vtkNew<vtkOpenGLPolyDataMapper> mapper;
  geometry.Pass->SetShaderParameters(this->GeometryQuad->Program, mapper, geometry.Prop);
  this->PositionTexture->Activate();
  this->NormalTexture->Activate();
  this->GeometryQuad->Program->SetUniformi("positions", this->PositionTexture->GetTextureUnit());
  this->GeometryQuad->Program->SetUniformi("normals", this->NormalTexture->GetTextureUnit());
  this->Render(*this->GeometryQuad, true);
  this->NormalTexture->Deactivate();
  this->PositionTexture->Deactivate();
}

//------------------------------------------------------------------------------
bool vtkIsosurfaceRayTraceImageDisplay::MakeReady(vtkOpenGLRenderWindow* window,
  const std::string& fragmentShader, std::unique_ptr<vtkOpenGLQuadHelper>& quad)
{
  if (!quad)
  {
    quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, fragmentShader.c_str(), nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  return quad->Program != nullptr; // If not, VTK has reported why.
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::Render(vtkOpenGLQuadHelper& quad, bool hasDepths)
{
  this->ColorTexture->Activate();
  this->DepthTexture->Activate();
  quad.Program->SetUniformi("colors", this->ColorTexture->GetTextureUnit());
  quad.Program->SetUniformi("depths", this->DepthTexture->GetTextureUnit());
  quad.Program->SetUniformi("drawDepths", hasDepths ? 1 : 0);
  quad.Render();
  this->DepthTexture->Deactivate();
  this->ColorTexture->Deactivate();
}

VTK_ABI_NAMESPACE_END
