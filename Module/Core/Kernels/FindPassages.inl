// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a block that rays may pass. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Where a block stands: along the axis, and the two across.
struct BlockPlace
{
  /// Its planes; null where they stand at whole numbers.
  const BlockPlanes* Planes[3];
  /// The coordinates of its first planes.
  double First[3];
  /// The coordinates along the axis of the plane that segments are counted from, and of the last.
  double Middle;
  double Last;
};

SIMD_INLINE BlockPlace FindPlace(const int first[3], int axis, const LatticePlanes* planes)
{
  BlockPlace place;
  const int order[3] = { axis, AxisU[axis], AxisV[axis] };
  for (int i = 0; i < 3; ++i)
  {
    const int cell = first[order[i]];
    place.Planes[i] = planes ? &planes->Blocks[order[i]][cell / BlockPlanes::Edge] : nullptr;
    place.First[i] = planes ? place.Planes[i]->First : static_cast<double>(cell);
  }
  place.Middle = planes ? place.First[0] : place.First[0] + 4.0;
  place.Last = place.First[0] + (planes ? place.Planes[0]->Extent : 8.0);
  return place;
}

/// The smallest box around the members of a block: along the axis, and the two across.
struct Box
{
  double Middle[3];
  /// Half its size.
  double Extent[3];
};

/// The subpackets that may meet a box; a bit for each.
SIMD_INLINE unsigned int FindSubpackets(const AlignedRays& aligned, const Box& box)
{
  const double low = box.Middle[0] - box.Extent[0];
  const double high = box.Middle[0] + box.Extent[0];
  const Doubles near = low < aligned.SweptLow ? aligned.SweptLow : low;
  const Doubles far = high < aligned.SweptHigh ? high : aligned.SweptHigh;
  unsigned int found = 0;
  for (int i = 0; i < AlignedRays::Subpackets; i += DoubleWidth)
  {
    Mask meets = FirstLanes(DoubleWidth);
    for (int j = 0; j < 2; ++j)
    {
      const double middle = box.Middle[1 + j];
      const Doubles leastSlope = Load(&aligned.LeastSlope[j][i]);
      const Doubles mostSlope = Load(&aligned.MostSlope[j][i]);
      const Doubles least =
        Load(&aligned.LeastOffset[j][i]) + Min(near * leastSlope, far * leastSlope);
      const Doubles most = Load(&aligned.MostOffset[j][i]) + Max(near * mostSlope, far * mostSlope);
      meets = meets & (least < middle + box.Extent[1 + j]) & (middle - box.Extent[1 + j] < most);
    }
    found |= ToBits(meets) << i;
  }
  return found;
}

/// A margin around cells of a block along an axis: more than all rounding, which is less than 2^-20
/// of the size of a block in single precision.
SIMD_INLINE double GetMargin(const BlockPlace& place, int axis)
{
  return place.Planes[axis] ? Margin + 0x1p-16 * place.Planes[axis]->Extent : Margin;
}

SIMD_INLINE Box FindBox(const std::uint64_t slices[8], const BlockPlace& place)
{
  std::uint64_t any = 0;
  unsigned int occupied = 0;
  for (int slice = 0; slice < 8; ++slice)
  {
    any |= slices[slice];
    occupied |= static_cast<unsigned int>(slices[slice] != 0) << slice;
  }
  std::uint64_t columns = any | any >> 32;
  columns |= columns >> 16;
  columns = (columns | columns >> 8) & 0xFFU;
  const int first[3] = { LowestBit(occupied), LowestBit(columns), LowestBit(any) / 8 };
  const int last[3] = { HighestBit(occupied), HighestBit(columns), HighestBit(any) / 8 };
  Box box;
  for (int i = 0; i < 3; ++i)
  {
    const BlockPlanes* planes = place.Planes[i];
    const double low = planes ? static_cast<double>(planes->Planes[first[i]]) : first[i];
    const double high = planes ? static_cast<double>(planes->Planes[last[i] + 1]) : last[i] + 1;
    box.Middle[i] = place.First[i] + 0.5 * (low + high);
    box.Extent[i] = 0.5 * (high - low) + GetMargin(place, i);
  }
  return box;
}

SIMD_INLINE void CopyPair(const float from[2], float to[2])
{
  std::memcpy(to, from, 2 * sizeof(float));
}

