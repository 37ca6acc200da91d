// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef FastSolver_h
#define FastSolver_h

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// The algorithm of RobustSolver.h in single precision, for several cells at once: one in each lane
/// of a vector register, without a branch that depends on a lane.
///
/// Its error band: a root is found, and none is invented, if along the segment no extremum of the
/// interpolant comes nearer to the isovalue than Band times the largest difference between a corner
/// and the isovalue. Inside the band a ray that grazes the surface may be judged either way. Signs
/// on the faces of cells are shared by both cells, as in double: there are no cracks.
namespace Fast
{

/// As many as the registers that every machine has (SSE2, NEON) hold: compilers take wider vectors
/// to pieces there, at ten times the cost.
constexpr int Lanes = 4;
/// Eight roundings of 2^-24.
constexpr double Band = 8.0 / 16777216.0;
/// The lowest and the highest size of differences that keep squares in the range of a float.
constexpr double Smallest = 1e-15;
constexpr double Largest = 1e15;

/// A cell and a segment in each lane.
struct Batch
{
  /// The values of the corners with the isovalue taken off.
  alignas(16) float Difference[8][Lanes];
  alignas(16) float Entry[3][Lanes];
  alignas(16) float Exit[3][Lanes];
};

/// Up to three roots in each lane, in order; one for every monotone piece of the segment.
struct Roots
{
  /// As fractions of the segment.
  alignas(16) float U[3][Lanes];
  /// -1 where there is a root, else 0.
  alignas(16) std::int32_t Found[3][Lanes];
  /// -1 where the ray goes in, else 0.
  alignas(16) std::int32_t Entering[3][Lanes];
};

/// Solves all lanes. With firstOnly, at most one root is found in a lane: the first.
void Solve(const Batch& batch, bool firstOnly, Roots& roots);

}
}

#endif
