// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The frustum that rays make along an axis. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Across its axis a frustum may go this much per cell along it.
constexpr double LargestSlope = 2.0;

/// Finds what the subpackets of a packet sweep along one of the axes across.
SIMD_INLINE void SweepBunches(const RaySet& rays, int j, AlignedRays& aligned)
{
  const double low = aligned.SweptLow;
  const double high = aligned.SweptHigh;
  const double inverse = 1.0 / (high - low);
  for (int subpacket = 0; subpacket < AlignedRays::Subpackets; ++subpacket)
  {
    const int first = subpacket * AlignedRays::SubpacketSize;
    // Subpackets without rays are empty.
    aligned.LeastOffset[j][subpacket] = Infinity;
    aligned.LeastSlope[j][subpacket] = 0.0;
    aligned.MostOffset[j][subpacket] = -Infinity;
    aligned.MostSlope[j][subpacket] = 0.0;
    if ((rays.Words[first >> 6] >> (first & 63) & 0xFFU) == 0)
    {
      continue;
    }
    Doubles least[2] = { Infinity, Infinity };
    Doubles most[2] = { -Infinity, -Infinity };
    for (int i = first; i < first + AlignedRays::SubpacketSize; i += DoubleWidth)
    {
      const Mask mask = ToMask(GetLanes(rays, i));
      const Doubles slope = Load(&aligned.Slope[j][i]);
      const Doubles offset = Load(&aligned.Offset[j][i]);
      for (int end = 0; end < 2; ++end)
      {
        const Doubles coordinate = offset + (end == 0 ? low : high) * slope;
        least[end] = Select(mask, Min(least[end], coordinate), least[end]);
        most[end] = Select(mask, Max(most[end], coordinate), most[end]);
      }
    }
    const double leastAtLow = ReduceMin(least[0]);
    const double mostAtLow = ReduceMax(most[0]);
    aligned.LeastSlope[j][subpacket] = (ReduceMin(least[1]) - leastAtLow) * inverse;
    aligned.MostSlope[j][subpacket] = (ReduceMax(most[1]) - mostAtLow) * inverse;
    aligned.LeastOffset[j][subpacket] = leastAtLow - low * aligned.LeastSlope[j][subpacket];
    aligned.MostOffset[j][subpacket] = mostAtLow - low * aligned.MostSlope[j][subpacket];
  }
}

/// Finds the lines that bound all subpackets along one of the axes across.
SIMD_INLINE void BoundBunches(const AlignedRays& aligned, int j, Frustum& frustum)
{
  const double ends[2] = { frustum.Low, frustum.High };
  for (int end = 0; end < 2; ++end)
  {
    const Doubles plane = ends[end];
    Doubles least = Infinity;
    Doubles most = -Infinity;
    for (int i = 0; i < AlignedRays::Subpackets; i += DoubleWidth)
    {
      least =
        Min(least, Load(&aligned.LeastOffset[j][i]) + plane * Load(&aligned.LeastSlope[j][i]));
      most = Max(most, Load(&aligned.MostOffset[j][i]) + plane * Load(&aligned.MostSlope[j][i]));
    }
    frustum.Least[j][end] = ReduceMin(least) - Margin;
    frustum.Most[j][end] = ReduceMax(most) + Margin;
  }
}

bool Align(
  const RayPacket& packet, const RaySet& rays, int axis, AlignedRays& aligned, Frustum& frustum)
{
  const int across[2] = { AxisU[axis], AxisV[axis] };
  const Doubles zero = 0.0;
  const Doubles margin = Margin;
  Doubles low = Infinity;
  Doubles high = -Infinity;
  unsigned int up = 0;
  unsigned int down = 0;
  unsigned int steep = 0;
  for (int i = 0; i < packet.Count; i += DoubleWidth)
  {
    const unsigned int lanes = GetLanes(rays, i);
    if (lanes == 0)
    {
      continue;
    }
    const Mask mask = ToMask(lanes);
    const Doubles direction = Load(&packet.Direction[axis][i]);
    const Doubles origin = Load(&packet.Origin[axis][i]);
    const Doubles inverse = Load(&packet.Inverse[axis][i]);
    const unsigned int upward = ToBits(zero < direction);
    const unsigned int downward = ToBits(direction < zero);
    up |= lanes & upward;
    down |= lanes & downward;
    // A ray must move along the axis.
    steep |= lanes & ~(upward | downward);
    const Doubles begin = origin + Load(&packet.Begin[i]) * direction;
    const Doubles end = origin + Load(&packet.End[i]) * direction;
    const Doubles lowest = Min(begin, end) - margin;
    const Doubles highest = Max(begin, end) + margin;
    Store(lowest, &aligned.Low[i]);
    Store(highest, &aligned.High[i]);
    low = Select(mask, Min(low, lowest), low);
    high = Select(mask, Max(high, highest), high);
    for (int j = 0; j < 2; ++j)
    {
      const Doubles slope = Load(&packet.Direction[across[j]][i]) * inverse;
      const Doubles size = Abs(slope);
      // Negated, so that NaN counts as steep.
      steep |= lanes & ~ToBits(size <= LargestSlope);
      Store(slope, &aligned.Slope[j][i]);
      Store(Load(&packet.Origin[across[j]][i]) - origin * slope, &aligned.Offset[j][i]);
    }
    StorePairs(Load(&aligned.Slope[0][i]), Load(&aligned.Slope[1][i]), &aligned.Slopes[i]);
  }
  frustum.Axis = axis;
  frustum.IsUp = up != 0;
  frustum.Low = ReduceMin(low);
  frustum.High = ReduceMax(high);
  if ((up != 0) == (down != 0) || steep != 0)
  {
    return false;
  }
  aligned.SweptLow = frustum.Low;
  aligned.SweptHigh = frustum.High;
  for (int j = 0; j < 2; ++j)
  {
    SweepBunches(rays, j, aligned);
    BoundBunches(aligned, j, frustum);
  }
  return true;
}

}
}
