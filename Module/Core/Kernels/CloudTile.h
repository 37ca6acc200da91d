// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CloudTile_h
#define CloudTile_h

#include "Math/Compiler.h"

#include <cstdint>

// Cell projection: tetrahedra are projected to the pixels of a tile, and become segments of their
// rays. Plain structures only; see Kernels.h.
//
// A pixel of a tile has a label: its column and row, counted from the middle pixel. A point has the
// homogeneous coordinates X, Y and W, so that the ray with the label (X / W, Y / W) passes through
// it, and a depth: the distance from the near plane, in units of the clip coordinates. All four are
// linear functions of the point. The ray of a pixel (i, j) sees a point at (X - i W, Y - j W).

namespace vtkIsosurfaceRayTracing
{

/// A tile and the parts of its rays that are drawn. Depths are the same for all fields.
struct CloudTile
{
  /// The number of pixels along an edge, at most. (In larger tiles cells are read less often, and
  /// the segments of a tile do not fit into the cache.)
  static constexpr int EdgeBits = 4;
  static constexpr int Edge = 1 << EdgeBits;
  static constexpr int Capacity = Edge * Edge;
  /// The pixel that labels are counted from.
  static constexpr int Middle = Edge / 2;

  int Columns;
  int Rows;
  /// X, Y, W and the depth of a point of a field: each the product of a row with (x, y, z, 1).
  double FromPoint[4][4];

  // The pixels in rows of Edge.
  /// The bits of the columns whose rays are not opaque yet.
  std::uint32_t Open[Edge];
  /// The depths that rays begin and end at.
  double Begin[Capacity];
  double End[Capacity];
  /// The depth at T = 1 of each ray, and its length in the world for one unit of the depth.
  double DepthOfT[Capacity];
  double Length[Capacity];
};

/// The largest number of components of a cloud.
constexpr int MaximumCloudComponents = 4;

/// Tetrahedra as a tile sees them.
struct ProjectedTetrahedra
{
  static constexpr int Capacity = 64;

  /// The edges between the corners 01, 02, 03, 12, 13, 23.
  static constexpr int Edges = 6;

  int Count;
  // The corners are in the order of their places: by x, then by y, then by z.
  alignas(64) double X[4][Capacity];
  double Y[4][Capacity];
  double W[4][Capacity];
  double Depth[4][Capacity];
  /// What no depth in them is less than, or more than, whatever rounding does.
  double Nearest[Capacity];
  double Farthest[Capacity];
  /// Of each component.
  double Value[MaximumCloudComponents][4][Capacity];
  /// The coordinates of the gradients at the corners, one after the other; null without.
  const double (*Gradient)[4][Capacity] = nullptr;

  /// The area that the ray (i, j) and an edge span is A i + B j + C, up to less than Rounding.
  double A[Edges][Capacity];
  double B[Edges][Capacity];
  double C[Edges][Capacity];
  double Rounding[Edges][Capacity];
  /// The largest of those of a tetrahedron.
  double LargestRounding[Capacity];

  /// The line where the area of an edge is zero, in single precision: on a row of the tile it is at
  /// the column Slope row + Start. The signs of areas are sure for pixels that are farther from
  /// there than the margin.
  float LineSlope[Edges][Capacity];
  float LineStart[Edges][Capacity];
  float LineMargin[Edges][Capacity];

  /// The pixels that may be covered, from first to last; none if the last comes before the first.
  int FirstColumn[Capacity];
  int LastColumn[Capacity];
  int FirstRow[Capacity];
  int LastRow[Capacity];
};

/// The largest magnitude of values; those beyond are taken for it.
constexpr double LargestCloudValue = 1e300;

/// Segments of rays in tetrahedra, in which the values are linear, and so are the gradients that
/// light them.
struct CloudSegments
{
  /// The most that are looked for at once. (A tetrahedron may cover all pixels, and vectors are
  /// stored as a whole.)
  static constexpr int Batch = 3072;
  static constexpr int Capacity = Batch + CloudTile::Capacity + 16;

