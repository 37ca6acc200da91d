// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The kernels, included once for every instruction set. They call nothing of the standard library
// but C's functions, and of other headers of the core only what is always inlined (see
// Math/Arithmetic.h): the linker keeps one copy of a function that several files compile, which
// might be the one for an instruction set that the processor does not have.

#include "Kernels/BeamPieces.h"
#include "Kernels/Kernels.h"
#include "Kernels/Vectors.h"
#include "Math/BernsteinCubic.h"
#include "Math/ByteColor.h"
#include "Math/EmissionAbsorption.h"
#include "Math/FlatEdges.h"
#include "Math/MonotonePieces.h"
#include "Math/PhongReflection.h"
#include "Math/TrilinearCell.h"
#include "Math/ValueRange.h"
#include "Math/Vector.h"
#include "Rays/BoxedRays.h"
#include "Rays/CellCrossings.h"
#include "Rays/ClippedRays.h"
#include "Rays/PixelRays.h"
#include "Rays/RayFrame.h"
#include "Rays/TetrahedronHits.h"
#include "Rays/TrilinearHits.h"
#include "Rays/TrilinearSearch.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The margin around rays, in cells: more than all rounding.
constexpr double Margin = 0x1p-9;
/// Beyond any block.
constexpr float NoEnd[2] = { -0x1p60F, 0x1p60F };

// The two axes across each axis.
constexpr int AxisU[3] = { 1, 0, 0 };
constexpr int AxisV[3] = { 2, 2, 1 };

/// Which rays of a vector, from the first on, are in a set: a bit for each lane.
SIMD_INLINE unsigned int GetLanes(const RaySet& rays, int first)
{
  return static_cast<unsigned int>(rays.Words[first >> 6] >> (first & 63)) &
    ((1U << DoubleWidth) - 1U);
}

SIMD_INLINE int SmallerOf(int a, int b)
{
  return a < b ? a : b;
}

SIMD_INLINE float SmallerOf(float a, float b)
{
  return b < a ? b : a;
}

SIMD_INLINE int LargerOf(int a, int b)
{
  return a > b ? a : b;
}

SIMD_INLINE float LargerOf(float a, float b)
{
  return a < b ? b : a;
}

/// Loads the numbers of a corner of each of a vector of cells. Behind the last cell it is repeated.
template <int Corners>
SIMD_INLINE void LoadCorner(
  const double (*cells)[Corners][4], int first, int count, int corner, Doubles numbers[4])
{
  const double* rows[DoubleWidth];
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    rows[lane] = cells[SmallerOf(first + lane, count - 1)][corner];
  }
  LoadFours(rows, numbers);
}

}
}

#include "Kernels/SampleRows.h"

#include "Kernels/AlignRays.inl"
#include "Kernels/BeamPieces.inl"
#include "Kernels/ClassifyCells.inl"

#include "Kernels/BoundCells.inl"

#include "Kernels/DrawSegments.inl"
#include "Kernels/FindChildrenAround.inl"
#include "Kernels/FindExtents.inl"
#include "Kernels/FindMetBoxes.inl"
#include "Kernels/FindMetCells.inl"
#include "Kernels/FindPassages.inl"
#include "Kernels/ScanTetrahedra.inl"

#include "Kernels/FindSegments.inl"
#include "Kernels/FindSegmentsInCells.inl"
#include "Kernels/FrameRays.inl"
#include "Kernels/GradientsInCells.inl"
#include "Kernels/IncludeRow.inl"
#include "Kernels/IntegrateSegments.inl"
#include "Kernels/LightSegments.inl"

#include "Kernels/IntegrateMixture.inl"

#include "Kernels/InterpolateGradients.inl"
#include "Kernels/MakeCloudRays.inl"
#include "Kernels/MakePixels.inl"
#include "Kernels/MakeRays.inl"
#include "Kernels/MoveRays.inl"
#include "Kernels/PackPieces.inl"
#include "Kernels/ScatteredRays.inl"

#include "Kernels/PiecesOnRay.inl"

#include "Kernels/ProjectTetrahedra.inl"
#include "Kernels/ShadeHits.inl"
#include "Kernels/SolveCandidates.inl"

#include "Kernels/SolveBoxes.inl"
#include "Kernels/SolveTetrahedra.inl"
#include "Kernels/SolveTrilinear.inl"
#include "Kernels/SumAtCorners.inl"
#include "Kernels/TricubicCells.inl"

// One for every ScalarType.
#define FOR_ALL_TYPES(function)                                                                    \
  {                                                                                                \
    function<std::int8_t>, function<std::uint8_t>, function<std::int16_t>,                         \
      function<std::uint16_t>, function<std::int32_t>, function<std::uint32_t>,                    \
      function<std::int64_t>, function<std::uint64_t>, function<float>, function<double>           \
  }

#define KERNELS(name)                                                                              \
  const Kernels name = { MakeRays, MakeBoxedRays, CutPacketToBox, FindMetBoxes, ClipRays,          \
    MoveRaysToBox, MoveRays, Align, FindPassages, FindMembersOfRay, FindPassage,                   \
    FOR_ALL_TYPES(ClassifyCells), FOR_ALL_TYPES(FindRanges), FOR_ALL_TYPES(BoundCells),            \
    FOR_ALL_TYPES(LoadCorners), Solve, SolveBoxes, FOR_ALL_TYPES(InterpolateDifferences), Shade,   \
    MakePixels, FOR_ALL_TYPES(IncludeRow), FrameRays, FindFrames, EndRays, ProjectChildren,        \
    FindChildrenOnRay, FindChildrenAround, FOR_ALL_TYPES(FindExtents), WeightGradients,            \
    FindCornerGradients, SumAtCorners, PackPolygons, PackBoxes, ScatterRays, FindPiecesOnRay,      \
    FindSetOnRay, BoundPackedPieces, BoundTrilinear, FindPassed, FindPairs, SolveTetrahedra,       \
    SolveTrilinear, FindMetChildren, FindMetCells, MakeCloudRays, ProjectTetrahedra,               \
    { { FindSegments<1, 0>, FindSegments<1, 1> },                                                  \
      { FindSegments<2, 0>, FindSegments<2, 1>, FindSegments<2, 2> },                              \
      { FindSegments<3, 0>, nullptr, nullptr, FindSegments<3, 3> },                                \
      { FindSegments<4, 0>, FindSegments<4, 1>, nullptr, nullptr, FindSegments<4, 4> } },          \
    IntegrateSegments, IntegrateMixture, IntegrateLitMixture, DrawSegments, KeepSegments,          \
    FindSegmentsInCells, InterpolateSamples, BoundTricubic, RestrictCell, FindCellGradient }
