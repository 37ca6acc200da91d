// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TricubicBlock_h
#define TricubicBlock_h

namespace vtkIsosurfaceRayTracing
{

/// A block of 8^3 tricubic cells: the samples around them, and what makes coefficients of them.
struct TricubicBlock
{
  static constexpr int Edge = 8;
  static constexpr int SamplesPerEdge = Edge + 3;
  /// Rows have room for vectors.
  static constexpr int Row = 16;

  alignas(64) double Samples[SamplesPerEdge][SamplesPerEdge][Row] = {};
  /// For each axis the weights of a CubicEdge, one after the other, for each cell.
  alignas(64) double Weights[3][4][Edge] = {};
};

/// The smallest and the largest coefficient of each cell of a block, x fastest, up to rounding.
struct TricubicRanges
{
  alignas(64) double Low[TricubicBlock::Edge][TricubicBlock::Edge][TricubicBlock::Edge];
  alignas(64) double High[TricubicBlock::Edge][TricubicBlock::Edge][TricubicBlock::Edge];
};

}

#endif
