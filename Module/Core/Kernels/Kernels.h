// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Kernels_h
#define Kernels_h

#include "Kernels/Frustum.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <cstdint>

// Plain structures only: they are compiled for several instruction sets, and must not leave code
// behind that runs on one of them alone.

namespace vtkIsosurfaceRayTracing
{

/// A rectangle of at most 128 pixels, and what is needed to send rays through them; see Camera.
struct PixelBlock
{
  const double* ObjectFromClip;
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

/// Where rays pass blocks of cells: for each passage the cells that the ray may pass there, of
/// those in the mask of the block.
struct Passages
{
  /// When there are so many, it is time to go through them...
  static constexpr int Batch = 128;
  /// ...for each ray of a packet may add one before anybody asks.
  static constexpr int Capacity = 1024;
  /// In a slice of blocks a ray passes at most four by four of them (it goes at most 16 cells
  /// across). For so many rays, and one passage that turns out to be none, there is room without
  /// asking.
  static constexpr int RaysWithRoom = Capacity / 16 - 1;

  /// The way of a ray through a block, counted from the first cell across the axis and from the
  /// middle plane of the block along it.
  struct Way
  {
    /// The two places across in the middle plane, and how they change from plane to plane.
    float Line[4];
    /// The lowest and the highest plane that the ray comes to, or planes beyond the block.
    float Ends[2];
    int Ray;
    int Block;
  };

  int Count;
  alignas(64) Way Ways[Capacity];
  /// The slices across the axis that have cells left.
  unsigned int Slices[Capacity];
  std::uint64_t Cells[Capacity][8];
  /// Whether the ray surely hits something there.
  bool Hits[Capacity];

  /// Whether any of the rays begins or ends in its block.
  bool HasEnds;

  /// The first cell of each block that is passed, and where its first corner is kept.
  int BlockCount;
  int First[Capacity][3];
  const char* Corner[Capacity];
};

/// Cells of passages, to be looked at.
struct PassedCells
{
  static constexpr int Batch = 128;
  /// A passage adds all its cells in a slice at once; behind the last there is room for a vector.
  static constexpr int Spare = 16;
  static constexpr int Capacity = Batch + 64 + Spare;

  int Count;
  /// The passage, 2^16 times the slice, and 2^24 times the bit of the cell in it.
  unsigned int Codes[Capacity];
  /// Where the first corner of the cell is kept.
  const void* First[Capacity];
};

/// Pairs of a ray and a cell, to be solved.
struct Candidates
{
  static constexpr int Batch = 128;
  /// All of some passed cells may be added at once; behind the last there is room for two vectors.
  static constexpr int Capacity = Batch + PassedCells::Capacity + 16;

  int Count;
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

/// What candidates turn out to be: the first root of each in its cell, as in Hit. One bit for each
/// candidate in the sets.
struct Solutions
{
  static constexpr int Words = (Candidates::Capacity + 63) / 64;

  /// Those with a root.
  std::uint64_t Found[Words];
  /// Those whose values are too large or too small for the arithmetic of the kernels.
  std::uint64_t Extreme[Words];
  std::uint64_t Entering[Words];
  /// Where the ray comes into the cell, as in CellSegment.
  alignas(64) double Begin[Candidates::Capacity];
  alignas(64) double BeginAxis[Candidates::Capacity];
  alignas(64) double T[Candidates::Capacity];
  alignas(64) double Parametric[3][Candidates::Capacity];
};

/// Cells whose corners all have neighbours on both sides, and a place in each.
struct InnerCells
{
  int Count;
  /// The first corner of the cell, where the samples are.
  const void* First[RayPacket::Capacity];
  alignas(64) double Parametric[3][RayPacket::Capacity];
};

/// Hits to be shaded.
struct ShadedHits
{
  int Count;
  alignas(64) double Gradient[3][RayPacket::Capacity];
  /// Of the ray, in index space.
  alignas(64) double Direction[3][RayPacket::Capacity];
  /// That of the surface first, then that of the hit.
  alignas(64) double Color[3][RayPacket::Capacity];
  /// Those where the ray goes in, and so sees the outside of the surface.
  RaySet Entering;
  /// Those whose vectors are too short or too long for the arithmetic of the kernel.
  RaySet Extreme;
};

/// What opaque hits look like in the picture.
struct HitPixels
{
  /// Red, green, blue and opacity, the first one lowest.
  std::uint32_t Colors[RayPacket::Capacity];
  /// As in the depth buffer.
  float Depths[RayPacket::Capacity];
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
  void (*MakeRays)(const PixelBlock& block, RayPacket& packet);

  /// Looks at rays along an axis, and finds the frustum they make. Returns false if they make none:
  /// if they do not all go the same way along it, or steeply away from it.
  bool (*Align)(
    const RayPacket& packet, const RaySet& rays, int axis, AlignedRays& aligned, Frustum& frustum);

  /// Adds the passages of rays of a frustum through a block with its first cell at first; slices
  /// are those of its mask across the axis. It may find cells that a ray comes near to; it never
  /// leaves out one that a ray passes.
  void (*FindPassages)(const AlignedRays& aligned, const RaySet& rays, int axis, const int first[3],
    const std::uint64_t slices[8], Passages& passages);

  /// Adds those of some cells to the candidates in which a ray may hit the surface, as single
  /// precision can tell; and marks the passages and the rays that surely hit it: hits[0] where
  /// values fall along the axis, hits[1] where they rise. Corners are kept in rows, with so many
  /// values from neighbour to neighbour along each axis. One for every ScalarType.
  void (*ClassifyCells[10])(const PassedCells& cells, int axis, const std::ptrdiff_t strides[3],
    const ScaledIsovalue& isovalue, Passages& passages, Candidates& candidates, RaySet hits[2]);

  /// Loads the corners of candidates from where they are kept in rows, with so many values from
  /// neighbour to neighbour along each axis. One for every ScalarType.
  void (*LoadCorners[10])(const std::ptrdiff_t strides[3], Candidates& candidates);

  /// Finds the first root in the cell of each candidate, exactly as Robust::ForEachRoot does.
  void (*Solve)(const RayPacket& packet, const Candidates& candidates,
    const ScaledIsovalue& isovalue, Solutions& solutions);

  /// Interpolates the central differences at the corners of cells, which makes the gradients of
  /// NormalMode::CentralDifferences. Strides are those of Samples. One for every ScalarType.
  void (*InterpolateDifferences[10])(const InnerCells& cells, const std::ptrdiff_t strides[3],
    double (*gradients)[RayPacket::Capacity]);

  /// Shades hits, exactly as Shader::Shade does.
  void (*Shade)(const Phong& phong, ShadedHits& hits);

  /// Turns opaque hits with their last colours, and places in index space, to pixels, exactly as
  /// RenderTiles does.
  void (*MakePixels)(const double* clipFromIndex, const ShadedHits& hits,
    const double (*points)[RayPacket::Capacity], HitPixels& pixels);

  /// Takes a row of samples into the smallest and the largest so far at each place; see ValueRange.
  /// One for every ScalarType.
  void (*IncludeRow[10])(const void* row, void* low, void* high, std::ptrdiff_t count);
};

extern const Kernels BaselineKernels;
extern const Kernels Avx2Kernels;
extern const Kernels Avx512Kernels;

}

#endif
