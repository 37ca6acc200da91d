// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TraceRequest_h
#define TraceRequest_h

#include "Image/Samples/UnevenPlanes.h"
#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"
#include "Rays/Visibility.h"

#include <cstddef>
#include <limits>
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

/// What to look for along rays, and how.
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
  Interpolant Field = Interpolant::Trilinear;
  /// For Interpolant::Trilinear.
  RootSolver Solver = RootSolver::Robust;
  /// For RootSolver::Marmitt.
  int Interpolations = 3;
  /// If there is one, no surfaces are traced: a ray has one hit, the first of the points where the
  /// interpolant has its extreme value along all that is visible of the ray.
  std::optional<Extremum> Projection;
  /// What of the field is visible at all.
  Visibility Visible;
  /// Where the samples stand; null if at whole numbers. Rays must be made with the same.
  const UnevenPlanes* Planes = nullptr;
  /// What packets of rays are traced with, where rays can be traced in packets (see
  /// PacketTracer.h). With null, each ray is traced by itself, cell by cell; the hits are the same.
  const Kernels* BeamKernels = &GetBestKernels();
  /// How much memory bricks and masks of cells may take, in bytes. Where it is not enough, those
  /// that were not used lately make room, and rays do without: the hits are the same.
  std::size_t MaximumMemory = std::numeric_limits<std::size_t>::max();

  bool IsNothing() const { return this->Surfaces.empty() && !this->Projection; }
};

}

#endif