/// Rays that may meet a box, with their segments as in Passages::Segment.
struct NearRays
{
  int Count;
  int Numbers[RayPacket::Capacity + DoubleWidth];
  // Indexed by the numbers of the rays.
  float Middles[RayPacket::Capacity][2];
  float Ends[RayPacket::Capacity][2];
};

/// Finds the rays that may meet the box in a block.
SIMD_INLINE void FindRays(const AlignedRays& aligned, const RaySet& rays, const BlockPlace& place,
  const Box& box, Passages& passages, NearRays& found)
{
  const double plane = box.Middle[0];
  const Doubles lowest = plane - box.Extent[0];
  const Doubles highest = plane + box.Extent[0];
  const Doubles extent = box.Extent[0];
  const Doubles planes = plane;
  const Doubles middlePlanes = place.Middle;
  Doubles firstOf[2];
  Doubles middle[2];
  Doubles reach[2];
  for (int j = 0; j < 2; ++j)
  {
    firstOf[j] = place.First[1 + j];
    middle[j] = box.Middle[1 + j];
    reach[j] = box.Extent[1 + j];
  }
  const Doubles margin = Margin;
  // Ends this near to the block's own do not count.
  const double nearness = 0x1p-23 * (place.Last - place.First[0]);
  const Doubles lastBegin = place.First[0] + nearness;
  const Doubles firstEnd = place.Last - nearness;
  found.Count = 0;
  for (unsigned int subpackets = FindSubpackets(aligned, box); subpackets != 0;
       subpackets &= subpackets - 1)
  {
    const int firstRay = LowestBit(subpackets) * AlignedRays::SubpacketSize;
    for (int i = firstRay; i < firstRay + AlignedRays::SubpacketSize; i += DoubleWidth)
    {
      const Doubles slopeU = Load(&aligned.Slope[0][i]);
      const Doubles slopeV = Load(&aligned.Slope[1][i]);
      const Doubles offsetU = Load(&aligned.Offset[0][i]);
      const Doubles offsetV = Load(&aligned.Offset[1][i]);
      const Doubles low = Load(&aligned.Low[i]);
      const Doubles high = Load(&aligned.High[i]);
      const Doubles u = offsetU + planes * slopeU - middle[0];
      const Doubles v = offsetV + planes * slopeV - middle[1];
      const unsigned int meets = GetLanes(rays, i) &
        ToBits((Abs(u) < reach[0] + extent * Abs(slopeU)) &
          (Abs(v) < reach[1] + extent * Abs(slopeV)) & (low < highest) & (lowest < high));
      if (meets == 0)
      {
        continue;
      }
      StorePairs(offsetU + middlePlanes * slopeU - firstOf[0],
        offsetV + middlePlanes * slopeV - firstOf[1], &found.Middles[i]);
      const Doubles begin = low + margin;
      const Doubles end = high - margin;
      if ((meets & ToBits((lastBegin < begin) | (end < firstEnd))) != 0)
      {
        passages.HasEnds = true;
        StorePairs(begin - middlePlanes, end - middlePlanes, &found.Ends[i]);
      }
      else
      {
        StorePairs(NoEnd[0], NoEnd[1], &found.Ends[i]);
      }
      found.Count += AppendLanes(i, meets, &found.Numbers[found.Count]);
    }
  }
}

/// The cells of a block that a ray may pass, as FindCellsOfRay finds them.
SIMD_INLINE unsigned int FindCells(const BlockPlace& place, const float middle[2],
  const float slope[2], SliceMasks masks, std::uint64_t cells[8])
{
  if (!place.Planes[0])
  {
    return FindCellsOfRay(middle, slope, static_cast<float>(Margin), masks, cells);
  }
  const float* planes[3] = { place.Planes[0]->Planes, place.Planes[1]->Planes,
    place.Planes[2]->Planes };
  const double margin = GetMargin(place, 0) + GetMargin(place, 1) + GetMargin(place, 2);
  return FindCellsBetweenPlanes(middle, slope, static_cast<float>(margin), planes, masks, cells);
}

/// Sets a passage through the next block, but not its cells.
SIMD_INLINE void SetPassage(const float middle[2], const float slope[2], const float ends[2],
  int ray, unsigned int slices, int passage, Passages& passages)
{
  Passages::Segment& segment = passages.Segments[passage];
  CopyPair(middle, segment.Line);
  CopyPair(slope, segment.Line + 2);
  CopyPair(ends, segment.Ends);
  segment.Ray = ray;
  segment.Block = passages.BlockCount;
  passages.Slices[passage] = slices;
  passages.Hits[passage] = false;
}

