// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfaceRayTraceSceneDepths.h"

#include "vtkFloatArray.h"
#include "vtkIsosurfacePicture.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkPixelBufferObject.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkType.h"

#include <vector>

VTK_ABI_NAMESPACE_BEGIN

namespace
{
// Values of OpenGL constants. The header that declares them is GLEW's in some versions of VTK and
// GLAD's in others.
constexpr unsigned int GLDepthTest = 0x0B71;
constexpr unsigned int GLScissorTest = 0x0C11;
constexpr unsigned int GLDepthBufferBit = 0x0100;

constexpr int DepthBits = 24; // as windows of VTK have

//------------------------------------------------------------------------------
std::vector<vtkProp*> FindOpaqueProps(vtkRenderer* renderer)
{
  std::vector<vtkProp*> props;
  vtkPropCollection* all = renderer->GetViewProps();
  vtkCollectionSimpleIterator next;
  all->InitTraversal(next);
  while (vtkProp* prop = all->GetNextProp(next))
  {
    if (prop->GetVisibility() && !prop->IsA("vtkIsosurfacePicture") && prop->HasOpaqueGeometry())
    {
      props.push_back(prop);
    }
  }
  return props;
}
}

//------------------------------------------------------------------------------
vtkIsosurfaceRayTraceSceneDepths::vtkIsosurfaceRayTraceSceneDepths() = default;
vtkIsosurfaceRayTraceSceneDepths::~vtkIsosurfaceRayTraceSceneDepths() = default;

//------------------------------------------------------------------------------
vtkSmartPointer<vtkFloatArray> vtkIsosurfaceRayTraceSceneDepths::Find(
  vtkRenderer* renderer, int width, int height)
{
  const std::vector<vtkProp*> props = FindOpaqueProps(renderer);
  if (props.empty())
  {
    return nullptr;
  }
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  vtkOpenGLState* state = window->GetState();
  const vtkOpenGLState::ScopedglViewport viewport(state);
  const vtkOpenGLState::ScopedglScissor scissor(state);
  const vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GLScissorTest);
  const vtkOpenGLState::ScopedglEnableDisable depthTest(state, GLDepthTest);
  const vtkOpenGLState::ScopedglDepthMask depthMask(state);
  state->PushFramebufferBindings();
  this->Framebuffer->SetContext(window);
  this->Framebuffer->PopulateFramebuffer(
    width, height, true, 1, VTK_UNSIGNED_CHAR, true, DepthBits, 0);
  this->Framebuffer->StartNonOrtho(width, height);
  state->vtkglViewport(0, 0, width, height);
  state->vtkglDisable(GLScissorTest);
  state->vtkglEnable(GLDepthTest);
  state->vtkglDepthMask(1);
  state->vtkglClearDepth(1.0);
  state->vtkglClear(GLDepthBufferBit);
  for (vtkProp* prop : props)
  {
    prop->RenderOpaqueGeometry(renderer);
  }
  int extent[4] = { 0, width - 1, 0, height - 1 };
  const auto pixels = vtk::TakeSmartPointer(this->Framebuffer->DownloadDepth(extent, VTK_FLOAT));
  state->PopFramebufferBindings();
  auto depths = vtkSmartPointer<vtkFloatArray>::New();
  depths->SetNumberOfValues(static_cast<vtkIdType>(width) * height);
  unsigned int size[2] = { static_cast<unsigned int>(width), static_cast<unsigned int>(height) };
  vtkIdType increments[2] = { 0, 0 };
  pixels->Download2D(VTK_FLOAT, depths->GetPointer(0), size, 1, increments);
  return depths;
}

//------------------------------------------------------------------------------
void vtkIsosurfaceRayTraceSceneDepths::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Framebuffer->ReleaseGraphicsResources(window);
}

VTK_ABI_NAMESPACE_END
