// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a packet in the frames of a beam and of their own. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Which axis each of the rays is longest along: the first one, or the second.
struct LongestAxes
{
  Mask AreFirst;
  Mask AreSecond;

  LongestAxes() = default;
  SIMD_INLINE explicit LongestAxes(const Doubles direction[3])
  {
    const Doubles size[3] = { Abs(direction[0]), Abs(direction[1]), Abs(direction[2]) };
    this->AreFirst = (size[1] <= size[0]) & (size[2] <= size[0]);
    this->AreSecond = AndNot(size[2] <= size[1], this->AreFirst);
  }

  /// The components along, and across in cyclic order.
  SIMD_INLINE void Turn(const Doubles v[3], Doubles turned[3]) const
  {
    for (int i = 0; i < 3; ++i)
    {
      turned[i] =
        Select(this->AreFirst, v[i], Select(this->AreSecond, v[(i + 1) % 3], v[(i + 2) % 3]));
    }
  }
};

SIMD_INLINE void StoreFrames(const Doubles origin[3], const Doubles direction[3],
  const Doubles inverses[3], int first, FramedRays& framed)
{
  const LongestAxes axes(direction);
  Doubles turned[3];
  double numbers[6][DoubleWidth];
  axes.Turn(origin, turned);
  for (int i = 0; i < 3; ++i)
  {
    Store(turned[i], numbers[i]);
  }
  axes.Turn(inverses, turned);
  const Doubles inverse = turned[0];
  Store(inverse, numbers[5]);
  axes.Turn(direction, turned);
  Store(turned[1] * inverse, numbers[3]);
  Store(turned[2] * inverse, numbers[4]);
  const unsigned int areFirst = ToBits(axes.AreFirst);
  const unsigned int areSecond = ToBits(axes.AreSecond);
  for (int lane = 0; lane < DoubleWidth; ++lane)
  {
    framed.Axis[first + lane] =
      (areFirst >> lane & 1U) != 0 ? 0 : ((areSecond >> lane & 1U) != 0 ? 1 : 2);
    for (int i = 0; i < 6; ++i)
    {
      framed.Frame[first + lane][i] = numbers[i][lane];
    }
  }
}

void FrameRays(const RayPacket& packet, const BeamNumbers& beam, FramedRays& framed)
{
  framed.InBeam.Words[0] = framed.InBeam.Words[1] = 0;
  for (int i = 0; i < packet.Count; i += DoubleWidth)
  {
    const unsigned int exists = GetLanes(packet.Exists, i);
    if (exists == 0)
    {
      continue;
    }
    Doubles origin[3];
    Doubles direction[3];
    Doubles inverse[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = Load(&packet.Origin[axis][i]);
      direction[axis] = Load(&packet.Direction[axis][i]);
      inverse[axis] = Load(&packet.Inverse[axis][i]);
    }
    StoreFrames(origin, direction, inverse, i, framed);
    const Doubles way = beam.Plane - origin[beam.Along];
    Doubles place[2];
    Doubles slope[2];
    Mask isIn = 0.0 < direction[beam.Along] * beam.Sign;
    for (int k = 0; k < 2; ++k)
    {
      const int across = beam.Across[k];
      slope[k] = direction[across] * inverse[beam.Along];
      place[k] = origin[across] + slope[k] * way;
      const Doubles label = (place[k] - beam.Center[k]) * beam.InverseSize;
      isIn = isIn & (Abs(label) <= 1.0);
      Store(label, &framed.Label[k][i]);
    }
    isIn = isIn & (GetLabelError(beam, place, slope) <= static_cast<double>(beam.Margin));
    const Doubles end = origin[beam.Along] + Load(&packet.End[i]) * direction[beam.Along];
    Store(GetEndDepth(beam, end), &framed.End[i]);
    framed.InBeam.Words[i >> 6] |= static_cast<std::uint64_t>(exists & ToBits(isIn)) << (i & 63);
  }
}

}
}
