// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Kernels_h
#define Kernels_h

// Plain structures and functions only: this header is compiled for several instruction sets, and
// nothing of it may leave code behind that runs on one of them alone.
#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Some of up to 128 rays.
struct RaySet
{
  std::uint64_t Words[2];
};

/// Rays that are traced side by side, in arrays.
struct RayGroup
{
  static constexpr int Capacity = 128;

  int Count;
  /// Those that meet the volume at all; the others have no defined values.
  RaySet Exists;
  // As in Ray. The direction is zero along an axis that the ray is parallel to.
  alignas(64) double Origin[3][Capacity];
  alignas(64) double Direction[3][Capacity];
  alignas(64) double Inverse[3][Capacity];
  alignas(64) double Begin[Capacity];
  alignas(64) double End[Capacity];
  alignas(64) double Base[Capacity];

  // For the axis the rays were last aligned with, and the two axes across.
  /// The coordinates across at plane 0 of the axis.
  alignas(64) double Offset[2][Capacity];
  /// How they change from plane to plane.
  alignas(64) double Slope[2][Capacity];
  /// Both slopes of a ray, side by side.
  alignas(64) float Slopes[Capacity][2];
  /// The part of the ray in the volume, along the axis, and a little more.
  alignas(64) double Low[Capacity];
  alignas(64) double High[Capacity];
};

/// A rectangle of at most 128 pixels, and what is needed to send rays through them; see Camera.
struct PixelBlock
{
  const double* IndexFromClip;
  /// Of the viewport, in pixels.
  double Width;
  double Height;
  int Column;
  int Row;
  int Columns;
  int Rows;
  /// The depth of the first pixel, and how far it is from row to row; null for the far plane.
  const float* Depth;
  std::ptrdiff_t DepthStride;
  /// Of the volume, in samples.
  const int* Dimensions;
};

/// What a set of rays sweeps: between the planes Low and High of an axis they are, across it,
/// between two lines. (The smallest of linear functions is concave and stays above the chord.)
struct Beam
{
  int Axis;
  /// Whether the rays go up the axis.
  bool IsUp;
  double Low;
  double High;
  /// At Low and at High, for the two axes across.
  double Least[2][2];
  double Most[2][2];
};

/// Where rays pass blocks of cells: for each passage the cells that the ray may pass there, of
/// those in the mask of the block.
struct Passages
{
  /// When there are so many, it is time to go through them...
  static constexpr int Batch = 128;
  /// ...for each ray of a group may add one before anybody asks.
  static constexpr int Capacity = 1024;
  /// In a slice of blocks a ray passes at most four by four of them (it goes at most 16 cells
  /// across). For so many rays, there is room without asking.
  static constexpr int RaysWithRoom = Capacity / 16;

  int Count;
  int Ray[Capacity];
  /// The first cell of the block, and where its first corner is kept.
  int First[Capacity][3];
  const char* Corner[Capacity];
  /// The slices across the axis that have cells left.
  unsigned int Slices[Capacity];
  std::uint64_t Cells[Capacity][8];
  /// Whether the ray hit something there.
  bool Hits[Capacity];
};

/// Pairs of a ray and a cell, to be solved.
struct Candidates
{
  static constexpr int Batch = 64;
  /// A passage adds all its cells in a slice at once, which are not many.
  static constexpr int Capacity = Batch + 64;

  int Count;
  int Passage[Capacity];
  int Ray[Capacity];
  int Cell[3][Capacity];
  /// Where the first corner of the cell is kept.
  const void* First[Capacity];
  alignas(64) double Corners[8][Capacity];
};

/// The isovalue and the power of two by which it and all values are multiplied.
struct ScaledIsovalue
{
  double Isovalue;
  double Scale;
};

/// The first hits of the rays of a group. Where a ray meets the surface is known first by the cell,
/// and refined to a place when nothing before it can come any more.
struct GroupHits
{
  /// The rays that hit.
  RaySet Found;
  /// Those whose place is known.
  RaySet Refined;

  int Cell[3][RayGroup::Capacity];
  /// The segment of the ray in the cell, as in CellSegment, and the cubic along it.
  alignas(64) double Begin[RayGroup::Capacity];
  alignas(64) double BeginAxis[RayGroup::Capacity];
  alignas(64) double End[RayGroup::Capacity];
  alignas(64) double Entry[3][RayGroup::Capacity];
  alignas(64) double Exit[3][RayGroup::Capacity];
  alignas(64) double Cubic[4][RayGroup::Capacity];

