// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The boxes and ranges of values of cells. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Coordinates and values that are both of type float stay what they are until all are compared.
template <typename Coordinate, typename Value>
struct CommonTypeOf
{
  using Type = double;
};
template <>
struct CommonTypeOf<float, float>
{
  using Type = float;
};

/// In vectors of x, y, z and value, which are four wide with any instruction set. (Functions must
/// not take or return them: how they are passed depends on the set.)
template <int Corners, typename Coordinate, typename Value>
SIMD_INLINE void FindExtentsOf(
  const PointArrays& arrays, const std::int64_t* ids, int count, CellExtents& extents)
{
  using Number = typename CommonTypeOf<Coordinate, Value>::Type;
  using Numbers = typename ShortVector<Number, 4>::Type;
  using Doubles4 = ShortVector<double, 4>::Type;
  const auto* points = static_cast<const Coordinate*>(arrays.Points);
  const auto* values = static_cast<const Value*>(arrays.Values);
  const std::ptrdiff_t stride = arrays.ValueStride;

  Doubles4 lowest = { Infinity, Infinity, Infinity, Infinity };
  Doubles4 highest = -lowest;
  unsigned int finite = 0;
  double area = 0.0;
  for (int i = 0; i < count; ++i, ids += Corners)
  {
    Numbers lower;
    Numbers upper;
    Numbers zeros;
    for (int corner = 0; corner < Corners; ++corner)
    {
      const Coordinate* point = points + 3 * ids[corner];
      const Numbers numbers = { static_cast<Number>(point[0]), static_cast<Number>(point[1]),
        static_cast<Number>(point[2]), static_cast<Number>(values[stride * ids[corner]]) };
      // Zero times a number that is not finite is NaN.
      const Numbers zero = numbers * static_cast<Number>(0);
      lower = corner == 0 ? numbers : numbers < lower ? numbers : lower;
      upper = corner == 0 ? numbers : upper < numbers ? numbers : upper;
      zeros = corner == 0 ? zero : zeros + zero;
    }
    Doubles4 low;
    Doubles4 high;
    Convert(lower, low);
    Convert(upper, high);
    std::memcpy(extents.Lower[i], &low, sizeof(low));
    std::memcpy(extents.Upper[i], &high, sizeof(high));
    if (zeros[0] + zeros[1] + (zeros[2] + zeros[3]) == 0)
    {
      finite |= 1U << i;
      lowest = low < lowest ? low : lowest;
      highest = highest < high ? high : highest;
      const Doubles4 size = high - low;
      area += size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
  }
  std::memcpy(extents.LowerOfAll, &lowest, sizeof(lowest));
  std::memcpy(extents.UpperOfAll, &highest, sizeof(highest));
  extents.Finite = finite;
  extents.Area = area;
}

template <int Corners, typename Value>
SIMD_INLINE void FindExtentsOf(
  const PointArrays& arrays, const std::int64_t* ids, int count, CellExtents& extents)
{
  if (arrays.AreFloats)
  {
    FindExtentsOf<Corners, float, Value>(arrays, ids, count, extents);
  }
  else
  {
    FindExtentsOf<Corners, double, Value>(arrays, ids, count, extents);
  }
}

template <typename Value>
void FindExtents(
  const PointArrays& arrays, const std::int64_t* ids, int corners, int count, CellExtents& extents)
{
  if (corners == 4)
  {
    FindExtentsOf<4, Value>(arrays, ids, count, extents);
  }
  else
  {
    FindExtentsOf<8, Value>(arrays, ids, count, extents);
  }
}

}
}
