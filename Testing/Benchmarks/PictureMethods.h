// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PictureMethods_h
#define PictureMethods_h

#include "BenchmarkInputs.h"
#include "IsosurfaceRenderer.h"

#include <memory>
#include <string>
#include <vector>

namespace Benchmark
{

/// A way to draw whole pictures, ready to Draw; Family and Parameter are as in RayMethod.
struct PictureMethod
{
  std::string Family;
  std::string Parameter;
  std::unique_ptr<IsosurfaceRenderer> Renderer;
};

/// For pictures as the rays are of: our mapper with each of its solvers, and those baselines that
/// are available: polygons, VTK's mappers of volumes at several sample distances. The input must
/// outlive them.
std::vector<PictureMethod> MakePictureMethods(const Input& input, const Rays& rays);

/// The times of the pictures of all views.
std::vector<FrameTimes> DrawAll(const PictureMethod& method, const Rays& rays);

/// The distances of the renderer along each of the rays.
std::vector<double> GetDistances(const PictureMethod& method, const Rays& rays);

}

#endif
