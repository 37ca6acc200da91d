// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceImageDisplay.h"

#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

VTK_ABI_NAMESPACE_BEGIN

namespace
{

// Numbers that OpenGL fixes. The header that declares them is GLEW's in some versions of VTK and
// GLAD's in others.
constexpr unsigned int GLOne = 1;
constexpr unsigned int GLOneMinusSourceAlpha = 0x0303;
constexpr unsigned int GLLessOrEqual = 0x0203;
constexpr unsigned int GLDepthTest = 0x0B71;
constexpr unsigned int GLBlend = 0x0BE2;

const char* const FragmentShader = R"(//VTK::System::Dec
//VTK::Output::Dec
in vec2 texCoord;
uniform sampler2D colors;
uniform sampler2D depths;
uniform int drawDepths;
void main()
{
  vec4 color = texture(colors, texCoord);
  float depth = texture(depths, texCoord).r;
  if (drawDepths != 0 ? depth > 1.0 : color.a <= 0.0)
  {
    discard;
  }
  gl_FragDepth = min(depth, 1.0);
  gl_FragData[0] = color;
}
)";

}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageDisplay::vtkIsosurfaceRayTraceImageDisplay() = default;

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceImageDisplay::~vtkIsosurfaceRayTraceImageDisplay() = default;

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::ReleaseGraphicsResources(vtkWindow* window)
{
  this->ColorTexture->ReleaseGraphicsResources(window);
  this->DepthTexture->ReleaseGraphicsResources(window);
  this->Quad.reset();
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::Display(vtkOpenGLRenderWindow* window, const Image& image)
{
  if (this->ColorTexture->GetContext() != window)
  {
    this->ReleaseGraphicsResources(this->ColorTexture->GetContext());
    this->ColorTexture->SetContext(window);
    this->DepthTexture->SetContext(window);
  }
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

  if (image.Opaque)
  {
    this->Draw(window, true, true);
  }
  else
  {
    // What is translucent leaves no depth, or it would hide what is drawn behind it later.
    this->Draw(window, true, false);
    this->Draw(window, false, true);
  }
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceImageDisplay::Draw(
  vtkOpenGLRenderWindow* window, bool drawColors, bool drawDepths)
{
  vtkOpenGLState* state = window->GetState();
  const auto colorMask = static_cast<unsigned char>(drawColors);
  state->vtkglColorMask(colorMask, colorMask, colorMask, colorMask);
  state->vtkglDepthMask(static_cast<unsigned char>(drawDepths));
  // The rays have been cut at the depth of the scene already; only what writes depth is tested.
  drawDepths ? state->vtkglEnable(GLDepthTest) : state->vtkglDisable(GLDepthTest);

  if (!this->Quad)
  {
    this->Quad = std::make_unique<vtkOpenGLQuadHelper>(window, nullptr, FragmentShader, nullptr);
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  if (!this->Quad->Program)
  {
    return; // VTK has said why.
  }
  this->ColorTexture->Activate();
  this->DepthTexture->Activate();
  this->Quad->Program->SetUniformi("colors", this->ColorTexture->GetTextureUnit());
  this->Quad->Program->SetUniformi("depths", this->DepthTexture->GetTextureUnit());
  this->Quad->Program->SetUniformi("drawDepths", drawDepths ? 1 : 0);
  this->Quad->Render();
  this->DepthTexture->Deactivate();
  this->ColorTexture->Deactivate();
}

VTK_ABI_NAMESPACE_END
