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

  SIMD_INLINE void StoreNumbers(int* to) const
  {
    StoreTruncated(
      Select(this->AreFirst, Doubles(0.0), Select(this->AreSecond, Doubles(1.0), 2.0)), to);
  }
};

SIMD_INLINE void StoreFrames(const Doubles origin[3], const Doubles direction[3],
  const Doubles inverses[3], int first, FramedRays& framed)
{
  const LongestAxes axes(direction);
  Doubles origins[3];
  Doubles directions[3];
  Doubles inversesAlong[3];
  axes.Turn(origin, origins);
  axes.Turn(direction, directions);
  axes.Turn(inverses, inversesAlong);
  const Doubles inverse = inversesAlong[0];
  const Doubles numbers[2][4] = { { origins[0], origins[1], origins[2], directions[1] * inverse },
    { directions[2] * inverse, inverse, 0.0, 0.0 } };
  for (int i = 0; i < 2; ++i)
  {
    StoreFours(numbers[i], &framed.Frame[first][4 * i], FramedRays::Numbers);
  }
  axes.StoreNumbers(&framed.Axis[first]);
}

/// Rays as a beam sees them.
struct LabelledRays
{
  Doubles Label[2];
  Doubles Begin;
  /// -infinity of those that are not in the beam.
  Doubles End;
};

/// The depths of rays at some t, and a margin.
SIMD_INLINE Doubles FindDepths(
  const RayPacket& packet, const BeamNumbers& beam, const double* t, int first)
{
  return GetEndDepth(beam,
    Load(&packet.Origin[beam.Along][first]) +
      Load(&t[first]) * Load(&packet.Direction[beam.Along][first]));
}

SIMD_INLINE LabelledRays FrameSome(
  const RayPacket& packet, const BeamNumbers& beam, int first, FramedRays& framed)
{
  const unsigned int exists = GetLanes(packet.Exists, first);
  if (exists == 0)
  {
    return { { 0.0, 0.0 }, 0.0, -Infinity };
  }
  Doubles origin[3];
  Doubles direction[3];
  Doubles inverse[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = Load(&packet.Origin[axis][first]);
    direction[axis] = Load(&packet.Direction[axis][first]);
    inverse[axis] = Load(&packet.Inverse[axis][first]);
  }
  StoreFrames(origin, direction, inverse, first, framed);
  const Doubles way = beam.Plane - origin[beam.Along];
  LabelledRays rays;
  Doubles place[2];
  Doubles slope[2];
  Mask isIn = ToMask(exists) & (0.0 < direction[beam.Along] * beam.Sign);
  for (int k = 0; k < 2; ++k)
  {
    const int across = beam.Across[k];
    slope[k] = direction[across] * inverse[beam.Along];
    place[k] = origin[across] + slope[k] * way;
    rays.Label[k] = (place[k] - beam.Center[k]) * beam.InverseSize;
    isIn = isIn & (Abs(rays.Label[k]) <= 1.0);
  }
  isIn = isIn & (GetLabelError(beam, place, slope) <= static_cast<double>(beam.Margin));
  rays.Begin = FindDepths(packet, beam, packet.Begin, first);
  rays.End = Select(isIn, FindDepths(packet, beam, packet.End, first), Doubles(-Infinity));
  framed.InBeam.Words[first >> 6] |= static_cast<std::uint64_t>(ToBits(isIn)) << (first & 63);
  return rays;
}

/// Copies numbers of rays to the places of the rays.
SIMD_INLINE void PlaceNumbers(const float* ofRays, const BeamRays& rays, float* ofPlaces)
{
  for (int place = 0; place < BeamRays::Capacity; place += BeamRays::Run)
  {
    std::memcpy(ofPlaces + place, ofRays + rays.Ray[place], BeamRays::Run * sizeof(float));
  }
}

