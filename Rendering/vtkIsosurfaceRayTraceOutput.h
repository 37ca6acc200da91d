// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Writes hits and pictures to data sets of VTK.

#ifndef vtkIsosurfaceRayTraceOutput_h
#define vtkIsosurfaceRayTraceOutput_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Rays/RayHits.h"

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTracePicture;
class vtkPolyData;
class vtkTable;
struct vtkIsosurfaceRayTraceRequest;

namespace vtkIsosurfaceRayTraceOutput
{

/// The output of vtkIsosurfaceRayTraceMapper::CastRays.
void WriteHits(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracing::RayHits& hits, vtkPolyData* output);

/// The output of vtkIsosurfaceRayTraceMapper::RenderToImage. The picture must have kept its hits.
void WriteImage(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracePicture& picture, int width, int height, vtkImageData* output);

/// The output of vtkCellProjectionMapper::RenderOwnTiles: the arrays Colors and Depth alone.
void WriteColors(
  const vtkIsosurfaceRayTracePicture& picture, int width, int height, vtkImageData* output);

/// The output of vtkIsosurfaceRayTraceMapper::RenderToFragments. The picture must have kept its
/// fragments, and of a projection its hits.
void WriteFragments(const vtkIsosurfaceRayTraceRequest& request,
  const vtkIsosurfaceRayTracePicture& picture, int width, vtkTable* output);

}

VTK_ABI_NAMESPACE_END

#endif
