// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Frustum_h
#define Frustum_h

#include "Rays/RayPacket.h"

namespace vtkIsosurfaceRayTracing
{

/// Rays of a packet, parametrized by one axis: their coordinates across it in each of its planes.
struct AlignedRays
{
  /// The coordinates across at plane 0 of the axis.
  alignas(64) double Offset[2][RayPacket::Capacity];
  /// Their change from plane to plane.
  alignas(64) double Slope[2][RayPacket::Capacity];
  /// Both slopes of a ray, interleaved.
  alignas(64) float Slopes[RayPacket::Capacity][2];
  /// The extent of the ray in the volume along the axis, with a margin.
  alignas(64) double Low[RayPacket::Capacity];
  alignas(64) double High[RayPacket::Capacity];

  /// What every eight rays, a subpacket, sweep across the axis, bounded as in Frustum: the smallest
  /// and the largest coordinates at plane 0, and their changes from plane to plane. Valid from
  /// SweptLow to SweptHigh.
  static constexpr int SubpacketSize = 8;
  static constexpr int Subpackets = RayPacket::Capacity / SubpacketSize;
  double SweptLow;
  double SweptHigh;
  alignas(64) double LeastOffset[2][Subpackets];
  alignas(64) double LeastSlope[2][Subpackets];
  alignas(64) double MostOffset[2][Subpackets];
  alignas(64) double MostSlope[2][Subpackets];
};

/// A bound of the region that a set of rays sweeps: between the planes Low and High of an axis, it
/// lies between two lines along each of the axes across. (The smallest of linear functions is
/// concave and stays above the chord.)
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
