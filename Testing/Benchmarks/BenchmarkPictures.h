// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BenchmarkPictures_h
#define BenchmarkPictures_h

#include "BenchmarkInputs.h"
#include "Contestant.h"

#include <memory>
#include <string>
#include <vector>

namespace Benchmark
{

/// One who draws whole pictures, ready to Draw; Family and Knob are as in Method.
struct Painter
{
  std::string Family;
  std::string Knob;
  std::unique_ptr<Contestant> Who;
};

/// For pictures as the rays are of: our mapper with each of its solvers, and those rivals that are
/// not absent: polygons, VTK's mappers of volumes at several sample distances. The input must
/// outlive them.
std::vector<Painter> MakePainters(const Input& input, const Rays& rays);

/// The times of the pictures of all views.
std::vector<FrameTimes> DrawAll(const Painter& painter, const Rays& rays);

/// How far along each of the rays the painter has the surface, as GetDistances tells it.
std::vector<double> Look(const Painter& painter, const Rays& rays);

}

#endif
