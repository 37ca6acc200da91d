// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a block that rays may pass. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The smallest box around the members of a block: along the axis, and the two across.
struct Box
{
  double Middle[3];
  /// Half its size.
  double Extent[3];
};

/// The subpackets that may meet a box, counted from a first cell; a bit for each.
SIMD_INLINE unsigned int FindSubpackets(
  const AlignedRays& aligned, const Box& box, const double first[3])
{
  const double low = first[0] + box.Middle[0] - box.Extent[0];
  const double high = first[0] + box.Middle[0] + box.Extent[0];
  const Doubles near = low < aligned.SweptLow ? aligned.SweptLow : low;
  const Doubles far = high < aligned.SweptHigh ? high : aligned.SweptHigh;
  unsigned int found = 0;
  for (int i = 0; i < AlignedRays::Subpackets; i += DoubleWidth)
  {
    Mask meets = FirstLanes(DoubleWidth);
    for (int j = 0; j < 2; ++j)
    {
      const double middle = first[1 + j] + box.Middle[1 + j];
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

SIMD_INLINE Box FindBox(const std::uint64_t slices[8])
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
  const int first[3] = { __builtin_ctz(occupied), __builtin_ctzll(columns),
    __builtin_ctzll(any) / 8 };
  const int last[3] = { 31 - __builtin_clz(occupied), 63 - __builtin_clzll(columns),
    (63 - __builtin_clzll(any)) / 8 };
  Box box;
  for (int i = 0; i < 3; ++i)
  {
    box.Middle[i] = 0.5 * (first[i] + last[i] + 1);
    box.Extent[i] = 0.5 * (last[i] + 1 - first[i]) + Margin;
  }
  return box;
}

SIMD_INLINE void CopyPair(const float from[2], float to[2])
{
  __builtin_memcpy(to, from, 2 * sizeof(float));
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

/// Finds the rays that may meet the box of a block with its first cell at first.
SIMD_INLINE void FindRays(const AlignedRays& aligned, const RaySet& rays, int axis,
  const int first[3], const Box& box, Passages& passages, NearRays& found)
{
  const double corner[3] = { static_cast<double>(first[axis]),
    static_cast<double>(first[AxisU[axis]]), static_cast<double>(first[AxisV[axis]]) };
  const double plane = corner[0] + box.Middle[0];
  const Doubles lowest = plane - box.Extent[0];
  const Doubles highest = plane + box.Extent[0];
  const Doubles extent = box.Extent[0];
  const Doubles planes = plane;
  const Doubles middlePlanes = corner[0] + 4.0;
  Doubles firstOf[2];
  Doubles middle[2];
  Doubles reach[2];
  for (int j = 0; j < 2; ++j)
  {
    firstOf[j] = corner[1 + j];
    middle[j] = firstOf[j] + box.Middle[1 + j];
    reach[j] = box.Extent[1 + j];
  }
  const Doubles margin = Margin;
  // Ends this near to the block's own do not count.
  const Doubles lastBegin = corner[0] + 0x1p-20;
  const Doubles firstEnd = corner[0] + 8.0 - 0x1p-20;
  found.Count = 0;
  for (unsigned int subpackets = FindSubpackets(aligned, box, corner); subpackets != 0;
       subpackets &= subpackets - 1)
  {
    const int firstRay = __builtin_ctz(subpackets) * AlignedRays::SubpacketSize;
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

void FindPassages(const AlignedRays& aligned, const RaySet& rays, int axis, const int first[3],
  const std::uint64_t slices[8], Passages& passages)
{
  if ((slices[0] | slices[1] | slices[2] | slices[3] | slices[4] | slices[5] | slices[6] |
        slices[7]) == 0)
  {
    return;
  }
  NearRays found;
  FindRays(aligned, rays, axis, first, FindBox(slices), passages, found);
  const SliceMasks masks = LoadSlices(slices);
  int count = passages.Count;
  for (int k = 0; k < found.Count; ++k)
  {
    const int ray = found.Numbers[k];
    const unsigned int any = FindCellsOfRay(found.Middles[ray], aligned.Slopes[ray],
      static_cast<float>(Margin), masks, passages.Cells[count]);
    Passages::Segment& segment = passages.Segments[count];
    CopyPair(found.Middles[ray], segment.Line);
    CopyPair(aligned.Slopes[ray], segment.Line + 2);
    CopyPair(found.Ends[ray], segment.Ends);
    segment.Ray = ray;
    segment.Block = passages.BlockCount;
    passages.Slices[count] = any;
    passages.Hits[count] = false;
    count += any != 0 ? 1 : 0;
  }
  if (count > passages.Count)
  {
    for (int i = 0; i < 3; ++i)
    {
      passages.First[passages.BlockCount][i] = first[i];
    }
    ++passages.BlockCount;
  }
  passages.Count = count;
}

}
}
