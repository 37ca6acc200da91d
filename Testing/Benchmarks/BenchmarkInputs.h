// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BenchmarkInputs_h
#define BenchmarkInputs_h

#include "Oracle.h"

#include <string>
#include <vector>

namespace Benchmark
{

/// A volume to measure on, in index space: lengths are in cells.
struct Input
{
  std::string Name;
  Oracle::Field Field;
  double Isovalue;
};

/// Smooth fields: M. Marschner and R. Lobb's signal, and the gyroid, on n^3 samples.
Input MakeMarschnerLobb(int n);
Input MakeGyroid(int n);
/// Hard ones: corners drawn at random; values next to the isovalue, so that rays graze; integers on
/// plateaus, with the isovalue on one of them.
Input MakeRandom(int n);
Input MakeNearTangent(int n);
Input MakePlateaus(int n);
/// The volume in a file, by the reader of VTK that its name asks for. Throws std::runtime_error.
Input ReadInput(const std::string& fileName, double isovalue);

/// Lines through a volume from eight places around it, each a square of parallel lines; about as
/// many as asked for. Directions have length one.
std::vector<Oracle::Line> MakeLines(const Input& input, int count);
/// A square of parallel lines from one place: the pixels of a picture, in rows from the bottom.
std::vector<Oracle::Line> MakePicture(const Input& input, int pixels);

}

#endif
