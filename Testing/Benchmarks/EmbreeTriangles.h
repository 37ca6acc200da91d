// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef EmbreeTriangles_h
#define EmbreeTriangles_h

#include "Views.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <memory>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// Triangles in Embree, traced in coherent packets of sixteen rays.
class EmbreeTriangles
{
public:
  /// Builds the hierarchy, on so many threads.
  EmbreeTriangles(vtkPolyData* triangles, int threads);
  ~EmbreeTriangles();

  /// Finds the first hits of the rays of a part of a picture, and returns how many hit. The rays
  /// are made on the way, as a tracer makes them.
  int Trace(const PictureRays& rays, const PixelRectangle& pixels, int threads);

  /// The depths of the first hits of a part of a picture, row by row from the bottom: along the
  /// view, and infinite where there is none.
  std::vector<float> FindDepths(const PictureRays& rays, const PixelRectangle& pixels);

  static std::string GetVersion();

private:
  int Trace(const PictureRays& rays, const PixelRectangle& pixels, int threads, float* depths);

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
