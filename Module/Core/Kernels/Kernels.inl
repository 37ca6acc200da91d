// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The kernels, included once for every instruction set. Nothing from another header of the core is
// called here, and nothing of the standard library: the linker keeps one copy of a function that
// several files compile, and might keep the one for a processor that is not there.

#include "Kernels/Kernels.h"
#include "Kernels/Lanes.h"

#include "Kernels/LaneRows.h"

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Infinity = __builtin_inf();
/// By how much, in cells, a ray is taken to be thicker than it is: more than all rounding.
constexpr double Margin = 0x1p-9;
/// Across its axis a beam may go this much per cell along it.
constexpr double LargestSlope = 2.0;

constexpr int AxisU[3] = { 1, 0, 0 };
constexpr int AxisV[3] = { 2, 2, 1 };

LANES_INLINE Doubles Lerp(Doubles a, Doubles b, Doubles t)
{
  return (Broadcast(1.0) - t) * a + t * b;
}

LANES_INLINE Mask IsInside(Doubles valueMinusIsovalue)
{
  return Broadcast(0.0) <= valueMinusIsovalue;
}

LANES_INLINE unsigned int GetLanes(const RaySet& rays, int first)
{
  return static_cast<unsigned int>(rays.Words[first >> 6] >> (first & 63)) &
    ((1U << LaneCount) - 1U);
}

LANES_INLINE int SmallerOf(int a, int b)
{
  return a < b ? a : b;
}

LANES_INLINE int LargerOf(int a, int b)
{
  return a > b ? a : b;
}

LANES_INLINE double SmallestOf(Doubles values)
{
#if defined(LANES_AVX512)
  return _mm512_reduce_min_pd(values.Value);
#elif defined(LANES_AVX2)
  const __m128d two =
    _mm_min_pd(_mm256_castpd256_pd128(values.Value), _mm256_extractf128_pd(values.Value, 1));
  return _mm_cvtsd_f64(_mm_min_sd(two, _mm_unpackhi_pd(two, two)));
#else
  return values.Value[1] < values.Value[0] ? values.Value[1] : values.Value[0];
#endif
}

LANES_INLINE double LargestOf(Doubles values)
{
  return -SmallestOf(Broadcast(0.0) - values);
}

LANES_INLINE Mask LanesOf(unsigned int bits)
{
#if defined(LANES_AVX512)
  return { static_cast<__mmask8>(bits) };
#else
  double lanes[LaneCount];
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    lanes[lane] = static_cast<double>(bits >> lane & 1U);
  }
  return Broadcast(0.0) < Load(lanes);
#endif
}

/// Stores pairs in single precision.
LANES_INLINE void StorePairs(Doubles first, Doubles second, float (*pairs)[2])
{
#if defined(LANES_AVX512)
  const __m512i places = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
  _mm512_storeu_ps(pairs,
    _mm512_permutex2var_ps(_mm512_castps256_ps512(_mm512_cvtpd_ps(first.Value)), places,
      _mm512_castps256_ps512(_mm512_cvtpd_ps(second.Value))));
#else
  double lanes[2][LaneCount];
  Store(first, lanes[0]);
  Store(second, lanes[1]);
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    pairs[lane][0] = static_cast<float>(lanes[0][lane]);
    pairs[lane][1] = static_cast<float>(lanes[1][lane]);
  }
#endif
}

//------------------------------------------------------------------------------
/// Rays on their way to a group; see Ray.
struct Rays
{
  Doubles Origin[3];
  Doubles Direction[3];
  Doubles Inverse[3];
  Mask Up[3];
  Mask Parallel[3];
  Doubles Begin;
  Doubles End;
};

// The same as Camera::GetRay; the rays begin at zero.
LANES_INLINE void MakeUnclippedRays(
  const PixelBlock& block, Doubles column, Doubles row, Doubles depth, Rays& rays)
{
  const double* m = block.IndexFromClip;
  const Doubles half = Broadcast(0.5);
  const Doubles one = Broadcast(1.0);
  const Doubles two = Broadcast(2.0);
  const Doubles x = (column + half) * Broadcast(2.0 / block.Width) - one;
  const Doubles y = (row + half) * Broadcast(2.0 / block.Height) - one;
  const auto transform = [m, x, y](int first)
  { return Broadcast(m[first]) * x + Broadcast(m[first + 1]) * y + Broadcast(m[first + 3]); };
  const Doubles wa = transform(12);
  const Doubles wb = Broadcast(m[14]);
  const Doubles wNear = wa - wb;
  const Doubles inverseNear = one / wNear;
  for (int i = 0; i < 3; ++i)
  {
    const Doubles a = transform(4 * i);
    const Doubles b = Broadcast(m[4 * i + 2]);
    rays.Origin[i] = (a - b) * inverseNear;
    rays.Direction[i] = b * wa - a * wb;
  }
  const Doubles z = two * depth - one;
  const Doubles end = (z + one) / ((wa + z * wb) * wNear);
  rays.Begin = Broadcast(0.0);
  rays.End = Select(Broadcast(0.0) <= end, end, Broadcast(Infinity));
}

// The same as ClipToSlabs of Ray.cxx.
LANES_INLINE Mask ClipToSlabs(Rays& rays, const int dimensions[3])
{
  const Doubles zero = Broadcast(0.0);
  Mask misses = FirstLanes(0);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles last = Broadcast(dimensions[axis] - 1);
    const Doubles origin = rays.Origin[axis];
    const Mask parallel = rays.Parallel[axis];
    misses = misses | AndNot(parallel, (zero <= origin) & (origin <= last));
    const Doubles in = (Select(rays.Up[axis], zero, last) - origin) * rays.Inverse[axis];
    const Doubles out = (Select(rays.Up[axis], last, zero) - origin) * rays.Inverse[axis];
    rays.Begin = Select(parallel, rays.Begin, Larger(rays.Begin, in));
    rays.End = Select(parallel, rays.End, Smaller(rays.End, out));
  }
  return AndNot(rays.Begin <= rays.End, misses);
}

// The same as ClipToVolume of Ray.cxx.
LANES_INLINE Mask ClipToVolume(Rays& rays, const int dimensions[3], Doubles& base)
{
  const Doubles zero = Broadcast(0.0);
  const Doubles infinity = Broadcast(Infinity);
  Mask isFinite = zero < infinity;
  Mask isRay = FirstLanes(0);
  for (int axis = 0; axis < 3; ++axis)
  {
    isFinite = isFinite & (Magnitude(rays.Origin[axis]) < infinity) &
      (Magnitude(rays.Direction[axis]) < infinity);
    rays.Inverse[axis] = Broadcast(1.0) / rays.Direction[axis];
    const Mask moves = Magnitude(rays.Inverse[axis]) < infinity;
    rays.Parallel[axis] = AndNot(zero < infinity, moves);
    rays.Up[axis] = zero < rays.Direction[axis];
    rays.Direction[axis] = Select(moves, rays.Direction[axis], zero);
    isRay = isRay | moves;
  }
  Mask exists = isFinite & isRay;
  const Doubles begin = rays.Begin;
  const Doubles end = rays.End;
  exists = exists & ClipToSlabs(rays, dimensions);
  base = rays.Begin;
  for (int axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = FusedMultiplyAdd(base, rays.Direction[axis], rays.Origin[axis]);
  }
  rays.Begin = begin - base;
  rays.End = end - base;
  exists = exists & ClipToSlabs(rays, dimensions);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles cell = Smaller(Floor(rays.Origin[axis]), Broadcast(dimensions[axis] - 2));
    rays.Inverse[axis] = Select(rays.Parallel[axis], cell, rays.Inverse[axis]);
  }
  return exists;
}