  /// The place, as in Hit.
  alignas(64) double T[RayGroup::Capacity];
  alignas(64) double Parametric[3][RayGroup::Capacity];
  RaySet Rising;
};

/// Candidates whose values are too large or too small for the arithmetic of the kernels.
struct ExtremeCandidates
{
  int Count;
  int Numbers[Candidates::Capacity];
};

/// Cells whose corners all have neighbours on both sides, and a place in each.
struct InnerCells
{
  int Count;
  /// The first corner of the cell, where the samples are.
  const void* First[RayGroup::Capacity];
  alignas(64) double Parametric[3][RayGroup::Capacity];
};

/// Hits to be shaded.
struct ShadedHits
{
  int Count;
  alignas(64) double Gradient[3][RayGroup::Capacity];
  /// Of the ray, in index space.
  alignas(64) double Direction[3][RayGroup::Capacity];
  /// That of the surface first, then that of the hit.
  alignas(64) double Color[3][RayGroup::Capacity];
  /// Those where the ray goes in, and so sees the outside of the surface.
  RaySet Rising;
  /// Those whose vectors are too short or too long for the arithmetic of the kernel.
  RaySet Extreme;
};

/// A light that is infinitely far; see Light.
struct DistantLight
{
  double Direction[3];
  double DiffuseColor[3];
  double SpecularColor[3];
};

/// What the shading of all hits of a frame shares; see Shader.
struct Phong
{
  const double* WorldFromIndex;
  const double* WorldFromGradient;
  bool TwoSidedLighting;
  double Ambient;
  double Diffuse;
  double Specular;
  int SpecularPower;
  int LightCount;
  const DistantLight* Lights;
};

/// The inner loops of ray tracing, compiled for one instruction set. All sets do the same
/// operations in the same order, and give the same bits.
struct Kernels
{
  /// Makes a ray for every pixel of a block, row by row, exactly as Camera::GetRay and ClipToVolume
  /// do.
  void (*MakeRays)(const PixelBlock& block, RayGroup& group);

  /// Looks at rays along an axis, and finds the beam they make. Returns false if they make none:
  /// if they do not all go the same way along it, or steeply away from it.
  bool (*Align)(RayGroup& group, const RaySet& rays, int axis, Beam& beam);

  /// Adds the passages of rays of a beam through a block with its first cell at first; slices are
  /// those of its mask across the axis. It may find cells that a ray comes near to; it never leaves
  /// out one that a ray passes.
  void (*FindPassages)(const RayGroup& group, const RaySet& rays, int axis, const int first[3],
    const std::uint64_t slices[8], Passages& passages);

  /// Loads the corners of candidates from where they are kept in rows, with so many values from
  /// neighbour to neighbour along each axis. One for every ScalarType.
  void (*LoadCorners[10])(const std::ptrdiff_t strides[3], Candidates& candidates);

  /// Finds the candidates with a root, keeps of every ray the one where it comes in first, and
  /// tells the passages.
  void (*FindHits)(const RayGroup& group, const Candidates& candidates,
    const ScaledIsovalue& isovalue, GroupHits& hits, Passages& passages,
    ExtremeCandidates& extremes);

  /// Finds the places of the hits that are not refined yet: the first root in the cell, exactly as
  /// Robust::ForEachRoot does.
  void (*Refine)(const RayGroup& group, GroupHits& hits);

  /// Interpolates the central differences at the corners of cells, which makes the gradients of
  /// NormalMode::CentralDifferences. Strides are those of Samples. One for every ScalarType.
  void (*InterpolateDifferences[10])(const InnerCells& cells, const std::ptrdiff_t strides[3],
    double (*gradients)[RayGroup::Capacity]);

  /// Shades hits, exactly as Shader::Shade does.
  void (*Shade)(const Phong& phong, ShadedHits& hits);

  /// Takes a row of samples into the smallest and the largest so far at each place; see ValueRange.
  /// One for every ScalarType.
  void (*IncludeRow[10])(const void* row, void* low, void* high, std::ptrdiff_t count);
};

extern const Kernels BaselineKernels;
extern const Kernels Avx2Kernels;
extern const Kernels Avx512Kernels;

}

#endif
