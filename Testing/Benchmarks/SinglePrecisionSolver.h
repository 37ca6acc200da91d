// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SinglePrecisionSolver_h
#define SinglePrecisionSolver_h

#include "Image/Cells/CellSegment.h"

#include <array>

namespace Benchmark
{

/// The algorithm of RobustSolver.h in single precision: what double precision costs. Solves several
/// cells at once, one in each element of a SIMD vector, without a branch that depends on one of
/// them.
namespace SinglePrecision
{

/// As many as the vectors that every machine has (SSE2, NEON) hold: compilers split wider ones
/// there, at ten times the cost.
constexpr std::size_t BatchSize = 4;

/// Cells and the segments of rays in them, element by element.
struct Batch
{
  /// The values of the corners minus the isovalue.
  alignas(16) float Difference[8][BatchSize];
  alignas(16) float Entry[3][BatchSize];
  alignas(16) float Exit[3][BatchSize];

  void Set(std::size_t i, const vtkIsosurfaceRayTracing::CellCorners& difference,
    const vtkIsosurfaceRayTracing::CellSegment& segment);
};

/// The first root of each cell, as a fraction of its segment; NaN where there is none.
std::array<float, BatchSize> FindFirstRoots(const Batch& batch);

}
}

#endif
