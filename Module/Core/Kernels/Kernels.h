// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Kernels_h
#define Kernels_h

#include "Kernels/BeamPieces.h"
#include "Kernels/CloudTile.h"
#include "Kernels/Frustum.h"
#include "Kernels/LatticePlanes.h"
#include "Kernels/ScatteredRays.h"
#include "Kernels/TricubicBlock.h"
#include "Rays/BoxGroup.h"
#include "Rays/RayPacket.h"
#include "Rays/RaysInBox.h"

#include <cstddef>
#include <cstdint>

// Plain structures only: they are compiled for several instruction sets, and must not leave code
// behind that runs on one of them alone.

namespace vtkIsosurfaceRayTracing
{

/// A rectangle of at most 128 pixels, and what is needed to make the rays through them; see Camera.
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
  /// The depth of the first pixel, and the stride from row to row; null for the far plane.
  const float* Depth;
  std::ptrdiff_t DepthStride;
  /// Of the volume, in samples.
  const int* Dimensions;
};

/// The passages of rays through blocks of 8^3 cells. A passage is one ray in one block: the segment
/// of the ray there, and those cells of the block's mask that it may pass.
struct Passages
{
  /// From this number on, passages are processed before further blocks are searched...
  static constexpr int Batch = 128;
  /// ...because each ray of a packet may add one passage between two checks.
  static constexpr int Capacity = 1024;

  /// The segment of a ray in a block, counted from the first cell across the axis and from the
  /// middle plane of the block along it; from the first plane where planes are uneven.
  struct Segment
  {
    /// The two coordinates across in that plane, and their changes along the axis.
    float Line[4];
    /// The lowest and the highest coordinate that the ray reaches, or some beyond the block.
    float Ends[2];
    int Ray;
    int Block;
  };

  int Count;
  alignas(64) Segment Segments[Capacity];
  /// The slices across the axis that have cells left.
  unsigned int Slices[Capacity];
  std::uint64_t Cells[Capacity][8];
  /// Whether the ray surely hits the surface there.
  bool Hits[Capacity];

  /// Whether any of the rays begins or ends in its block.
  bool HasEnds;
  /// Whether planes are uneven.
  bool AreUneven;

  /// The first cell of each block that is passed, and the address of its first corner.
  int BlockCount;
  int First[Capacity][3];
  const char* Corner[Capacity];
  /// Its planes along each axis, where they are uneven.
  const BlockPlanes* Planes[Capacity][3];
};

/// Cells of passages, to be classified.
struct PassedCells
{
  static constexpr int Batch = 128;
  /// A passage adds all its cells in a slice at once; behind the last there is room for a vector.
  static constexpr int Spare = 16;
  static constexpr int Capacity = Batch + 64 + Spare;

  int Count;
  /// The passage, plus 2^16 times the slice, plus 2^24 times the bit of the cell in the slice.
  unsigned int Codes[Capacity];
  /// The address of the first corner of the cell.
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
  /// The address of the first corner of the cell.
  const void* First[Capacity];
  alignas(64) double Corners[8][Capacity];
};

/// The segments of a ray in some cells; see CellSegment.
struct SegmentsInCells
{
  static constexpr int Capacity = 16;

  double Begin[Capacity];
  double End[Capacity];
  double BeginAxis[Capacity];
  double Entry[3][Capacity];
  double Exit[3][Capacity];
};

/// The isovalue and the power of two by which it and all values are multiplied.
struct ScaledIsovalue
{
  double Isovalue;
  double Scale;
};

/// The solutions of candidates: the first root of each in its cell, as in Hit. Sets have one bit
/// for each candidate.
struct Solutions
{
  static constexpr int Words = (Candidates::Capacity + 63) / 64;

  /// Those with a root.
  std::uint64_t Found[Words];
  /// Those with further roots, as Robust::ForEachRoot finds them; of boxes there are none.
  std::uint64_t Further[Words];
  /// Those whose values are too large or too small for the arithmetic of the kernels.
  std::uint64_t Extreme[Words];
  std::uint64_t Entering[Words];
  /// Where the ray enters the cell, as in CellSegment.
  alignas(64) double Begin[Candidates::Capacity];
  alignas(64) double BeginAxis[Candidates::Capacity];
  alignas(64) double T[Candidates::Capacity];
  /// The root as a fraction of the segment; not of boxes.
  alignas(64) double Fraction[Candidates::Capacity];
  alignas(64) double Parametric[3][Candidates::Capacity];
};

