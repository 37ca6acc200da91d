// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The number of pictures of an isovalue from which on extracting triangles takes less time.

#ifndef Crossover_h
#define Crossover_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <functional>
#include <string>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkCamera;
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Compare
{

/// The cost of a method in seconds: of the first picture of an isovalue, and of each further one.
struct Costs
{
  double First;
  double Next;

  double GetTotal(double pictures) const { return this->First + (pictures - 1.0) * this->Next; }
};

/// Whether rays or triangles need less time for a number of pictures of an isovalue.
struct Verdict
{
  enum Kinds
  {
    /// Rays up to this number of pictures, triangles beyond.
    RaysUpTo,
    /// The reverse.
    TrianglesUpTo,
    AlwaysRays,
    AlwaysTriangles
  };
  Kinds Kind;
  /// The number for which both need the same time, not rounded; NaN for Always.
  double Pictures;
};

Verdict Judge(const Costs& triangles, const Costs& rays);

/// "rays up to 12 pictures, triangles beyond"
std::string Describe(const Verdict& verdict);

/// The costs for a volume of a given size.
struct Crossover
{
  int Dimensions[3];
  double Samples;
  Costs Triangles;
  Costs Rays;

  /// The cost of triangles if drawing them took no time.
  Costs GetFreeTriangles() const { return { this->Triangles.First - this->Triangles.Next, 0.0 }; }
};

/// Measures vtkFlyingEdges3D and vtkIsosurfaceRayTraceMapper for a volume resampled to an eighth up
/// to twice its size along each axis, by factors of the square root of 2, the smallest first. Sizes
/// with fewer than 8 samples along an axis or more than 1e8 in all are left out. Needs a display.
/// Calls report(part) with the part that is done.
std::vector<Crossover> MeasureCrossover(vtkImageData* volume, double isovalue, int repeats,
  vtkCamera* camera, const std::function<void(double)>& report);

/// The number of samples of all the sizes.
double CountCrossoverSamples(vtkImageData* volume);

}

#endif