/// Finds the bounds of the labels of groups of rays, and of all.
SIMD_INLINE void FindLabelBounds(int k, BeamRays& rays)
{
  Floats lowest = FloatInfinity;
  Floats highest = -FloatInfinity;
  for (int group = 0; group < BeamRays::Groups; ++group)
  {
    Floats lower = FloatInfinity;
    Floats upper = -FloatInfinity;
    const int begin = group * BeamRays::GroupSize;
    for (int i = begin; i < begin + BeamRays::GroupSize; i += FloatWidth)
    {
      const Floats label = LoadFloats(&rays.Label[k][i]);
      const FloatMask isThere = Floats(-FloatInfinity) < LoadFloats(&rays.End[i]);
      lower = Select(isThere, Min(lower, label), lower);
      upper = Select(isThere, Max(upper, label), upper);
    }
    rays.Lower[k][group] = ReduceMin(lower);
    rays.Upper[k][group] = ReduceMax(upper);
    lowest = Min(lowest, lower);
    highest = Max(highest, upper);
  }
  rays.LowerOfAll[k] = ReduceMin(lowest);
  rays.UpperOfAll[k] = ReduceMax(highest);
}

/// Finds the ends of all groups, of rays none of which surely hits what is not solved.
SIMD_INLINE void FindAllEnds(BeamRays& rays)
{
  for (unsigned int& sure : rays.Sure)
  {
    sure = 0;
  }
  rays.EndOfSure = -FloatInfinity;
  FindGroupEnds((1U << BeamRays::Groups) - 1U, rays);
}

void FrameRays(const RayPacket& packet, const BeamNumbers& beam, FramedRays& framed, BeamRays& rays)
{
  alignas(64) float label[2][BeamRays::Capacity];
  alignas(64) float begin[BeamRays::Capacity];
  alignas(64) float end[BeamRays::Capacity];
  framed.InBeam.Words[0] = framed.InBeam.Words[1] = 0;
  for (int i = 0; i < BeamRays::Capacity; i += FloatWidth)
  {
    const LabelledRays low = FrameSome(packet, beam, i, framed);
    const LabelledRays high = FrameSome(packet, beam, i + DoubleWidth, framed);
    for (int k = 0; k < 2; ++k)
    {
      StoreFloats(Round(low.Label[k], high.Label[k]), &label[k][i]);
    }
    StoreFloats(Round(low.Begin, high.Begin), &begin[i]);
    StoreFloats(Round(low.End, high.End), &end[i]);
  }
  PlaceNumbers(begin, rays, rays.Begin);
  PlaceNumbers(end, rays, rays.End);
  for (int k = 0; k < 2; ++k)
  {
    PlaceNumbers(label[k], rays, rays.Label[k]);
    FindLabelBounds(k, rays);
  }
  FindAllEnds(rays);
}

void FindFrames(const RayPacket& packet, FramedRays& framed)
{
  for (int i = 0; i < packet.Count; i += DoubleWidth)
  {
    if (GetLanes(packet.Exists, i) == 0)
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
  }
}

RaySet EndRays(const RayPacket& packet, const BeamNumbers& beam, const double* ends, BeamRays& rays)
{
  alignas(64) float depths[BeamRays::Capacity];
  alignas(64) float placed[BeamRays::Capacity];
  for (int i = 0; i < BeamRays::Capacity; i += FloatWidth)
  {
    const Doubles low = FindDepths(packet, beam, ends, i);
    const Doubles high = FindDepths(packet, beam, ends, i + DoubleWidth);
    StoreFloats(Round(low, high), &depths[i]);
  }
  PlaceNumbers(depths, rays, placed);
  RaySet missed = {};
  for (int first = 0; first < BeamRays::Capacity; first += FloatWidth)
  {
    const Floats end = LoadFloats(&rays.End[first]);
    const Floats depth = LoadFloats(&placed[first]);
    StoreFloats(Min(end, depth), &rays.End[first]);
    unsigned int areMissed =
      ToBits(end < depth) & rays.Sure[first / BeamRays::GroupSize] >> (first % BeamRays::GroupSize);
    for (; areMissed != 0; areMissed &= areMissed - 1)
    {
      const int place = first + LowestBit(areMissed);
      const int ray = rays.Ray[place];
      missed.Words[ray >> 6] |= std::uint64_t{ 1 } << (ray & 63);
      rays.End[place] = -FloatInfinity;
    }
  }
  FindAllEnds(rays);
  return missed;
}

}
}