void MakeRays(const PixelBlock& block, RayPacket& group)
{
  double columns[RayPacket::Capacity + LaneCount];
  double rows[RayPacket::Capacity + LaneCount];
  double depths[RayPacket::Capacity + LaneCount];
  int count = 0;
  for (int y = 0; y < block.Rows; ++y)
  {
    for (int x = 0; x < block.Columns; ++x)
    {
      columns[count] = block.Column + x;
      rows[count] = block.Row + y;
      depths[count++] =
        block.Depth ? static_cast<double>(block.Depth[y * block.DepthStride + x]) : 1.0;
    }
  }
  group.Count = count;
  group.Exists.Words[0] = 0;
  group.Exists.Words[1] = 0;
  for (int i = count; i < count + LaneCount; ++i)
  {
    columns[i] = columns[0];
    rows[i] = rows[0];
    depths[i] = depths[0];
  }
  for (int i = 0; i < count; i += LaneCount)
  {
    Rays rays;
    MakeUnclippedRays(block, Load(&columns[i]), Load(&rows[i]), Load(&depths[i]), rays);
    Doubles base;
    const Mask exists =
      ClipToVolume(rays, block.Dimensions, base) & FirstLanes(SmallerOf(count - i, LaneCount));
    group.Exists.Words[i >> 6] |= static_cast<std::uint64_t>(ToBits(exists)) << (i & 63);
    for (int axis = 0; axis < 3; ++axis)
    {
      Store(rays.Origin[axis], &group.Origin[axis][i]);
      Store(rays.Direction[axis], &group.Direction[axis][i]);
      Store(rays.Inverse[axis], &group.Inverse[axis][i]);
    }
    Store(rays.Begin, &group.Begin[i]);
    Store(rays.End, &group.End[i]);
    Store(base, &group.Base[i]);
  }
}

//------------------------------------------------------------------------------
/// Finds what the bunches of a group sweep along one of the axes across.
LANES_INLINE void SweepBunches(RayPacket& group, const RaySet& rays, int j)
{
  const double low = group.SweptLow;
  const double high = group.SweptHigh;
  const double inverse = 1.0 / (high - low);
  for (int bunch = 0; bunch < RayPacket::Bunches; ++bunch)
  {
    const int first = bunch * RayPacket::Bunch;
    // Bunches without rays are nowhere.
    group.LeastOffset[j][bunch] = Infinity;
    group.LeastSlope[j][bunch] = 0.0;
    group.MostOffset[j][bunch] = -Infinity;
    group.MostSlope[j][bunch] = 0.0;
    if ((rays.Words[first >> 6] >> (first & 63) & 0xFFU) == 0)
    {
      continue;
    }
    Doubles least[2] = { Broadcast(Infinity), Broadcast(Infinity) };
    Doubles most[2] = { Broadcast(-Infinity), Broadcast(-Infinity) };
    for (int i = first; i < first + RayPacket::Bunch; i += LaneCount)
    {
      const Mask mask = LanesOf(GetLanes(rays, i));
      const Doubles slope = Load(&group.Slope[j][i]);
      const Doubles offset = Load(&group.Offset[j][i]);
      for (int end = 0; end < 2; ++end)
      {
        const Doubles place = offset + Broadcast(end == 0 ? low : high) * slope;
        least[end] = Select(mask, Smaller(least[end], place), least[end]);
        most[end] = Select(mask, Larger(most[end], place), most[end]);
      }
    }
    const double leastAtLow = SmallestOf(least[0]);
    const double mostAtLow = LargestOf(most[0]);
    group.LeastSlope[j][bunch] = (SmallestOf(least[1]) - leastAtLow) * inverse;
    group.MostSlope[j][bunch] = (LargestOf(most[1]) - mostAtLow) * inverse;
    group.LeastOffset[j][bunch] = leastAtLow - low * group.LeastSlope[j][bunch];
    group.MostOffset[j][bunch] = mostAtLow - low * group.MostSlope[j][bunch];
  }
}