/// Cells whose corners all have neighbours on both sides, and a point in each.
struct InnerCells
{
  int Count;
  /// The address of the first corner of the cell.
  const void* First[RayPacket::Capacity];
  alignas(64) double Parametric[3][RayPacket::Capacity];
  /// Whether planes are uneven. Then, for each axis, the weights of the differences to the samples
  /// below and above, at the first corner and then at the next one along the axis.
  bool AreUneven;
  const double* Weights[3][RayPacket::Capacity];
};

/// What reaches each of some hits of a light: all, 1, where nothing is in its way.
struct alignas(64) LightAtHits
{
  double Parts[RayPacket::Capacity];
};

/// Hits to be shaded.
struct ShadedHits
{
  int Count;
  alignas(64) double Gradient[3][RayPacket::Capacity];
  /// Of the ray, in object space.
  alignas(64) double Direction[3][RayPacket::Capacity];
  /// That of the surface first, then that of the hit.
  alignas(64) double Color[3][RayPacket::Capacity];
  /// Those where the ray enters the surface, and so sees its outside.
  RaySet Entering;
  /// Those whose vectors are too short or too long for the arithmetic of the kernel.
  RaySet Extreme;
  /// Of the ambient light; null if it reaches all hits.
  const LightAtHits* Ambient;
  /// One for each light of the scene; null if all of them reach all hits.
  const LightAtHits* Lights;

  void Clear()
  {
    this->Count = 0;
    this->Entering = {};
    this->Ambient = nullptr;
    this->Lights = nullptr;
  }
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
  const double* WorldFromObject;
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
  /// The number of types of samples. Where there is a function for each, it has the number of its
  /// ScalarType.
  static constexpr int ScalarTypes = 10;

  /// Makes a ray for every pixel of a block, row by row, exactly as Camera::GetRay and ClipToVolume
  /// do.
  void (*MakeRays)(const PixelBlock& block, RayPacket& packet);

  /// The same for rays that are moved to a box, as MoveToBox does; the block has no dimensions.
  void (*MakeBoxedRays)(
    const PixelBlock& block, const double lower[3], const double upper[3], RayPacket& packet);

  /// Narrows the rays of a packet to a box, as CutToBox does for one.
  void (*CutPacketToBox)(
    const RayPacket& packet, const double lower[3], const double upper[3], RaysInBox& inside);

  /// Finds the boxes of a group that reach above all of some sides, as LineFrustum does; a bit for
  /// each.
  unsigned int (*FindMetBoxes)(const BoxGroup& boxes, const FrustumSide* sides, int count);

  /// Clips the rays of a packet to a volume, exactly as ClipToVolume does. Of those that exist
  /// origins, directions, begins and ends are given.
  void (*ClipRays)(const int dimensions[3], RayPacket& packet);

  /// The same for a box to which rays are moved, as MoveToBox does.
  void (*MoveRaysToBox)(const double lower[3], const double upper[3], RayPacket& packet);

  /// Moves the parts of rays that are in a box to the space of a volume, exactly as ClipToVolume
  /// does after the matrix, which is affine. The moved rays have the places of the rays.
  void (*MoveRays)(const RayPacket& rays, const RaysInBox& parts, const double* ownFromRays,
    const int dimensions[3], RayPacket& moved);

  /// Parametrizes rays by an axis, and finds their frustum. Returns false if they have none: if
  /// they do not all go the same way along the axis, or not steeply enough.
  bool (*Align)(
    const RayPacket& packet, const RaySet& rays, int axis, AlignedRays& aligned, Frustum& frustum);

  /// Adds the passages of rays of a frustum through a block whose first cell is at first; slices
  /// are those of its mask across the axis. It may find cells that a ray only comes near to; it
  /// never leaves out one that a ray passes. Here and below, planes are null where they stand at
  /// whole numbers.
  void (*FindPassages)(const AlignedRays& aligned, const RaySet& rays, int axis, const int first[3],
    const std::uint64_t slices[8], const LatticePlanes* planes, Passages& passages);

  /// Finds the members of a block that one ray of a frustum may pass, of those in its slices across
  /// the axis: slice by slice. Members have an edge of so many cells; the first cell of the block
  /// is at first. Returns which slices have any; of others members are undefined. For planes at
  /// whole numbers.
  unsigned int (*FindMembersOfRay)(const AlignedRays& aligned, int ray, int axis,
    const int first[3], int edge, const std::uint64_t slices[8], std::uint64_t members[8]);

