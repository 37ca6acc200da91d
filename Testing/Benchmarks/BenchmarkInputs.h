// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BenchmarkInputs_h
#define BenchmarkInputs_h

#include "ExactCrossings.h"
#include "Views.h"

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

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
  /// The same samples for VTK, in the type of the file.
  vtkSmartPointer<vtkImageData> Image;
};

/// Smooth fields: M. Marschner and R. Lobb's signal, and the gyroid, on n^3 samples.
Input MakeMarschnerLobb(int n);
Input MakeGyroid(int n);
/// Hard ones: corners drawn at random; values next to the isovalue, so that rays graze; integers on
/// plateaus, with the isovalue on one of them.
Input MakeRandom(int n);
Input MakeNearTangent(int n);
Input MakePlateaus(int n);
/// The volume in a file, as ReadImage reads it. Throws std::runtime_error.
Input ReadInput(const std::string& fileName, double isovalue, double maxMemory);

/// The rays through the centres of pixels of square pictures. All methods trace the same.
struct Rays
{
  std::vector<View> Views;
  /// The edge of the pictures, in pixels; one pixel in so many is taken along either side.
  int Size;
  int Stride;
  /// View by view, in rows from the bottom. Directions have length one: t is in cells.
  std::vector<Oracle::Line> Lines;

  /// Visits the pixels that are taken of a picture, in the order of their lines.
  template <typename Visit>
  void ForEachPixel(const Visit& visit) const
  {
    for (int y = this->Stride / 2; y < this->Size; y += this->Stride)
    {
      for (int x = this->Stride / 2; x < this->Size; x += this->Stride)
      {
        visit(x, y);
      }
    }
  }
};

/// About as many rays as requested, of pictures from eight viewpoints around the volume.
Rays MakeRays(const Input& input, int count, int size);
/// All rays of a picture from one viewpoint.
Rays MakePicture(const Input& input, int size);

}

#endif
