// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The render passes that draw a prop, and what they make of its shaders.

#ifndef vtkIsosurfaceRayTracePasses_h
#define vtkIsosurfaceRayTracePasses_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkNew.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkProp.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

namespace vtkIsosurfaceRayTracePasses
{

/// Those of a kind that draw a prop now.
template <typename Pass = vtkOpenGLRenderPass>
std::vector<Pass*> Find(vtkProp* prop)
{
  std::vector<Pass*> passes;
  vtkInformation* keys = prop->GetPropertyKeys();
  const int count = keys ? vtkOpenGLRenderPass::RenderPasses()->Length(keys) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (auto* pass = Pass::SafeDownCast(vtkOpenGLRenderPass::RenderPasses()->Get(keys, i)))
    {
      passes.push_back(pass);
    }
  }
  return passes;
}

/// The fragment shader that passes make from that of a prop. They know no others that have geometry
/// than the shaders of polygons.
inline std::string MakeShader(
  const std::vector<vtkOpenGLRenderPass*>& passes, vtkProp* prop, std::string fragmentShader)
{
  std::string vertexShader;
  std::string geometryShader;
  const vtkNew<vtkOpenGLPolyDataMapper> mapper;
  for (vtkOpenGLRenderPass* pass : passes)
  {
    pass->PreReplaceShaderValues(vertexShader, geometryShader, fragmentShader, mapper, prop);
    pass->PostReplaceShaderValues(vertexShader, geometryShader, fragmentShader, mapper, prop);
  }
  return fragmentShader;
}

}

VTK_ABI_NAMESPACE_END

#endif