  /// Adds the passage of one ray of a frustum through a block, as FindPassages does. For planes at
  /// whole numbers.
  void (*FindPassage)(const AlignedRays& aligned, int ray, int axis, const int first[3],
    const std::uint64_t slices[8], Passages& passages);

  /// Classifies cells in single precision: adds those in which a ray may hit the surface to the
  /// candidates, and marks the passages and the rays that surely hit it: hits[0] where values fall
  /// along the axis, hits[1] where they rise. Corners are kept in rows; strides are the distances
  /// between neighbours along each axis, in values. One for every ScalarType.
  void (*ClassifyCells[ScalarTypes])(const PassedCells& cells, int axis,
    const std::ptrdiff_t strides[3], const ScaledIsovalue& isovalue, Passages& passages,
    Candidates& candidates, RaySet hits[2]);

  /// Finds the lowest and the highest corners of cells, rounded to floats; there is room for
  /// PassedCells::Capacity of each. Strides are as for ClassifyCells. One for every ScalarType.
  void (*FindRanges[ScalarTypes])(
    const PassedCells& cells, const std::ptrdiff_t strides[3], float* lowest, float* highest);

  /// Bounds the largest values of rays in cells in single precision, or those of the negated
  /// values: none is above the bound, which is NaN or infinite where nothing is known. There is
  /// room for PassedCells::Capacity of them; strides are as for ClassifyCells. One for every
  /// ScalarType.
  void (*BoundCells[ScalarTypes])(const PassedCells& cells, int axis,
    const std::ptrdiff_t strides[3], bool areNegated, const Passages& passages, float* bounds);

  /// Loads the corners of candidates from rows; strides are as for ClassifyCells. One for every
  /// ScalarType.
  void (*LoadCorners[ScalarTypes])(const std::ptrdiff_t strides[3], Candidates& candidates);

  /// Finds the first root in the cell of each candidate, exactly as Robust::ForEachRoot does.
  void (*Solve)(const RayPacket& packet, const Candidates& candidates, const LatticePlanes* planes,
    const ScaledIsovalue& isovalue, Solutions& solutions);

  /// Finds the first face between boxes in the cell of each candidate that is a surface, exactly as
  /// FindFaceHits does. Begin and BeginAxis are those of its crossing.
  void (*SolveBoxes)(const RayPacket& packet, const Candidates& candidates,
    const LatticePlanes* planes, const ScaledIsovalue& isovalue, Solutions& solutions);

  /// Interpolates the central differences at the corners of cells, which makes the gradients of
  /// NormalMode::CentralDifferences. Strides are those of Samples. One for every ScalarType.
  void (*InterpolateDifferences[ScalarTypes])(const InnerCells& cells,
    const std::ptrdiff_t strides[3], double (*gradients)[RayPacket::Capacity]);

  /// Shades hits, exactly as Shader::Shade does.
  void (*Shade)(const Phong& phong, ShadedHits& hits);

  /// Turns opaque hits, with their final colours and points in object space, into pixels, exactly
  /// as fragments and the compositor do.
  void (*MakePixels)(const double* clipFromObject, const ShadedHits& hits,
    const double (*points)[RayPacket::Capacity], HitPixels& pixels);

  /// Includes a row of samples in the smallest and the largest so far at each index; see
  /// ValueRange. One for every ScalarType.
  void (*IncludeRow[ScalarTypes])(const void* row, void* low, void* high, std::ptrdiff_t count);

  /// Finds the frames of rays, as RayFrame does, and the rays of a beam, of which the places are
  /// given.
  void (*FrameRays)(
    const RayPacket& packet, const BeamNumbers& beam, FramedRays& framed, BeamRays& rays);

  /// Finds the frames of rays alone.
  void (*FindFrames)(const RayPacket& packet, FramedRays& framed);

  /// Ends rays of a beam where they end by what they have hit. Returns those that do not end before
  /// they surely should have: they are no longer in the beam.
  RaySet (*EndRays)(
    const RayPacket& packet, const BeamNumbers& beam, const double* ends, BeamRays& rays);