bool Align(RayPacket& group, const RaySet& rays, int axis, Frustum& beam)
{
  const int across[2] = { AxisU[axis], AxisV[axis] };
  const Doubles zero = Broadcast(0.0);
  const Doubles margin = Broadcast(Margin);
  Doubles low = Broadcast(Infinity);
  Doubles high = Broadcast(-Infinity);
  unsigned int up = 0;
  unsigned int down = 0;
  unsigned int steep = 0;
  for (int i = 0; i < group.Count; i += LaneCount)
  {
    const unsigned int lanes = GetLanes(rays, i);
    if (lanes == 0)
    {
      continue;
    }
    const Mask mask = LanesOf(lanes);
    const Doubles direction = Load(&group.Direction[axis][i]);
    const Doubles origin = Load(&group.Origin[axis][i]);
    const Doubles inverse = Load(&group.Inverse[axis][i]);
    const unsigned int upward = ToBits(zero < direction);
    const unsigned int downward = ToBits(direction < zero);
    up |= lanes & upward;
    down |= lanes & downward;
    // Along the axis it must move at all.
    steep |= lanes & ~(upward | downward);
    const Doubles begin = origin + Load(&group.Begin[i]) * direction;
    const Doubles end = origin + Load(&group.End[i]) * direction;
    const Doubles lowest = Smaller(begin, end) - margin;
    const Doubles highest = Larger(begin, end) + margin;
    Store(lowest, &group.Low[i]);
    Store(highest, &group.High[i]);
    low = Select(mask, Smaller(low, lowest), low);
    high = Select(mask, Larger(high, highest), high);
    for (int j = 0; j < 2; ++j)
    {
      const Doubles slope = Load(&group.Direction[across[j]][i]) * inverse;
      const Doubles size = Magnitude(slope);
      // Not less, so that what is no number counts as steep.
      steep |= lanes & ~ToBits(size <= Broadcast(LargestSlope));
      Store(slope, &group.Slope[j][i]);
      Store(Load(&group.Origin[across[j]][i]) - origin * slope, &group.Offset[j][i]);
    }
    StorePairs(Load(&group.Slope[0][i]), Load(&group.Slope[1][i]), &group.Slopes[i]);
  }
  beam.Axis = axis;
  beam.IsUp = up != 0;
  beam.Low = SmallestOf(low);
  beam.High = LargestOf(high);
  if ((up != 0) == (down != 0) || steep != 0)
  {
    return false;
  }
  group.SweptLow = beam.Low;
  group.SweptHigh = beam.High;
  for (int j = 0; j < 2; ++j)
  {
    SweepBunches(group, rays, j);
    // The bunches together.
    const double ends[2] = { beam.Low, beam.High };
    for (int end = 0; end < 2; ++end)
    {
      Doubles least = Broadcast(Infinity);
      Doubles most = Broadcast(-Infinity);
      for (int i = 0; i < RayPacket::Bunches; i += LaneCount)
      {
        const Doubles plane = Broadcast(ends[end]);
        least =
          Smaller(least, Load(&group.LeastOffset[j][i]) + plane * Load(&group.LeastSlope[j][i]));
        most = Larger(most, Load(&group.MostOffset[j][i]) + plane * Load(&group.MostSlope[j][i]));
      }
      beam.Least[j][end] = SmallestOf(least) - Margin;
      beam.Most[j][end] = LargestOf(most) + Margin;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The cells of one ray in a block: slice by slice the rectangle of cells between the places where
// the ray meets the two planes of the slice. The ray is given by its places across the axis in the
// middle plane of the block, counted from the first cell, and its slopes.
#if defined(LANES_AVX512)
// All slices at once: in the lower half of a register for u, in the upper half for v.
LANES_INLINE unsigned int FindCellsOfRay(
  const float middle[2], const float slope[2], __m512i slices, std::uint64_t cells[8])
{
  const __m512 planes = _mm512_set_ps(3.0F, 2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F, 3.0F,
    2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F);
  const __m512 margin = _mm512_set1_ps(static_cast<float>(Margin));
  const auto spread = [](const float pair[2])
  { return _mm512_mask_blend_ps(0xFF00, _mm512_set1_ps(pair[0]), _mm512_set1_ps(pair[1])); };
  const __m512 slopes = spread(slope);
  const __m512 near = _mm512_fmadd_ps(planes, slopes, spread(middle));
  const __m512 far = _mm512_add_ps(near, slopes);
  const __m512 least = _mm512_sub_ps(_mm512_min_ps(near, far), margin);
  const __m512 most = _mm512_add_ps(_mm512_max_ps(near, far), margin);
  const __m512i seven = _mm512_set1_epi32(7);
  const __m512i low = _mm512_max_epi32(_mm512_cvttps_epi32(least), _mm512_setzero_si512());
  const __m512i high = _mm512_sub_epi32(seven,
    _mm512_min_epi32(
      _mm512_cvt_roundps_epi32(most, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC), seven));

  const __m512i byte = _mm512_set1_epi32(0xFF);
  const __m512i bits = _mm512_ternarylogic_epi32(
    _mm512_sllv_epi32(byte, low), _mm512_srlv_epi32(byte, high), byte, 0x80);
  const __m512i columns = _mm512_shuffle_epi8(_mm512_cvtepu32_epi64(_mm512_castsi512_si256(bits)),
    _mm512_set4_epi32(0x08080808, 0x08080808, 0x00000000, 0x00000000));
  const __m128i rowBits = _mm256_cvtepi32_epi8(_mm512_extracti64x4_epi64(bits, 1));
  const __mmask64 rows = static_cast<__mmask64>(_mm_cvtsi128_si64(rowBits));
  const __m512i found = _mm512_maskz_mov_epi8(rows, _mm512_and_si512(slices, columns));
  _mm512_storeu_si512(cells, found);
  return _mm512_test_epi64_mask(found, found);
}
#elif defined(LANES_AVX2)
/// The cells between the places of a ray across, one bit for each, in eight slices.
LANES_INLINE __m256i FindRow(float middle, float slope)
{
  const __m256 planes = _mm256_set_ps(3.0F, 2.0F, 1.0F, 0.0F, -1.0F, -2.0F, -3.0F, -4.0F);
  const __m256 margin = _mm256_set1_ps(static_cast<float>(Margin));
  const __m256 slopes = _mm256_set1_ps(slope);
  const __m256 near = _mm256_add_ps(_mm256_set1_ps(middle), _mm256_mul_ps(planes, slopes));
  const __m256 far = _mm256_add_ps(near, slopes);
  const __m256 least = _mm256_sub_ps(_mm256_min_ps(near, far), margin);
  const __m256 most = _mm256_add_ps(_mm256_max_ps(near, far), margin);
  const __m256i seven = _mm256_set1_epi32(7);
  const __m256i low = _mm256_max_epi32(_mm256_cvttps_epi32(least), _mm256_setzero_si256());
  const __m256i high =
    _mm256_sub_epi32(seven, _mm256_min_epi32(_mm256_cvttps_epi32(_mm256_floor_ps(most)), seven));
  const __m256i byte = _mm256_set1_epi32(0xFF);
  return _mm256_and_si256(
    byte, _mm256_and_si256(_mm256_sllv_epi32(byte, low), _mm256_srlv_epi32(byte, high)));
}

/// Those of four slices that are in a row of columns, a column of rows, and the slices.
LANES_INLINE unsigned int FindCellsOfSlices(
  __m128i columns, __m128i rows, const std::uint64_t slices[4], std::uint64_t cells[4])
{
  const __m256i firstBytes = _mm256_set_epi64x(0x0808080808080808, 0, 0x0808080808080808, 0);
  const __m256i bits = _mm256_set1_epi64x(static_cast<long long>(0x8040201008040201U));
  const auto spread = [firstBytes](__m128i words)
  { return _mm256_shuffle_epi8(_mm256_cvtepu32_epi64(words), firstBytes); };
  const __m256i inRows = _mm256_cmpeq_epi8(_mm256_and_si256(spread(rows), bits), bits);
  const __m256i found = _mm256_and_si256(_mm256_and_si256(inRows, spread(columns)),
    _mm256_loadu_si256(reinterpret_cast<const __m256i*>(slices)));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(cells), found);
  const __m256i none = _mm256_cmpeq_epi64(found, _mm256_setzero_si256());
  return 15U ^ static_cast<unsigned int>(_mm256_movemask_pd(_mm256_castsi256_pd(none)));
}

LANES_INLINE unsigned int FindCellsOfRay(const float middle[2], const float slope[2],
  const std::uint64_t slices[8], std::uint64_t cells[8])
{
  const __m256i columns = FindRow(middle[0], slope[0]);
  const __m256i rows = FindRow(middle[1], slope[1]);
  const unsigned int first =
    FindCellsOfSlices(_mm256_castsi256_si128(columns), _mm256_castsi256_si128(rows), slices, cells);
  return first |
    FindCellsOfSlices(_mm256_extracti128_si256(columns, 1), _mm256_extracti128_si256(rows, 1),
      slices + 4, cells + 4)
    << 4;
}
#else
LANES_INLINE unsigned int FindCellsOfRay(const float middle[2], const float slope[2],
  const std::uint64_t slices[8], std::uint64_t cells[8])
{
  unsigned int any = 0;
  for (int slice = 0; slice < 8; ++slice)
  {
    cells[slice] = 0;
    if (slices[slice] == 0)
    {
      continue;
    }
    int low[2];
    int high[2];
    for (int j = 0; j < 2; ++j)
    {
      const float near = middle[j] + static_cast<float>(slice - 4) * slope[j];
      const float far = near + slope[j];
      const float least = (near < far ? near : far) - static_cast<float>(Margin);
      const float most = (near < far ? far : near) + static_cast<float>(Margin);
      low[j] = least > 0.0F ? static_cast<int>(least) : 0;
      high[j] = most < 0.0F ? -1 : (most < 8.0F ? static_cast<int>(most) : 7);
    }
    if (low[0] <= high[0] && low[1] <= high[1] && low[0] < 8 && low[1] < 8)
    {
      const std::uint64_t columns = (0xFFU << low[0] & 0xFFU & 0xFFU >> (7 - high[0]));
      const std::uint64_t rows =
        (~std::uint64_t{ 0 } << (8 * low[1])) & (~std::uint64_t{ 0 } >> (8 * (7 - high[1])));
      cells[slice] = slices[slice] & rows & (columns * 0x0101010101010101U);
      any |= static_cast<unsigned int>(cells[slice] != 0) << slice;
    }
  }
  return any;
}
#endif

/// The smallest box around the members of a block: along the axis, and the two across.
struct Box
{
  double Middle[3];
  /// Half its size.
  double Extent[3];
};

/// The bunches of rays that may come into a box, counted from a first cell; a bit for each.
LANES_INLINE unsigned int FindBunches(const RayPacket& group, const Box& box, const double first[3])
{
  const double low = first[0] + box.Middle[0] - box.Extent[0];
  const double high = first[0] + box.Middle[0] + box.Extent[0];
  const Doubles near = Broadcast(low < group.SweptLow ? group.SweptLow : low);
  const Doubles far = Broadcast(high < group.SweptHigh ? high : group.SweptHigh);
  unsigned int found = 0;
  for (int i = 0; i < RayPacket::Bunches; i += LaneCount)
  {
    Mask meets = FirstLanes(LaneCount);
    for (int j = 0; j < 2; ++j)
    {
      const double middle = first[1 + j] + box.Middle[1 + j];
      const Doubles leastSlope = Load(&group.LeastSlope[j][i]);
      const Doubles mostSlope = Load(&group.MostSlope[j][i]);
      const Doubles least =
        Load(&group.LeastOffset[j][i]) + Smaller(near * leastSlope, far * leastSlope);
      const Doubles most =
        Load(&group.MostOffset[j][i]) + Larger(near * mostSlope, far * mostSlope);
      meets = meets & (least < Broadcast(middle + box.Extent[1 + j])) &
        (Broadcast(middle - box.Extent[1 + j]) < most);
    }
    found |= ToBits(meets) << i;
  }
  return found;
}

LANES_INLINE Box FindBox(const std::uint64_t slices[8])
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

/// Planes beyond a block, counted from its middle.
constexpr float NoEnd[2] = { -8.0F, 8.0F };

/// Appends the numbers of some lanes, counted from the first. There must be room for a vector.
LANES_INLINE int AppendLanes(int first, unsigned int lanes, int* numbers)
{
#if defined(LANES_AVX512)
  const __m256i all =
    _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(numbers),
    _mm256_maskz_compress_epi32(static_cast<__mmask8>(lanes), all));
  return __builtin_popcount(lanes);
#else
  int count = 0;
  for (int lane = 0; lane < LaneCount; ++lane)
  {
    numbers[count] = first + lane;
    count += static_cast<int>(lanes >> lane & 1U);
  }
  return count;
#endif
}

LANES_INLINE void CopyPair(const float from[2], float to[2])
{
  __builtin_memcpy(to, from, 2 * sizeof(float));
}

void FindPassages(const RayPacket& group, const RaySet& rays, int axis, const int first[3],
  const std::uint64_t slices[8], Passages& passages)
{
  if ((slices[0] | slices[1] | slices[2] | slices[3] | slices[4] | slices[5] | slices[6] |
        slices[7]) == 0)
  {
    return;
  }
  const Box box = FindBox(slices);
  const double plane = first[axis] + box.Middle[0];
  const Doubles lowest = Broadcast(plane - box.Extent[0]);
  const Doubles highest = Broadcast(plane + box.Extent[0]);
  const Doubles extent = Broadcast(box.Extent[0]);
  const Doubles planes = Broadcast(plane);
  const Doubles middlePlanes = Broadcast(first[axis] + 4.0);
  Doubles firstOf[2];
  Doubles middle[2];
  Doubles reach[2];
  for (int j = 0; j < 2; ++j)
  {
    firstOf[j] = Broadcast(first[j == 0 ? AxisU[axis] : AxisV[axis]]);
    middle[j] = firstOf[j] + Broadcast(box.Middle[1 + j]);
    reach[j] = Broadcast(box.Extent[1 + j]);
  }
#if defined(LANES_AVX512)
  const __m512i mask = _mm512_loadu_si512(slices);
#else
  const std::uint64_t* mask = slices;
#endif
  const double corner[3] = { static_cast<double>(first[axis]),
    static_cast<double>(first[AxisU[axis]]), static_cast<double>(first[AxisV[axis]]) };
  const Doubles margin = Broadcast(Margin);
  // Ends so near to the block's own are none.
  const Doubles lastBegin = Broadcast(first[axis] + 0x1p-20);
  const Doubles firstEnd = Broadcast(first[axis] + 8 - 0x1p-20);
  float middles[RayPacket::Capacity][2];
  float ends[RayPacket::Capacity][2];
  int found[RayPacket::Capacity + LaneCount];
  int foundCount = 0;
  for (unsigned int bunches = FindBunches(group, box, corner); bunches != 0; bunches &= bunches - 1)
  {
    const int bunch = __builtin_ctz(bunches) * RayPacket::Bunch;
    for (int i = bunch; i < bunch + RayPacket::Bunch; i += LaneCount)
    {
      const Doubles slopeU = Load(&group.Slope[0][i]);
      const Doubles slopeV = Load(&group.Slope[1][i]);
      const Doubles offsetU = Load(&group.Offset[0][i]);
      const Doubles offsetV = Load(&group.Offset[1][i]);
      const Doubles low = Load(&group.Low[i]);
      const Doubles high = Load(&group.High[i]);
      const Doubles u = offsetU + planes * slopeU - middle[0];
      const Doubles v = offsetV + planes * slopeV - middle[1];
      const unsigned int meets = GetLanes(rays, i) &
        ToBits((Magnitude(u) < reach[0] + extent * Magnitude(slopeU)) &
          (Magnitude(v) < reach[1] + extent * Magnitude(slopeV)) & (low < highest) &
          (lowest < high));
      if (meets == 0)
      {
        continue;
      }
      StorePairs(offsetU + middlePlanes * slopeU - firstOf[0],
        offsetV + middlePlanes * slopeV - firstOf[1], &middles[i]);
      const Doubles begin = low + margin;
      const Doubles end = high - margin;
      if ((meets & ToBits((lastBegin < begin) | (end < firstEnd))) != 0)
      {
        passages.HasEnds = true;
        StorePairs(begin - middlePlanes, end - middlePlanes, &ends[i]);
      }
      else
      {
        StorePairs(Broadcast(NoEnd[0]), Broadcast(NoEnd[1]), &ends[i]);
      }
      foundCount += AppendLanes(i, meets, &found[foundCount]);
    }
  }
  int count = passages.Count;
  for (int k = 0; k < foundCount; ++k)
  {
    const int ray = found[k];
    const unsigned int any =
      FindCellsOfRay(middles[ray], group.Slopes[ray], mask, passages.Cells[count]);
    Passages::Way& way = passages.Ways[count];
    CopyPair(middles[ray], way.Line);
    CopyPair(group.Slopes[ray], way.Line + 2);
    CopyPair(ends[ray], way.Ends);
    way.Ray = ray;
    way.Block = passages.BlockCount;
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

//------------------------------------------------------------------------------
/// Passed cells, each with the way of the ray: as in Passages::Way, but counted from the corner of
/// the cell across.
struct RoughCells
{
  /// The lower plane of the cell, from the middle plane of the block.
  Floats Plane;
  Floats Crossing[2];
  Floats Slope[2];
  Floats Ends[2];
};

LANES_INLINE RoughCells LoadRoughCells(const Passages& passages, const unsigned int* codes)
{
  const float* lines[FloatCount];
  for (int lane = 0; lane < FloatCount; ++lane)
  {
    lines[lane] = passages.Ways[codes[lane] & 0xFFFFU].Line;
  }
  Floats line[4];
  LoadFours(lines, line);
  RoughCells cells;
  cells.Plane = GetBits(codes, 16, 7U) - BroadcastFloat(4.0F);
  cells.Crossing[0] = line[0] - GetBits(codes, 24, 7U);
  cells.Crossing[1] = line[1] - GetBits(codes, 27, 7U);
  cells.Slope[0] = line[2];
  cells.Slope[1] = line[3];
  cells.Ends[0] = BroadcastFloat(NoEnd[0]);
  cells.Ends[1] = BroadcastFloat(NoEnd[1]);
  if (passages.HasEnds)
  {
    float ends[2][FloatCount];
    for (int lane = 0; lane < FloatCount; ++lane)
    {
      const Passages::Way& way = passages.Ways[codes[lane] & 0xFFFFU];
      ends[0][lane] = way.Ends[0];
      ends[1][lane] = way.Ends[1];
    }
    cells.Ends[0] = LoadFloats(ends[0]);
    cells.Ends[1] = LoadFloats(ends[1]);
  }
  return cells;
}

LANES_INLINE Floats Lerp(Floats a, Floats difference, Floats t)
{
  return MultiplyAdd(difference, t, a);
}

/// What single precision can tell of the part of rays in cells.
struct Classification
{
  FloatMask Misses;
  FloatMask Hits;
};

/// The planes between which rays are in cells, taken a little too wide; by how much the ends may
/// be off, and whether there is surely something between them.
struct RoughSegments
{
  Floats Low;
  Floats High;
  Floats Error;
  FloatMask Exist;
};

/// More than single precision may be off by, in cells: of a place in a block and of a plane.
constexpr float PlaceError = 0x1p-18F;

LANES_INLINE RoughSegments FindRoughSegments(const RoughCells& cells)
{
  const Floats one = BroadcastFloat(1.0F);
  const Floats error = BroadcastFloat(PlaceError);
  Floats low = Larger(cells.Plane, cells.Ends[0] - error);
  Floats surelyLow = Larger(cells.Plane, cells.Ends[0] + error);
  Floats high = Smaller(cells.Plane + one, cells.Ends[1] + error);
  Floats surelyHigh = Smaller(cells.Plane + one, cells.Ends[1] - error);
  for (int j = 0; j < 2; ++j)
  {
    // Of a slope that is nearly or really none, a large reciprocal will do.
    const Floats inverse = RoughReciprocal(
      CopySign(Larger(Magnitude(cells.Slope[j]), BroadcastFloat(0x1p-60F)), cells.Slope[j]));
    const Floats first = (BroadcastFloat(0.0F) - cells.Crossing[j]) * inverse;
    const Floats second = (one - cells.Crossing[j]) * inverse;
    const Floats off = MultiplyAdd(error, Magnitude(inverse), error);
    const Floats in = Smaller(first, second);
    const Floats out = Larger(first, second);
    low = Larger(low, in - off);
    surelyLow = Larger(surelyLow, in + off);
    high = Smaller(high, out + off);
    surelyHigh = Smaller(surelyHigh, out - off);
  }
  RoughSegments result;
  result.Low = low;
  result.High = high;
  result.Error = Larger(surelyLow - low, high - surelyHigh);
  result.Exist = surelyLow + error < surelyHigh;
  return result;
}

/// Looks at the cubics along rays in cells, of values less the isovalue; largest is the largest
/// size of each cell's. All that single precision gets wrong is less than 2^-16 of it, and what is
/// wrong with the isovalue.
LANES_INLINE Classification Classify(const Floats v[8], Floats largest, Floats isovalueError,
  const int order[3], const RoughCells& cells, const RoughSegments& segments)
{
  // The places in the cell at both ends of the segment.
  Floats p[3];
  Floats q[3];
  p[order[0]] = segments.Low - cells.Plane;
  q[order[0]] = segments.High - cells.Plane;
  for (int j = 0; j < 2; ++j)
  {
    p[order[1 + j]] = MultiplyAdd(segments.Low, cells.Slope[j], cells.Crossing[j]);
    q[order[1 + j]] = MultiplyAdd(segments.High, cells.Slope[j], cells.Crossing[j]);
  }
  Floats x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    const Floats difference = v[2 * i + 1] - v[2 * i];
    x[0][i] = Lerp(v[2 * i], difference, p[0]);
    x[1][i] = Lerp(v[2 * i], difference, q[0]);
  }
  Floats b[2][2][2];
  for (int i = 0; i < 2; ++i)
  {
    Floats xy[2][2];
    for (int z = 0; z < 2; ++z)
    {
      const Floats difference = x[i][2 * z + 1] - x[i][2 * z];
      xy[0][z] = Lerp(x[i][2 * z], difference, p[1]);
      xy[1][z] = Lerp(x[i][2 * z], difference, q[1]);
    }
    for (int j = 0; j < 2; ++j)
    {
      const Floats difference = xy[j][1] - xy[j][0];
      b[i][j][0] = Lerp(xy[j][0], difference, p[2]);
      b[i][j][1] = Lerp(xy[j][0], difference, q[2]);
    }
  }
  const Floats begin = b[0][0][0];
  const Floats end = b[1][1][1];
  const Floats once = b[1][0][0] + b[0][1][0] + b[0][0][1];
  const Floats twice = b[1][1][0] + b[1][0][1] + b[0][1][1];
  // Where values are so large that differences overflow, the square does too, and nothing is told.
  const Floats part = largest * BroadcastFloat(0x1p-36F);
  const Floats error =
    MultiplyAdd(part, part, MultiplyAdd(largest, BroadcastFloat(0x1p-15F), isovalueError));
  // A value changes by at most twice the largest size for a cell along each axis, and a ray goes at
  // most two cells across for one along.
  const Floats errorOfEnds = MultiplyAdd(largest * segments.Error, BroadcastFloat(10.0F), error);
  const Floats nearer = Smaller(Magnitude(begin), Magnitude(end));
  const Floats third = BroadcastFloat(1.0F / 3.0F);
  const Floats nearest = Smaller(nearer, Smaller(Magnitude(once), Magnitude(twice)) * third);
  const FloatMask changes = HaveOtherSigns(begin, end);
  const FloatMask mayChange = changes | HaveOtherSigns(begin, once) | HaveOtherSigns(begin, twice);
  Classification result;
  result.Misses = AndNot(error < nearest, mayChange) | (segments.High < segments.Low);
  result.Hits = segments.Exist & changes & (errorOfEnds < nearer);
  return result;
}

/// The corners of cells in single precision, less the isovalue. Returns the largest size.
template <typename T>
LANES_INLINE Floats LoadRoughDifferences(
  const void* const* first, const std::ptrdiff_t strides[3], Floats isovalue, Floats values[8])
{
  Floats largest = BroadcastFloat(0.0F);
  for (int row = 0; row < 4; ++row)
  {
    Floats* pair = &values[2 * row];
    LoadRoughPair<T>(first, row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
    for (int x = 0; x < 2; ++x)
    {
      pair[x] = pair[x] - isovalue;
      largest = LargerSize(largest, pair[x]);
    }
  }
  return largest;
}

template <typename T>
void ClassifyCells(const PassedCells& cells, int axis, const std::ptrdiff_t strides[3],
  const ScaledIsovalue& isovalue, Passages& passages, Candidates& candidates, RaySet& hits)
{
  // In other magnitudes nothing is told.
  const float least = isovalue.Scale == 1.0 ? 0x1p-100F : __builtin_inff();
  const auto rounded = static_cast<float>(isovalue.Isovalue);
  const Floats isovalueError =
    BroadcastFloat(least + 0x1p-22F * (rounded < 0.0F ? -rounded : rounded));
  // The order of the axis and those across, in that of the corners.
  const int order[3] = { axis, AxisU[axis], AxisV[axis] };
  for (int i = 0; i < cells.Count; i += FloatCount)
  {
    const RoughCells rough = LoadRoughCells(passages, &cells.Codes[i]);
    const RoughSegments segments = FindRoughSegments(rough);
    Floats values[8];
    const Floats largest =
      LoadRoughDifferences<T>(&cells.First[i], strides, BroadcastFloat(rounded), values);
    const Classification sieve = Classify(values, largest, isovalueError, order, rough, segments);
    const unsigned int lanes = (1U << SmallerOf(cells.Count - i, FloatCount)) - 1U;
    const unsigned int sure = ToBits(sieve.Hits);
    for (unsigned int left = lanes & ~ToBits(sieve.Misses); left != 0; left &= left - 1)
    {
      const int lane = __builtin_ctz(left);
      const unsigned int code = cells.Codes[i + lane];
      const unsigned int passage = code & 0xFFFFU;
      const unsigned int bit = code >> 24;
      const Passages::Way& way = passages.Ways[passage];
      const int* first = passages.First[way.Block];
      const int place = candidates.Count++;
      candidates.Ray[place] = way.Ray;
      candidates.Cell[order[0]][place] = first[order[0]] + static_cast<int>(code >> 16 & 0xFFU);
      candidates.Cell[order[1]][place] = first[order[1]] + static_cast<int>(bit & 7U);
      candidates.Cell[order[2]][place] = first[order[2]] + static_cast<int>(bit >> 3);
      candidates.First[place] = cells.First[i + lane];
      const unsigned int isSure = sure >> lane & 1U;
      passages.Hits[passage] = passages.Hits[passage] || isSure != 0;
      hits.Words[way.Ray >> 6] |= static_cast<std::uint64_t>(isSure) << (way.Ray & 63);
    }
  }
}

//------------------------------------------------------------------------------
template <typename T>
void LoadCorners(const std::ptrdiff_t strides[3], Candidates& candidates)
{
  for (int i = 0; i < candidates.Count; i += LaneCount)
  {
    for (int row = 0; row < 4; ++row)
    {
      Doubles pair[2];
      LoadRow<T, 2>(&candidates.First[i], SmallerOf(candidates.Count - i, LaneCount),
        row % 2 * strides[1] + row / 2 * strides[2], strides[0], pair);
      Store(pair[0], &candidates.Corners[2 * row][i]);
      Store(pair[1], &candidates.Corners[2 * row + 1][i]);
    }
  }
}

//------------------------------------------------------------------------------
// The same as Difference of TracedVolume.cxx, for the corners of cells.
LANES_INLINE void FindDifferences(
  const Candidates& candidates, int first, const ScaledIsovalue& isovalue, Doubles values[8])
{
  constexpr double smallest = 0x1p-900;
  const Doubles scaled = Broadcast(isovalue.Isovalue * isovalue.Scale);
  Doubles least = Broadcast(Infinity);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Doubles value = Load(&candidates.Corners[corner][first]);
    values[corner] = (isovalue.Scale == 1.0 ? value : value * Broadcast(isovalue.Scale)) - scaled;
    least = Smaller(least, Magnitude(values[corner]));
  }
  if (!Any(least < Broadcast(smallest)))
  {
    return;
  }
  const Doubles iso = Broadcast(isovalue.Isovalue);
  for (int corner = 0; corner < 8; ++corner)
  {
    const Doubles value = Load(&candidates.Corners[corner][first]);
    const Doubles sign = Select(
      value < iso, Broadcast(-smallest), Select(iso < value, Broadcast(smallest), Broadcast(0.0)));
    values[corner] = Select(Magnitude(values[corner]) < Broadcast(smallest), sign, values[corner]);
  }
}

/// The part of rays in cells, as CellSegment has it. Axes are 0.0, 1.0, 2.0; 3.0 where a ray begins
/// or ends within the cell.
struct Segments
{
  Mask Exists;
  Doubles Begin;
  Doubles BeginAxis;
  Doubles End;
  Doubles Entry[3];
  Doubles Exit[3];
};

// The same as SegmentInCell of CellSegment.h, for rays whose Begin and End are finite.
LANES_INLINE Segments FindSegments(const RayPacket& group, const int* rays, const Doubles cell[3])
{
  const Doubles zero = Broadcast(0.0);
  const Doubles one = Broadcast(1.0);
  const Doubles startAxis = Broadcast(3.0);
  Doubles origin[3];
  Doubles direction[3];
  Mask up[3];
  Doubles entry = Broadcast(-Infinity);
  Doubles entryAxis = zero;
  Doubles exit = Broadcast(Infinity);
  Doubles exitAxis = startAxis;
  Mask staysOutside = FirstLanes(0);
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = Gather(group.Origin[axis], rays);
    direction[axis] = Gather(group.Direction[axis], rays);
    const Doubles inverse = Gather(group.Inverse[axis], rays);
    up[axis] = zero < direction[axis];
    const Mask moves = up[axis] | (direction[axis] < zero);
    const Doubles next = cell[axis] + one;
    const Doubles in = (Select(up[axis], cell[axis], next) - origin[axis]) * inverse;
    const Doubles out = (Select(up[axis], next, cell[axis]) - origin[axis]) * inverse;
    staysOutside = staysOutside | AndNot((inverse < cell[axis]) | (cell[axis] < inverse), moves);
    const Doubles axes = Broadcast(axis);
    const Mask later = moves & (entry <= in);
    entry = Select(later, in, entry);
    entryAxis = Select(later, axes, entryAxis);
    const Mask sooner = moves & (out < exit);
    exit = Select(sooner, out, exit);
    exitAxis = Select(sooner, axes, exitAxis);
  }
  const Doubles rayBegin = Gather(group.Begin, rays);
  const Doubles rayEnd = Gather(group.End, rays);
  const Mask enters = rayBegin <= entry;
  const Mask leaves = exit <= rayEnd;
  Segments result;
  result.Begin = Select(enters, entry, rayBegin);
  result.BeginAxis = Select(enters, entryAxis, startAxis);
  result.End = Select(leaves, exit, rayEnd);
  const Doubles endAxis = Select(leaves, exitAxis, startAxis);
  result.Exists =
    ((result.Begin < result.End) | ((result.Begin == result.End) & (result.BeginAxis < endAxis))) &
    (rayBegin < exit) & (entry < rayEnd);
  result.Exists = AndNot(result.Exists, staysOutside);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Doubles begin = origin[axis] + result.Begin * direction[axis] - cell[axis];
    const Doubles end = origin[axis] + result.End * direction[axis] - cell[axis];
    const Doubles beginInside = Smaller(one, Larger(zero, begin));
    const Doubles endInside = Smaller(one, Larger(zero, end));
    const Doubles axes = Broadcast(axis);
    result.Entry[axis] = Select(result.BeginAxis == axes, Select(up[axis], zero, one), beginInside);
    result.Exit[axis] = Select(endAxis == axes, Select(up[axis], one, zero), endInside);
  }
  return result;
}

