// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// From how many pictures of an isovalue on it pays to extract triangles.

#ifndef Crossover_h
#define Crossover_h

#include <string>
#include <vector>

class vtkCamera;
class vtkImageData;

namespace Compare
{

/// What a way to an isosurface costs, in seconds: the first picture of an isovalue, and each
/// further one.
struct Costs
{
  double First;
  double Next;

  double GetTotal(double pictures) const { return this->First + (pictures - 1.0) * this->Next; }
};

/// Who needs less time for a number of pictures of an isovalue.
struct Verdict
{
  enum Kinds
  {
    /// Rays up to so many pictures, triangles beyond.
    RaysUpTo,
    /// The other way round.
    TrianglesUpTo,
    AlwaysRays,
    AlwaysTriangles
  };
  Kinds Kind;
  /// Where both need the same, not rounded; NaN for Always.
  double Pictures;
};

Verdict Judge(const Costs& triangles, const Costs& rays);

/// "rays up to 12 pictures, triangles beyond"
std::string Describe(const Verdict& verdict);

/// The times of a volume of so many samples.
struct Crossover
{
  int Dimensions[3];
  double Samples;
  Costs Triangles;
  Costs Rays;

  /// As the triangles would be if drawing them took no time.
  Costs GetFreeTriangles() const { return { this->Triangles.First - this->Triangles.Next, 0.0 }; }
};

/// Measures vtkFlyingEdges3D against vtkIsosurfaceRayTraceMapper for a volume as it is, and shrunk
/// to an eighth and enlarged to twice its size along each axis by steps of the root of 2, as far as
/// that leaves 8 samples along each axis and not more than 1e8 in all. From the smallest on. Tells
/// stderr where it is. Needs a display.
std::vector<Crossover> MeasureCrossover(
  vtkImageData* volume, double isovalue, int repeats, vtkCamera* camera);

}

#endif