  /// Those that are looked for: at least so many are found, if there are, and no more than one
  /// tetrahedron has besides.
  int Enough = Batch;
  int Count = 0;
  int Components = 1;
  /// How many of the last components have gradients.
  int Gradients = 0;
  alignas(64) int Pixel[Capacity];
  /// The depths at both ends, and the values there of each component.
  double Depth[2][Capacity];
  double Value[MaximumCloudComponents][2][Capacity];
  /// The coordinates of the gradients, one after the other. Their directions count, not their
  /// lengths.
  float Gradient[3 * MaximumCloudComponents][2][Capacity];
};

/// What segments add to their rays: red, green and blue, and the part of the light that passes.
struct SegmentLight
{
  float Color[3];
  float Transmittance;
};

/// Segments of the rays of a tile that wait to be drawn: a list for each pixel. The lists of a row
/// of pixels are stored side by side, with room for some segments each.
struct SegmentLists
{
  int Room;
  int* Count;
  double* Depth;
  SegmentLight* Light;
  /// Of a kernel, for a row.
  double* Keys;

  /// Where a segment of a pixel is, given its place in the list.
  SIMD_INLINE static int GetIndex(int room, int pixel, int place)
  {
    const int column = pixel % CloudTile::Edge;
    return (pixel - column) * room + place * CloudTile::Edge + column;
  }
  SIMD_INLINE int GetIndex(int pixel, int place) const
  {
    return GetIndex(this->Room, pixel, place);
  }
};

/// What is seen of the rays of a tile so far: red, green and blue, and the part of the light behind
/// it that is seen.
struct TileLight
{
  double Color[3][CloudTile::Capacity];
  double Transmittance[CloudTile::Capacity];
};

/// A ray ends where less of the light behind is seen.
constexpr double NegligibleLight = 0x1p-15;

/// A piece of transfer functions, in which they are linear: from a value Low to High. The functions
/// are the attenuation for a unit of length in the world, red, green and blue.
struct alignas(64) TransferPiece
{
  double Low;
  double High;
  /// A value, and the functions there.
  double Anchor;
  /// One over the width; zero if the piece has no end, infinite if it is too narrow for that.
  double Scale;
  double AtAnchor[4];
  double Slope[4];
  /// The functions in single precision: at the anchor, then how they change over the width.
  float Functions[8];
};

/// Transfer functions of all values.
struct TransferPieces
{
  /// In order; the first begins at minus infinity, the last ends at infinity.
  const TransferPiece* Pieces;
  /// For each of some intervals of values, beginning with First, the first piece that is in it.
  const int* FirstInBin;
  int Bins;
  double First;
  double BinsPerUnit;
};

/// How the light that falls on a cloud is reflected; see Material.
struct CloudMaterial
{
  double Ambient;
  double Diffuse;
  double Specular;
  double SpecularPower;
};

/// The transfer functions of several components. Either each is a cloud by itself, and they are
/// mixed: attenuations are added, and each gives light of its own colours. Or they are one cloud,
/// whose attenuation and colours are the sums of those of the components.
struct MixedTransfers
{
  int Components;
  bool AreIndependent;
  const TransferPieces* Transfers[MaximumCloudComponents];
  /// The cloud is lit if there are gradients: of all components if they are independent, else of
  /// the last one; and so many materials.
  int Gradients;
  CloudMaterial Materials[MaximumCloudComponents];
};

/// A light in world coordinates; see Light.
struct CloudLight
{
  double DiffuseColor[3];
  double SpecularColor[3];
  /// From the cloud to the light, of length one.
  double Direction[3];
  bool IsPositional;
  double Position[3];
  double Attenuation[3];
  /// It shines where the cosine to the direction is not less.
  bool HasCone;
  double LeastCosine;
  double Exponent;
};

/// What lights the segments of a tile.
struct CloudLighting
{
  int LightCount;
  const CloudLight* Lights;
  bool AreTwoSided;
  /// Takes a gradient of a field to the direction that it has in the world.
  double WorldFromGradient[16];
  /// Of each ray in the world, where it has the depth 0, and the direction back along it, of length
  /// one.
  double Origin[3][CloudTile::Capacity];
  double ToViewer[3][CloudTile::Capacity];
};

}

#endif