  /// Finds the children of a node that a beam may meet and one of the isovalues is in, and their
  /// bounds; a bit for each.
  unsigned int (*ProjectChildren)(const CellTreeNode& node, const BeamProjection& beam,
    const IsovalueSpan* isovalues, int count, LabelBounds& bounds);

  /// Finds the children of a node that a ray may meet and one of the isovalues is in; a bit for
  /// each.
  unsigned int (*FindChildrenOnRay)(const CellTreeNode& node, const ScatteredRays& rays, int ray,
    const IsovalueSpan* isovalues, int count);

  /// Finds the children of a node that a place may be in, and that reach its least value; a bit for
  /// each.
  unsigned int (*FindChildrenAround)(const CellTreeNode& node, const PlaceInBoxes& place);

  /// Finds the extents of cells, given the ids of their corners, 4 or 8 of each. One for every
  /// ScalarType of values.
  void (*FindExtents[ScalarTypes])(const PointArrays& arrays, const std::int64_t* ids, int corners,
    int count, CellExtents& extents);

  /// Finds the gradients in tetrahedra, given their corners: coordinates and value.
  void (*WeightGradients)(const double (*corners)[4][4], int count, WeightedGradients& gradients);

  /// Finds the gradients at the corners of hexahedra, given these as those of trilinear cells:
  /// coordinates and value.
  void (*FindCornerGradients)(
    const double (*corners)[PassedCellRecords::Corners][4], int count, CornerGradients& gradients);

  /// Interpolates vectors of three floats or doubles, of which there is one for every id, between
  /// the corners of cells. Stores the sums from a number on.
  void (*SumAtCorners)(const void* vectors, bool areFloats, const WeightedCorners& corners,
    int first, double (*sums)[RayPacket::Capacity]);

  /// Makes a set of pieces in tetrahedra, as many as its count, but not its cells. The corners are
  /// as in TetrahedronPairs...
  void (*PackPolygons)(const double (*corners)[4][4], PackedPieces& packed);

  /// ...or one of pieces in other cells, with corners as in PassedCellRecords.
  void (*PackBoxes)(const double (*corners)[PassedCellRecords::Corners][4], PackedPieces& packed);

  /// Finds how the rays of a packet, which go through a box, come to boxes and polygons; not where
  /// they end.
  void (*ScatterRays)(
    const RayPacket& packet, const double* lower, const double* upper, ScatteredRays& rays);

  /// Looks for the first of some sets, from one on, with pieces that a ray may meet. Returns its
  /// number, and a bit for each of the pieces; behind the last set if there is none.
  int (*FindPiecesOnRay)(const PackedPieces* sets, int firstSet, int numberOfSets,
    const ScatteredRays& rays, int ray, unsigned int& pieces);

  /// Takes a ray on its way through a tree to the next set with pieces that it may meet, but for
  /// one in the tetrahedron that it starts in. Returns the number of the set, and a bit for each of
  /// the pieces; -1 if there is none.
  int (*FindSetOnRay)(const PieceTreeLevels& tree, const ScatteredRays& rays, int ray,
    std::uint32_t startCell, WayThroughTree& way, unsigned int& pieces);

  /// Bounds the pieces of surfaces in cells as a beam sees them: in tetrahedra, or in trilinear
  /// cells.
  void (*BoundPackedPieces)(
    const PackedPieces& packed, const BeamNumbers& frame, BeamPieces& pieces);
  void (*BoundTrilinear)(
    const PassedCellRecords& records, const BeamNumbers& frame, BeamPieces& pieces);

  /// Finds which of some bounds rays may meet; a bit for each.
  unsigned int (*FindPassed)(const LabelBounds& bounds, unsigned int among, const BeamRays& rays);

  /// Adds the rays that may meet the pieces of a set, of which the first has the given number. Rays
  /// end behind those that they surely hit.
  void (*FindPairs)(const BeamPieces& pieces, int firstPiece, BeamRays& rays, BeamPairs& pairs);

  /// Finds the hits of rays in tetrahedra, exactly as TetrahedronHits does.
  void (*SolveTetrahedra)(const FramedRays& rays, TetrahedronPairs& pairs);

  /// Finds the hits of rays in trilinear cells, exactly as TrilinearSearch does for one.
  void (*SolveTrilinear)(const FramedRays& rays, TrilinearPairs& pairs);

