// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The settings of a mapper that traces isosurfaces, whatever kind of data it traces.

#ifndef vtkIsosurfaceRayTraceSettings_h
#define vtkIsosurfaceRayTraceSettings_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkVolumeMapper.h"               // for blend modes

#include "Rays/TraceRequest.h"

#include <cstddef>  // for std::size_t
#include <limits>   // for std::numeric_limits
#include <optional> // for std::optional

VTK_ABI_NAMESPACE_BEGIN

/// Named as in vtkIsosurfaceRayTraceMapper, which documents them. The mapper fills it in every
/// call.
struct vtkIsosurfaceRayTraceSettings
{
  /// That of vtkVolumeMapper.
  int BlendMode = vtkVolumeMapper::ISOSURFACE_BLEND;
  /// What the blend mode stands for. None: surfaces are drawn.
  std::optional<vtkIsosurfaceRayTracing::Extremum> Projection;
  /// Whether a cloud is drawn, and the isosurfaces in it.
  bool HasCloud = false;
  bool HasSurfaces = true;
  /// Whether the largest values of the cloud are drawn.
  bool IsMaximum = false;
  vtkIsosurfaceRayTracing::Interpolant InterpolationMode =
    vtkIsosurfaceRayTracing::Interpolant::Trilinear;
  vtkIsosurfaceRayTracing::RootSolver RootSolver = vtkIsosurfaceRayTracing::RootSolver::Robust;
  int NumberOfInterpolations = 3;
  vtkIsosurfaceRayTracing::NormalMode NormalMode =
    vtkIsosurfaceRayTracing::NormalMode::CentralDifferences;
  bool CapClippingPlanes = false;
  bool Shadows = false;
  /// 0: no ambient occlusion.
  int NumberOfAmbientOcclusionRays = 0;
  double AmbientOcclusionRadius = std::numeric_limits<double>::infinity();

  /// In bytes.
  std::size_t MaximumMemory = std::numeric_limits<std::size_t>::max();
  int TileWidth = 16;
  int TileHeight = 8;
  int NumberOfThreads = 1;

  bool LevelOfDetail = false;
  bool AutoAdjustSampleDistances = true;
  float ImageSampleDistance = 1.0F;
  float MinimumImageSampleDistance = 1.0F;
  float MaximumImageSampleDistance = 10.0F;
  bool ProgressiveAccumulation = false;
  int MaximumNumberOfAccumulatedFrames = 16;
};

VTK_ABI_NAMESPACE_END

#endif