// The same as CubicAlongSegment of TrilinearCell.h.
LANES_INLINE void FindCubics(
  const Doubles v[8], const Doubles p[3], const Doubles q[3], Doubles b[4])
{
  Doubles x[2][4];
  for (int i = 0; i < 4; ++i)
  {
    x[0][i] = Lerp(v[2 * i], v[2 * i + 1], p[0]);
    x[1][i] = Lerp(v[2 * i], v[2 * i + 1], q[0]);
  }
  Doubles xy[2][2][2];
  for (int i = 0; i < 2; ++i)
  {
    for (int z = 0; z < 2; ++z)
    {
      xy[i][0][z] = Lerp(x[i][2 * z], x[i][2 * z + 1], p[1]);
      xy[i][1][z] = Lerp(x[i][2 * z], x[i][2 * z + 1], q[1]);
    }
  }
  const auto blossom = [&xy, p, q](int fromX, int fromY, int fromZ)
  { return Lerp(xy[fromX][fromY][0], xy[fromX][fromY][1], fromZ == 0 ? p[2] : q[2]); };
  const Doubles once = blossom(1, 0, 0) + blossom(0, 1, 0) + blossom(0, 0, 1);
  const Doubles twice = blossom(1, 1, 0) + blossom(1, 0, 1) + blossom(0, 1, 1);
  const Doubles third = Broadcast(1.0 / 3.0);
  b[0] = blossom(0, 0, 0);
  b[1] = once * third;
  b[2] = twice * third;
  b[3] = blossom(1, 1, 1);
}

