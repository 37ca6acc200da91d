// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TraceRequest_h
#define TraceRequest_h

#include "Rays/Visibility.h"

#include <optional>
#include <utility>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// An isosurface to trace. Opacity is in (0, 1]; what is not visible at all is not traced.
struct Isosurface
{
  double Isovalue;
  double Opacity;
};

/// Which value along a ray is looked for.
enum class Extremum
{
  Largest,
  Smallest
};

/// What is between the samples.
enum class Interpolant
{
  Trilinear,
  /// The value of the nearest sample; see BoxFaces.h.
  Nearest,
  /// See TricubicCell.h.
  Tricubic
};

/// How the point where a ray meets a surface of the trilinear interpolant in a cell is found.
enum class RootSolver
{
  Robust,
  Analytic,
  Marmitt,
  Linear
};

enum class NormalMode
{
  InterpolantGradient,
  CentralDifferences
};

/// What to look for along rays. How that is done is said by Execution.
struct TraceRequest
{
  TraceRequest() = default;
  TraceRequest(std::vector<Isosurface> surfaces, RootSolver solver = RootSolver::Robust,
    int interpolations = 3)
    : Surfaces(std::move(surfaces))
    , Solver(solver)
    , Interpolations(interpolations)
  {
  }

  /// In ascending order of their isovalues.
  std::vector<Isosurface> Surfaces;
  /// What the surfaces are of. A projection is always of the trilinear one.
  Interpolant Interpolation = Interpolant::Trilinear;
  /// For Interpolant::Trilinear.
  RootSolver Solver = RootSolver::Robust;
  /// For RootSolver::Marmitt.
  int Interpolations = 3;
  /// If there is one, no surfaces are traced: a ray has one hit, the first of the points where the
  /// interpolant has its extreme value along all that is visible of the ray.
  std::optional<Extremum> Projection;
  /// What of the field is visible at all.
  Visibility Visible;
  /// The gradients that hits are shaded by.
  NormalMode Normals = NormalMode::CentralDifferences;

  bool IsNothing() const { return this->Surfaces.empty() && !this->Projection; }
};

}

#endif
