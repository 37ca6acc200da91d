// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Frustum_h
#define Frustum_h

#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// Rays of a packet as seen along an axis: where they are across it, plane by plane.
struct AlignedRays
{
  /// The coordinates across at plane 0 of the axis.
  alignas(64) double Offset[2][RayPacket::Capacity];
  /// How they change from plane to plane.
  alignas(64) double Slope[2][RayPacket::Capacity];
  /// Both slopes of a ray, side by side.
  alignas(64) float Slopes[RayPacket::Capacity][2];
  /// The part of the ray in the volume, along the axis, and a little more.
  alignas(64) double Low[RayPacket::Capacity];
  alignas(64) double High[RayPacket::Capacity];

  /// What every eight rays sweep across the axis, the first included and as Frustum says: the least
  /// and the most coordinates at plane 0, and how they change from plane to plane. Good from
  /// SweptLow to SweptHigh.
  static constexpr int Bunch = 8;
  static constexpr int Bunches = RayPacket::Capacity / Bunch;
  double SweptLow;
  double SweptHigh;
  alignas(64) double LeastOffset[2][Bunches];
  alignas(64) double LeastSlope[2][Bunches];
  alignas(64) double MostOffset[2][Bunches];
  alignas(64) double MostSlope[2][Bunches];
};

/// What a set of rays sweeps: between the planes Low and High of an axis they are, across it,
/// between two lines. (The smallest of linear functions is concave and stays above the chord.)
struct Frustum
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

}

#endif