// The same as Robust::Evaluate.
LANES_INLINE Doubles Evaluate(const Doubles b[4], Doubles u)
{
  const Doubles b01 = Lerp(b[0], b[1], u);
  const Doubles b12 = Lerp(b[1], b[2], u);
  const Doubles b23 = Lerp(b[2], b[3], u);
  return Lerp(Lerp(b01, b12, u), Lerp(b12, b23, u), u);
}

/// A piece of the interval on which a cubic is monotone and changes its sign.
struct Brackets
{
  Mask Exists;
  Doubles Low;
  Doubles High;
  Doubles AtLow;
  Doubles AtHigh;
};

// The same as Robust::Extrema and ForEachSignChange, up to the first change.
LANES_INLINE Brackets FindFirstSignChange(const Doubles b[4])
{
  const Doubles zero = Broadcast(0.0);
  const Doubles one = Broadcast(1.0);
  const Doubles d0 = b[1] - b[0];
  const Doubles d1 = b[2] - b[1];
  const Doubles d2 = b[3] - b[2];
  const Mask monotone =
    ((zero <= d0) & (zero <= d1) & (zero <= d2)) | ((d0 <= zero) & (d1 <= zero) & (d2 <= zero));
  const Doubles a = (d2 - d1) - (d1 - d0);
  const Doubles h = d1 - d0;
  const Doubles discriminant = h * h - a * d0;
  const Mask turns = AndNot(zero < discriminant, monotone);

  Brackets result = { FirstLanes(0), zero, one, b[0], b[3] };
  if (Any(turns))
  {
    const Doubles w = zero - (h + CopySign(SquareRoot(Select(turns, discriminant, zero)), h));
    const Doubles r0 = w / a;
    const Doubles r1 = d0 / w;
    for (int i = 0; i < 2; ++i)
    {
      const Doubles turn = i == 0 ? Smaller(r0, r1) : Larger(r0, r1);
      const Mask isTurn = AndNot(turns & (zero < turn) & (turn < one), result.Exists);
      const Doubles value = Evaluate(b, turn);
      const Mask changes = isTurn & (IsInside(value) ^ IsInside(result.AtLow));
      result.High = Select(changes, turn, result.High);
      result.AtHigh = Select(changes, value, result.AtHigh);
      result.Exists = result.Exists | changes;
      const Mask passes = AndNot(isTurn, changes);
      result.Low = Select(passes, turn, result.Low);
      result.AtLow = Select(passes, value, result.AtLow);
    }
  }
  result.Exists = result.Exists | (IsInside(result.AtHigh) ^ IsInside(result.AtLow));
  return result;
}

