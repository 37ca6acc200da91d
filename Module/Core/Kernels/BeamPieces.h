// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef BeamPieces_h
#define BeamPieces_h

#include "Kernels/MeshCellArrays.h"
#include "Math/Arithmetic.h"
#include "Math/Bounds.h"
#include "Rays/RayPacket.h"
#include "Rays/TrilinearSearch.h"

#include <cstddef>
#include <cstdint>

// What the rays of a beam may meet in a mesh, in single precision. A beam is a set of rays through
// one point, or of parallel ones: each is a point of a plane across them, its label. What is in
// space has a label, too, that of the ray through it. (See BeamFrame.h.) Everything is bounded with
// a margin for rounding: what is found is too much at times, never too little.

namespace vtkIsosurfaceRayTracing
{

/// Points with a smaller W are too near to where the rays meet: they may have any label.
constexpr double SmallestW = 0x1p-10;

/// How boxes are projected to labels; see BeamFrame. The coordinates along the beam are z, and
/// those across it x.
struct BeamProjection
{
  /// The axes along the beam and across.
  int Along;
  int Across[2];
  bool IsUp;
  /// The plane of labels and the centre of the beam there, and what rounding took off them.
  float Plane;
  float PlaneRest;
  float Center[2];
  float CenterRest[2];
  /// W is 1 + Spread (z - Plane).
  float Spread;
  /// X is Scale (x - Center) - Slope (z - Plane), for each of the axes across.
  float Scale;
  float Slope[2];
  /// By how much X, labels as a part of themselves, and depths may be wrong.
  float Error;
  float RelativeError;
  float DepthError;
  /// The depth that the rays begin at.
  float Begin;
};

/// The bounds of what is in a beam: a rectangle of labels, and the depth it begins at.
struct LabelBounds
{
  static constexpr int Capacity = 16;

  alignas(64) float Lower[2][Capacity];
  alignas(64) float Upper[2][Capacity];
  alignas(64) float Near[Capacity];

  /// Copies those of one thing.
  void Copy(const LabelBounds& from, int number, int to)
  {
    for (int k = 0; k < 2; ++k)
    {
      this->Lower[k][to] = from.Lower[k][number];
      this->Upper[k][to] = from.Upper[k][number];
    }
    this->Near[to] = from.Near[number];
  }
};

/// An isovalue between two floats: a range of values holds it if its low is not above Before, and
/// its high not below From.
struct IsovalueSpan
{
  float Before;
  float From;
};

/// The numbers of a beam's frame; see BeamFrame.
struct BeamNumbers
{
  /// The axes along the beam and across.
  int Along;
  int Across[2];
  /// 1 if the rays go up the axis, -1 if they go down.
  double Sign;
  /// The coordinate of the plane of labels: where the rays leave the box.
  double Plane;
  /// The ray with the label 0: where it meets the plane, and its slopes there.
  double Center[2];
  double Slope[2];
  /// The change of the slope with the place.
  double Spread;
  double InverseSize;
  /// The extent of the box along the axis.
  double Length;
  /// By how much the labels of rays may be wrong.
  float Margin;
};

/// By how much the label of a ray is wrong within the box, where W is not too small, given where it
/// meets the plane and its slopes: rays do not pass through one point to the last bit.
template <typename Number>
SIMD_INLINE Number GetLabelError(
  const BeamNumbers& frame, const Number place[2], const Number slope[2])
{
  Number error = 0.0;
  for (int k = 0; k < 2; ++k)
  {
    const Number expected = frame.Slope[k] + frame.Spread * (place[k] - frame.Center[k]);
    error = Max(error, Abs(slope[k] - expected));
  }
  return error * (frame.Length * frame.InverseSize / SmallestW);
}

/// The depth of a point on the axis, and a margin.
template <typename Number>
SIMD_INLINE Number GetEndDepth(const BeamNumbers& frame, Number coordinate)
{
  const Number depth = frame.Sign * (coordinate - frame.Plane);
  return depth + 0x1p-20 * (Abs(depth) + frame.Length);
}

/// Pieces of a surface in some cells of a leaf of the tree, for any view. In tetrahedra they are
/// polygons; of others, the boxes are known that they are in.
struct alignas(64) PackedPieces
{
  static constexpr int Capacity = LabelBounds::Capacity;
  static constexpr int Corners = 4;
  static constexpr int Bits = 10;
  static constexpr unsigned int Steps = (1U << Bits) - 1U;