  /// Finds the children of a node, or the cells of a block that is a child of it, whose boxes may
  /// reach above all of some sides; a bit for each. A side is a row whose product with (x, y, z, 1)
  /// is positive above it.
  unsigned int (*FindMetChildren)(const CellTreeNode& node, const double (*sides)[4], int count);
  unsigned int (*FindMetCells)(const CellTreeNode& node, int block, const BlockOfBoxes& boxes,
    const double (*sides)[4], int count);

  /// Makes the rays of a block of pixels, from a row of a tile on: each begins at the near plane.
  /// The block has no dimensions. With a matrix their lengths are found, and with a lighting the
  /// rays in the world; both may be null.
  void (*MakeCloudRays)(const PixelBlock& block, int firstRow, const double* worldFromObject,
    CloudTile& tile, CloudLighting* lighting);

  /// Projects tetrahedra to a tile, given their corners: coordinates and value. There may be up to
  /// ProjectedTetrahedra::Capacity.
  void (*ProjectTetrahedra)(const CloudTile& tile, const double (*corners)[4][4], int count,
    ProjectedTetrahedra& projected);

  /// Appends the segments of the rays of a tile in projected tetrahedra, from one on, until there
  /// is a batch. Returns the number of the first tetrahedron that is left. One for every number of
  /// components, from one on, and of gradients: none, one of two or four, or one of each component.
  int (*FindSegments[MaximumCloudComponents][MaximumCloudComponents + 1])(const CloudTile& tile,
    const ProjectedTetrahedra& projected, int first, CloudSegments& segments);

  /// Finds the light of segments of one component, with room for a vector behind it...
  void (*IntegrateSegments)(const CloudTile& tile, const TransferPieces& transfer,
    const CloudSegments& segments, SegmentLight* lights);
  /// ...or of several...
  void (*IntegrateMixture)(const CloudTile& tile, const MixedTransfers& mixed,
    const CloudSegments& segments, SegmentLight* lights);
  /// ...or of any number that are lit.
  void (*IntegrateLitMixture)(const CloudTile& tile, const MixedTransfers& mixed,
    const CloudLighting& lighting, const CloudSegments& segments, SegmentLight* lights);

  /// Draws the segments of some pixels of a row that begin before a depth, front to back; a bit for
  /// each column. Returns those of them for which it does nothing: where a segment begins at the
  /// same depth as another, but for its last digits.
  unsigned int (*DrawSegments)(
    const SegmentLists& lists, int row, double before, unsigned int columns, TileLight& light);
  /// Removes the segments of a row that begin before a depth, and all of those pixels that are not
  /// among some; a bit for each column.
  void (*KeepSegments)(const SegmentLists& lists, int row, double from, unsigned int columns);

  /// Finds the segments of a ray of a packet in cells, exactly as SegmentInCell does. There is room
  /// for Capacity cells, and all have numbers. Returns those of the first ones that it passes, a
  /// bit for each.
  unsigned int (*FindSegmentsInCells)(const RayPacket& packet, int ray, const LatticePlanes* planes,
    const int (*cells)[SegmentsInCells::Capacity], int count, SegmentsInCells& segments);

  /// Makes the coefficients of a tricubic cell, less an isovalue, of the 4^3 samples around it (see
  /// TricubicCell), with the weights of an edge along each axis (see CubicEdge). Returns whether
  /// they are on both sides.
  bool (*InterpolateSamples)(
    const double* const weights[3], const ScaledIsovalue& isovalue, double cell[64]);

  /// Bounds the coefficients of the cells of a block, without an isovalue: the same as those of
  /// InterpolateSamples, up to rounding.
  void (*BoundTricubic)(const TricubicBlock& block, TricubicRanges& ranges);

  /// Finds the interpolant of a tricubic cell along the straight line from p to q, as a polynomial
  /// of the fraction of the way: that along the diagonal of the box [p, q]. There are convex
  /// combinations only, so that coefficients of one sign make a polynomial of that sign, rounded as
  /// it is: then, it is not found, and this returns false.
  bool (*RestrictCell)(
    const double cell[64], const double p[3], const double q[3], double nonic[10]);

  /// Finds the gradient of the interpolant at a point of a tricubic cell, per cell edge along each
  /// axis.
  void (*FindCellGradient)(const double cell[64], const double p[3], double gradient[3]);
};

extern const Kernels BaselineKernels;
extern const Kernels Avx2Kernels;
extern const Kernels Avx512Kernels;

}

#endif