//------------------------------------------------------------------------------
// The same as Robust::RefineRoot, for two vectors at a time: each step waits for the one before,
// and the other vector fills the wait.
LANES_INLINE void RefineRoots(const Doubles (*b)[4], const Brackets* brackets, Doubles* u)
{
  constexpr double tolerance = 1e-10;
  constexpr int newtonIterations = 40;
  constexpr int maximumIterations = newtonIterations + 36;
  const Doubles three = Broadcast(3.0);
  Doubles c1[2];
  Doubles c2[2];
  Doubles c3[2];
  Doubles low[2];
  Doubles high[2];
  Mask going[2];
  for (int j = 0; j < 2; ++j)
  {
    c1[j] = three * (b[j][1] - b[j][0]);
    c2[j] = three * ((b[j][2] - b[j][1]) - (b[j][1] - b[j][0]));
    c3[j] = (b[j][3] - b[j][0]) - three * (b[j][2] - b[j][1]);
    low[j] = brackets[j].Low;
    high[j] = brackets[j].High;
    u[j] = Smaller(high[j],
      low[j] + (high[j] - low[j]) * (brackets[j].AtLow / (brackets[j].AtLow - brackets[j].AtHigh)));
    going[j] = brackets[j].Exists;
  }
  for (int i = 0; i < maximumIterations && Any(going[0] | going[1]); ++i)
  {
    for (int j = 0; j < 2; ++j)
    {
      const Doubles f = ((c3[j] * u[j] + c2[j]) * u[j] + c1[j]) * u[j] + b[j][0];
      const Mask isBeyond = IsInside(f) ^ IsInside(brackets[j].AtLow);
      low[j] = Select(isBeyond, low[j], u[j]);
      high[j] = Select(isBeyond, u[j], high[j]);
      const Doubles slope = (three * c3[j] * u[j] + Broadcast(2.0) * c2[j]) * u[j] + c1[j];
      Doubles next = u[j] - f / slope;
      const Mask isBetween = (low[j] <= next) & (next <= high[j]);
      const Doubles half = low[j] + Broadcast(0.5) * (high[j] - low[j]);
      next = Select(i < newtonIterations ? isBetween : FirstLanes(0), next, half);
      const Mask done = Magnitude(next - u[j]) <= Broadcast(tolerance);
      u[j] = Select(going[j], next, u[j]);
      going[j] = AndNot(going[j], done);
    }
  }
}