void FindPassages(const AlignedRays& aligned, const RaySet& rays, int axis, const int first[3],
  const std::uint64_t slices[8], const LatticePlanes* planes, Passages& passages)
{
  if ((slices[0] | slices[1] | slices[2] | slices[3] | slices[4] | slices[5] | slices[6] |
        slices[7]) == 0)
  {
    return;
  }
  NearRays found;
  const BlockPlace place = FindPlace(first, axis, planes);
  FindRays(aligned, rays, place, FindBox(slices, place), passages, found);
  const SliceMasks masks = LoadSlices(slices);
  int count = passages.Count;
  for (int k = 0; k < found.Count; ++k)
  {
    const int ray = found.Numbers[k];
    const unsigned int any =
      FindCells(place, found.Middles[ray], aligned.Slopes[ray], masks, passages.Cells[count]);
    SetPassage(found.Middles[ray], aligned.Slopes[ray], found.Ends[ray], ray, any, count, passages);
    count += any != 0 ? 1 : 0;
  }
  if (count > passages.Count)
  {
    const int order[3] = { axis, AxisU[axis], AxisV[axis] };
    for (int i = 0; i < 3; ++i)
    {
      passages.First[passages.BlockCount][i] = first[i];
      passages.Planes[passages.BlockCount][order[i]] = place.Planes[i];
    }
    ++passages.BlockCount;
  }
  passages.Count = count;
}

/// The slices of eight members that a range meets, which is counted in members from the first; a
/// bit for each.
SIMD_INLINE unsigned int FindSlices(double low, double high)
{
  if (!(low < 8.0 && 0.0 <= high))
  {
    return 0;
  }
  const int first = static_cast<int>(low > 0.0 ? low : 0.0);
  const int last = static_cast<int>(high < 7.0 ? high : 7.0);
  return 0xFFU << first & 0xFFU >> (7 - last);
}

/// Finds members as FindMembersOfRay does, and where the ray is in the middle plane of the block,
/// counted in members from the first.
SIMD_INLINE unsigned int FindMembers(const AlignedRays& aligned, int ray, int axis,
  const int first[3], int edge, const std::uint64_t slices[8], float middle[2],
  std::uint64_t members[8])
{
  const int across[2] = { AxisU[axis], AxisV[axis] };
  const double scale = 1.0 / edge;
  const double low = (aligned.Low[ray] - first[axis]) * scale;
  const double high = (aligned.High[ray] - first[axis]) * scale;
  const double plane = first[axis] + 4.0 * edge;
  for (int j = 0; j < 2; ++j)
  {
    middle[j] = static_cast<float>(
      (aligned.Offset[j][ray] + plane * aligned.Slope[j][ray] - first[across[j]]) * scale);
  }
  return FindSlices(low, high) &
    FindCellsOfRay(
      middle, aligned.Slopes[ray], static_cast<float>(Margin), LoadSlices(slices), members);
}

unsigned int FindMembersOfRay(const AlignedRays& aligned, int ray, int axis, const int first[3],
  int edge, const std::uint64_t slices[8], std::uint64_t members[8])
{
  float middle[2];
  return FindMembers(aligned, ray, axis, first, edge, slices, middle, members);
}

void FindPassage(const AlignedRays& aligned, int ray, int axis, const int first[3],
  const std::uint64_t slices[8], Passages& passages)
{
  const int count = passages.Count;
  float middle[2];
  const unsigned int any =
    FindMembers(aligned, ray, axis, first, 1, slices, middle, passages.Cells[count]);
  if (any == 0)
  {
    return;
  }
  const double plane = first[axis] + 4.0;
  const float ends[2] = { static_cast<float>(aligned.Low[ray] + Margin - plane),
    static_cast<float>(aligned.High[ray] - Margin - plane) };
  passages.HasEnds = passages.HasEnds || -4.0F < ends[0] || ends[1] < 4.0F;
  SetPassage(middle, aligned.Slopes[ray], ends, ray, any, count, passages);
  for (int i = 0; i < 3; ++i)
  {
    passages.First[passages.BlockCount][i] = first[i];
    passages.Planes[passages.BlockCount][i] = nullptr;
  }
  ++passages.BlockCount;
  ++passages.Count;
}

}
}