  /// The box that they are in.
  float Lower[3];
  float Upper[3];
  /// Of the cells, the numbers within the leaf.
  std::uint8_t Cells[Capacity];
  std::uint8_t Count;
  /// All of them, or none.
  bool AreInTetrahedra;
  /// Of the first set of a leaf, the number of sets.
  std::uint16_t Sets;
  /// The corners of polygons in order around them: x, y and z in steps of the box from its lower
  /// corner, x lowest. In triangles the last two are the same. Of boxes the first two are the lower
  /// and the upper corner.
  std::uint32_t Polygons[Corners][Capacity];
};

/// Bounds of the pieces of surfaces in some cells.
struct BeamPieces
{
  static constexpr int Capacity = LabelBounds::Capacity;
  static constexpr int Lines = 4;

  int Count;
  /// Pieces that may have any label are counted here.
  int AnyLabel;
  LabelBounds Bounds;
  /// The piece is where Line[i][0] * a + Line[i][1] * b + Line[i][2] >= 0.
  alignas(64) float Line[Lines][3][Capacity];
  /// Rays are surely within the piece where none of these sums is less than this...
  alignas(64) float Inset[Lines][Capacity];
  /// ...and meet it before this depth; infinity if that does not end them, or nothing is sure.
  alignas(64) float Far[Capacity];
};

/// The rays of a packet in a beam.
struct BeamRays
{
  static constexpr int GroupSize = 16;
  static constexpr int Capacity = RayPacket::Capacity;
  static constexpr int Groups = Capacity / GroupSize;

  /// Rays of the packet in so many consecutive places follow each other.
  static constexpr int Run = 4;

  /// The ray of the packet in each place.
  int Ray[Capacity];
  /// Its label, and the depths that it begins and ends at; ends are -infinity where there is none.
  alignas(64) float Label[2][Capacity];
  alignas(64) float Begin[Capacity];
  alignas(64) float End[Capacity];
  /// Those that end behind a piece that they surely hit, but of which the hit is not known yet; a
  /// bit for each ray of a group.
  unsigned int Sure[Groups];
  /// Where the last of these ends, or behind it; -infinity without any.
  float EndOfSure;
  /// The bounds of groups of rays; behind the last there is room for a vector.
  alignas(64) float Lower[2][2 * Groups];
  alignas(64) float Upper[2][2 * Groups];
  alignas(64) float GroupEnd[2 * Groups];
  /// The bounds of all rays.
  float LowerOfAll[2];
  float UpperOfAll[2];
  float EndOfAll;
};

/// Rays and the pieces that they may hit.
struct BeamPairs
{
  /// As soon as there are so many they are solved, or so many of rays that may go on for long until
  /// then...
  static constexpr int Batch = 512;
  static constexpr int BatchOfUnsure = 16;
  /// ...but all rays may meet all of some pieces at once. Behind the last there is room for a
  /// vector.
  static constexpr int Capacity =
    Batch + RayPacket::Capacity * BeamPieces::Capacity + BeamRays::GroupSize;

  int Count;
  /// Those of rays that did not yet end at any piece, when they were found.
  int UnsureCount;
  /// The place of the ray.
  int Place[Capacity];
  int Piece[Capacity];
  /// The depth that the piece begins at.
  float Near[Capacity];
};

/// The rays of a packet, each in a frame of its own; see RayFrame.
struct FramedRays
{
  /// Those in the beam.
  RaySet InBeam;
  /// The longest axis of the ray.
  int Axis[RayPacket::Capacity];
  /// The numbers of the frame, as in FrameNumbers: its origin, the shears and the inverse.
  static constexpr int Numbers = 8;
  alignas(64) double Frame[RayPacket::Capacity][Numbers];
};

/// Rays in tetrahedra, and where they hit.
struct TetrahedronPairs
{
  static constexpr int Capacity = 64;

  int Count;
  int Ray[Capacity];
  /// The number of the cell among the corners.
  int Cell[Capacity];
  /// Of each cell the corners in the order of their ids: coordinates, and the difference of the
  /// value from the isovalue.
  alignas(64) double Corners[Capacity][4][4];
  /// Those with a hit; a bit for each. The numbers of the others are undefined.
  std::uint64_t Found;
  std::uint64_t Entering;
  /// Those whose coordinates are too large or too small for the arithmetic of the kernel.
  std::uint64_t Extreme;
  alignas(64) double T[Capacity];
  alignas(64) double Weights[4][Capacity];
};

/// Rays in trilinear cells, and where they hit.
struct TrilinearPairs
{
  static constexpr int Capacity = TetrahedronPairs::Capacity;

  int Count;
  int Ray[Capacity];
  /// The number of the cell among the corners.
  int Cell[Capacity];
  /// Of each cell the corners, as in PassedCellRecords.
  alignas(64) double Corners[Capacity][PassedCellRecords::Corners][4];
  TrilinearSolutions Solutions[Capacity];
};

}

#endif