LANES_INLINE void SetBits(unsigned int bits, int first, std::uint64_t* words)
{
  words[first >> 6] |= static_cast<std::uint64_t>(bits) << (first & 63);
}

void Solve(const RayPacket& group, const Candidates& candidates, const ScaledIsovalue& isovalue,
  Solutions& solutions)
{
  for (int i = 0; i < Solutions::Words; ++i)
  {
    solutions.Found[i] = solutions.Extreme[i] = solutions.Entering[i] = 0;
  }
  // Two vectors at a time; see RefineRoots.
  for (int i = 0; i < candidates.Count; i += 2 * LaneCount)
  {
    Segments segments[2];
    Doubles b[2][4];
    Brackets brackets[2];
    for (int j = 0; j < 2; ++j)
    {
      const int first = i + j * LaneCount;
      const Doubles cell[3] = { LoadIntegers(&candidates.Cell[0][first]),
        LoadIntegers(&candidates.Cell[1][first]), LoadIntegers(&candidates.Cell[2][first]) };
      segments[j] = FindSegments(group, &candidates.Ray[first], cell);
      Doubles values[8];
      FindDifferences(candidates, first, isovalue, values);
      FindCubics(values, segments[j].Entry, segments[j].Exit, b[j]);
      const Mask inside = IsInside(b[j][0]);
      const int lanes = SmallerOf(LargerOf(candidates.Count - first, 0), LaneCount);
      const Mask mayHaveRoot = segments[j].Exists & FirstLanes(lanes) &
        ((IsInside(b[j][1]) ^ inside) | (IsInside(b[j][2]) ^ inside) |
          (IsInside(b[j][3]) ^ inside));
      const Doubles size = Larger(Larger(Magnitude(b[j][0]), Magnitude(b[j][1])),
        Larger(Magnitude(b[j][2]), Magnitude(b[j][3])));
      const Mask ordinary = (Broadcast(1e-100) <= size) & (size <= Broadcast(1e100));
      brackets[j] = FindFirstSignChange(b[j]);
      brackets[j].Exists = brackets[j].Exists & mayHaveRoot & ordinary;
      SetBits(ToBits(AndNot(mayHaveRoot, ordinary)), first, solutions.Extreme);
    }
    Doubles u[2];
    RefineRoots(b, brackets, u);
    for (int j = 0; j < 2; ++j)
    {
      const int first = i + j * LaneCount;
      const Segments& segment = segments[j];
      SetBits(ToBits(brackets[j].Exists), first, solutions.Found);
      SetBits(ToBits(IsInside(brackets[j].AtHigh)), first, solutions.Entering);
      Store(segment.Begin, &solutions.Begin[first]);
      Store(segment.BeginAxis, &solutions.BeginAxis[first]);
      const Doubles t = segment.Begin + (segment.End - segment.Begin) * u[j];
      Store(
        Gather(group.Base, &candidates.Ray[first]) + Smaller(t, segment.End), &solutions.T[first]);
      for (int axis = 0; axis < 3; ++axis)
      {
        Store(
          Lerp(segment.Entry[axis], segment.Exit[axis], u[j]), &solutions.Parametric[axis][first]);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// The same as Interpolate of TrilinearCell.h.
LANES_INLINE Doubles Interpolate(const Doubles corners[8], const Doubles p[3])
{
  Doubles x[4];
  for (int edge = 0; edge < 4; ++edge)
  {
    x[edge] = Lerp(corners[2 * edge], corners[2 * edge + 1], p[0]);
  }
  return Lerp(Lerp(x[0], x[1], p[1]), Lerp(x[2], x[3], p[1]), p[2]);
}

/// The two samples of a row that belong to a cell. A row has a neighbour on both sides.
template <typename T>
LANES_INLINE void LoadPair(const void* const* rows, int lanes, std::ptrdiff_t place,
  std::ptrdiff_t stride, Doubles values[2])
{
  if constexpr (sizeof(T) == 1)
  {
    // Two bytes cannot be gathered, but four can.
    Doubles row[4];
    LoadRow<T, 4>(rows, lanes, place - stride, stride, row);
    values[0] = row[1];
    values[1] = row[2];
  }
  else
  {
    LoadRow<T, 2>(rows, lanes, place, stride, values);
  }
}

// Each sample is read once for all corners that it is a neighbour of.
template <typename T>
void InterpolateDifferences(const InnerCells& cells, const std::ptrdiff_t strides[3],
  double (*gradients)[RayPacket::Capacity])
{
  const Doubles half = Broadcast(0.5);
  for (int i = 0; i < cells.Count; i += LaneCount)
  {
    const void* const* first = &cells.First[i];
    const int lanes = SmallerOf(cells.Count - i, LaneCount);
    Doubles samples[8];
    Doubles differences[3][8];
    for (int z = 0; z < 2; ++z)
    {
      for (int y = 0; y < 2; ++y)
      {
        const int corner = 2 * y + 4 * z;
        Doubles row[4];
        LoadRow<T, 4>(first, lanes, y * strides[1] + z * strides[2] - strides[0], strides[0], row);
        samples[corner] = row[1];
        samples[corner + 1] = row[2];
        differences[0][corner] = (row[2] - row[0]) * half;
        differences[0][corner + 1] = (row[3] - row[1]) * half;
      }
    }
    for (int side = 0; side < 2; ++side)
    {
      for (int axis = 1; axis < 3; ++axis)
      {
        // The rows before and behind two corners of the cell.
        const std::ptrdiff_t place = side * strides[3 - axis];
        const int low = side * (axis == 1 ? 4 : 2);
        const int high = low + (axis == 1 ? 2 : 4);
        Doubles before[2];
        Doubles behind[2];
        LoadPair<T>(first, lanes, place - strides[axis], strides[0], before);
        LoadPair<T>(first, lanes, place + 2 * strides[axis], strides[0], behind);
        for (int x = 0; x < 2; ++x)
        {
          differences[axis][low + x] = (samples[high + x] - before[x]) * half;
          differences[axis][high + x] = (behind[x] - samples[low + x]) * half;
        }
      }
    }
    const Doubles p[3] = { Load(&cells.Parametric[0][i]), Load(&cells.Parametric[1][i]),
      Load(&cells.Parametric[2][i]) };
    for (int axis = 0; axis < 3; ++axis)
    {
      Store(Interpolate(differences[axis], p), &gradients[axis][i]);
    }
  }
}

LANES_INLINE Doubles Dot(const Doubles a[3], const Doubles b[3])
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The same as Normalized of Vector.h, times a factor, where the square of the length is safe.
/// Returns where it is.
LANES_INLINE Mask Normalize(Doubles a[3], double factor)
{
  const Doubles square = Dot(a, a);
  const Doubles inverse = Broadcast(1.0) / SquareRoot(square);
  for (int i = 0; i < 3; ++i)
  {
    a[i] = a[i] * inverse * Broadcast(factor);
  }
  return (Broadcast(1e-280) < square) & (square < Broadcast(1e280));
}

LANES_INLINE void Transform(const double* m, const Doubles from[3], Doubles to[3])
{
  for (int i = 0; i < 3; ++i)
  {
    to[i] = Broadcast(m[4 * i]) * from[0] + Broadcast(m[4 * i + 1]) * from[1] +
      Broadcast(m[4 * i + 2]) * from[2];
  }
}

LANES_INLINE Doubles Power(Doubles base, int exponent)
{
  Doubles result = Broadcast(1.0);
  Doubles square = base;
  for (; exponent > 0; exponent /= 2)
  {
    result = exponent % 2 == 1 ? result * square : result;
    square = square * square;
  }
  return result;
}

/// The light that is reflected, diffuse and specular.
struct Reflections
{
  Doubles Diffuse[3];
  Doubles Specular[3];
};

LANES_INLINE void AddReflections(const DistantLight& light, int power, const Doubles normal[3],
  const Doubles toViewer[3], Reflections& reflections)
{
  const Doubles zero = Broadcast(0.0);
  Doubles direction[3];
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = Broadcast(light.Direction[i]);
  }
  const Doubles cosine = Dot(normal, direction);
  const Mask isLit = zero < cosine;
  Doubles mirrored[3];
  for (int i = 0; i < 3; ++i)
  {
    mirrored[i] = normal[i] * (Broadcast(2.0) * cosine) - direction[i];
  }
  const Doubles highlight = Power(Larger(zero, Dot(mirrored, toViewer)), power);
  for (int i = 0; i < 3; ++i)
  {
    Doubles& diffuse = reflections.Diffuse[i];
    Doubles& specular = reflections.Specular[i];
    diffuse = Select(isLit, diffuse + Broadcast(light.DiffuseColor[i]) * cosine, diffuse);
    specular = Select(isLit, specular + Broadcast(light.SpecularColor[i]) * highlight, specular);
  }
}

void Shade(const Phong& phong, ShadedHits& hits)
{
  const Doubles zero = Broadcast(0.0);
  hits.Extreme.Words[0] = 0;
  hits.Extreme.Words[1] = 0;
  for (int i = 0; i < hits.Count; i += LaneCount)
  {
    Doubles gradient[3];
    Doubles direction[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] = Load(&hits.Gradient[axis][i]);
      direction[axis] = Load(&hits.Direction[axis][i]);
    }
    Doubles toViewer[3];
    Transform(phong.WorldFromIndex, direction, toViewer);
    Mask safe = Normalize(toViewer, -1.0);
    safe = safe & Normalize(gradient, 1.0);
    Doubles normal[3];
    Transform(phong.WorldFromGradient, gradient, normal);
    safe = safe & Normalize(normal, -1.0);
    const unsigned int extreme =
      ToBits(AndNot(FirstLanes(SmallerOf(hits.Count - i, LaneCount)), safe));
    hits.Extreme.Words[i >> 6] |= static_cast<std::uint64_t>(extreme) << (i & 63);
    if (phong.TwoSidedLighting)
    {
      const Mask isOutside = LanesOf(GetLanes(hits.Entering, i));
      for (int axis = 0; axis < 3; ++axis)
      {
        normal[axis] = Select(isOutside, normal[axis], normal[axis] * Broadcast(-1.0));
      }
    }
    Reflections reflections = { { zero, zero, zero }, { zero, zero, zero } };
    for (int light = 0; light < phong.LightCount; ++light)
    {
      AddReflections(phong.Lights[light], phong.SpecularPower, normal, toViewer, reflections);
    }
    for (int k = 0; k < 3; ++k)
    {
      const Doubles color = Load(&hits.Color[k][i]);
      const Doubles shaded = color * Broadcast(phong.Ambient) +
        color * reflections.Diffuse[k] * Broadcast(phong.Diffuse) +
        reflections.Specular[k] * Broadcast(phong.Specular);
      // An extreme hit keeps the colour of its surface.
      Store(Select(LanesOf(extreme), color, shaded), &hits.Color[k][i]);
    }
  }
}

//------------------------------------------------------------------------------
// The same as ToByte of RenderTiles.cxx.
LANES_INLINE void StoreBytes(Doubles values, int* bytes)
{
  const Doubles zero = Broadcast(0.0);
  const Doubles clamped = Select(zero < values, Smaller(values, Broadcast(1.0)), zero);
  StoreTruncated(Broadcast(255.0) * clamped + Broadcast(0.5), bytes);
}

void MakePixels(const double* clipFromIndex, const ShadedHits& hits,
  const double (*points)[RayPacket::Capacity], HitPixels& pixels)
{
  const double* m = clipFromIndex;
  const Doubles zero = Broadcast(0.0);
  const Doubles half = Broadcast(0.5);
  const Doubles one = Broadcast(1.0);
  for (int i = 0; i < hits.Count; i += LaneCount)
  {
    int bytes[3][LaneCount];
    for (int k = 0; k < 3; ++k)
    {
      StoreBytes(Load(&hits.Color[k][i]), bytes[k]);
    }
    Doubles clip[2];
    for (int k = 0; k < 2; ++k)
    {
      const double* row = m + 8 + 4 * k;
      clip[k] = Broadcast(row[0]) * Load(&points[0][i]) + Broadcast(row[1]) * Load(&points[1][i]) +
        Broadcast(row[2]) * Load(&points[2][i]) + Broadcast(row[3]);
    }
    // As std::clamp.
    const Doubles depth = half * clip[0] / clip[1] + half;
    double depths[LaneCount];
    Store(Select(depth < zero, zero, Select(one < depth, one, depth)), depths);
    for (int lane = 0; lane < LaneCount; ++lane)
    {
      pixels.Colors[i + lane] = static_cast<std::uint32_t>(bytes[0][lane]) |
        static_cast<std::uint32_t>(bytes[1][lane]) << 8 |
        static_cast<std::uint32_t>(bytes[2][lane]) << 16 | 0xFF000000U;
      pixels.Depths[i + lane] = static_cast<float>(depths[lane]);
    }
  }
}

//------------------------------------------------------------------------------
// The same as ValueRange::Smaller and Larger, for rows of samples. Comparisons with NaN are false,
// and what is infinite lies beyond the largest numbers: neither is ever kept.
template <typename T>
void IncludeRow(const void* row, void* low, void* high, std::ptrdiff_t count)
{
  const T* values = static_cast<const T*>(row);
  T* lows = static_cast<T*>(low);
  T* highs = static_cast<T*>(high);
  for (std::ptrdiff_t i = 0; i < count; ++i)
  {
    const T value = values[i];
    if constexpr (static_cast<T>(0.5) != 0)
    {
      constexpr T largest =
        sizeof(T) == 4 ? static_cast<T>(__FLT_MAX__) : static_cast<T>(__DBL_MAX__);
      lows[i] = ((value < lows[i]) & (value >= -largest)) ? value : lows[i];
      highs[i] = ((value > highs[i]) & (value <= largest)) ? value : highs[i];
    }
    else
    {
      lows[i] = value < lows[i] ? value : lows[i];
      highs[i] = value > highs[i] ? value : highs[i];
    }
  }
}

// One for every ScalarType.
#define FOR_ALL_TYPES(function)                                                                    \
  {                                                                                                \
    function<std::int8_t>, function<std::uint8_t>, function<std::int16_t>,                         \
      function<std::uint16_t>, function<std::int32_t>, function<std::uint32_t>,                    \
      function<std::int64_t>, function<std::uint64_t>, function<float>, function<double>           \
  }

#define KERNELS(name)                                                                              \
  const Kernels name = { MakeRays, Align, FindPassages, FOR_ALL_TYPES(ClassifyCells),              \
    FOR_ALL_TYPES(LoadCorners), Solve, FOR_ALL_TYPES(InterpolateDifferences), Shade, MakePixels,   \
    FOR_ALL_TYPES(IncludeRow) }

}
}
