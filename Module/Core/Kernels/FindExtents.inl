// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The boxes and ranges of values of cells. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The same as a Number for each of x, y, z and value.
struct ExtentNumbers
{
  Doubles Lower[4] = { Infinity, Infinity, Infinity, Infinity };
  Doubles Upper[4] = { -Infinity, -Infinity, -Infinity, -Infinity };

  SIMD_INLINE void Include(const Doubles (&lower)[4], const Doubles (&upper)[4])
  {
    for (int i = 0; i < 4; ++i)
    {
      this->Lower[i] = Min(this->Lower[i], lower[i]);
      this->Upper[i] = Max(this->Upper[i], upper[i]);
    }
  }

  /// Half of the surface of the box.
  SIMD_INLINE Doubles GetArea() const
  {
    const Doubles x = this->Upper[0] - this->Lower[0];
    const Doubles y = this->Upper[1] - this->Lower[1];
    const Doubles z = this->Upper[2] - this->Lower[2];
    return x * y + y * z + z * x;
  }
};

template <int Corners>
void FindExtents(const double (*cells)[Corners][4], int count, CellExtents& extents)
{
  extents.Finite = 0;
  ExtentNumbers all;
  Doubles area = 0.0;
  for (int first = 0; first < count; first += DoubleWidth)
  {
    ExtentNumbers cell;
    Doubles zeros = 0.0;
    for (int corner = 0; corner < Corners; ++corner)
    {
      Doubles numbers[4];
      LoadCorner(cells, first, count, corner, numbers);
      cell.Include(numbers, numbers);
      // Zero times a number that is not finite is NaN.
      zeros = zeros + 0.0 * numbers[0] + 0.0 * numbers[1] + 0.0 * numbers[2] + 0.0 * numbers[3];
    }
    for (int i = 0; i < 4; ++i)
    {
      Store(cell.Lower[i], &extents.Lower[i][first]);
      Store(cell.Upper[i], &extents.Upper[i][first]);
    }
    const Mask isFinite = FirstLanes(count - first) & (zeros == 0.0);
    extents.Finite |= ToBits(isFinite) << first;
    area = area + Select(isFinite, cell.GetArea(), 0.0);
    for (int i = 0; i < 4; ++i)
    {
      cell.Lower[i] = Select(isFinite, cell.Lower[i], Infinity);
      cell.Upper[i] = Select(isFinite, cell.Upper[i], -Infinity);
    }
    all.Include(cell.Lower, cell.Upper);
  }
  for (int i = 0; i < 4; ++i)
  {
    extents.LowerOfAll[i] = ReduceMin(all.Lower[i]);
    extents.UpperOfAll[i] = ReduceMax(all.Upper[i]);
  }
  double areas[DoubleWidth];
  Store(area, areas);
  extents.Area = 0.0;
  for (const double one : areas)
  {
    extents.Area += one;
  }
}

}
}
