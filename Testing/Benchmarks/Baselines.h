// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Baselines_h
#define Baselines_h

#include "IsosurfaceRenderer.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// flying-edges, marching-cubes, polygons, embree, fixed-point, gpu.
std::vector<std::string> GetBaselineNames();

/// Why there is no such baseline here, and how to get it; empty if there is.
std::string GetAbsence(const std::string& baseline);

/// The baseline of a name, which must be available. Pictures are size x size pixels, taken with at
/// most so many threads. Those that sample do so at this distance, in the world; where it is 0,
/// fixed-point does once for every cell and gpu as it finds best.
std::unique_ptr<IsosurfaceRenderer> NewBaseline(
  const std::string& name, vtkImageData* image, int size, int threads, double sampleDistance = 0.0);

}

#endif
