// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Bounds on the values of rays in cells. Included by Kernels.inl only, behind ClassifyCells.inl.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A bound on the values of cubics along rays in cells: no Bernstein coefficient is above it. Cells
/// that rays do not pass have none.
template <bool Even>
SIMD_INLINE Floats BoundCubics(const Floats v[8], Floats largest, const int order[3],
  const RoughCells& cells, const RoughSegments& segments)
{
  const RoughCubics cubics = FindRoughCubics(v, order, cells, segments);
  const RoughPlaces places = FindPlaces<Even>(cells);
  const Floats third = 1.0F / 3.0F;
  const Floats most = Max(Max(cubics.Begin, cubics.End), Max(cubics.Once, cubics.Twice) * third);
  // Numbers of the smallest magnitudes vanish.
  const Floats bound = Select(segments.High < segments.Low, -FloatInfinity,
    most + FindError<Even>(largest, 0x1p-100F, places));
  return Even ? bound : Select(places.AreKnown(), bound, FloatInfinity);
}

template <typename T, bool Even>
SIMD_INLINE void BoundCellsBetween(const PassedCells& cells, int axis,
  const std::ptrdiff_t strides[3], bool areNegated, const Passages& passages, float* bounds)
{
  const int order[3] = { axis, AxisU[axis], AxisV[axis] };
  const Floats sign = areNegated ? -1.0F : 1.0F;
  for (int i = 0; i < cells.Count; i += FloatWidth)
  {
    const RoughCells rough = LoadCells<Even>(passages, &cells.Codes[i], order);
    const RoughSegments segments = FindRoughSegments<Even>(rough);
    Floats values[8];
    const Floats largest = LoadRoughDifferences<T>(&cells.First[i], strides, 0.0F, values);
    for (Floats& value : values)
    {
      value = value * sign;
    }
    StoreFloats(BoundCubics<Even>(values, largest, order, rough, segments), &bounds[i]);
  }
}

template <typename T>
void BoundCells(const PassedCells& cells, int axis, const std::ptrdiff_t strides[3],
  bool areNegated, const Passages& passages, float* bounds)
{
  if (passages.AreUneven)
  {
    BoundCellsBetween<T, false>(cells, axis, strides, areNegated, passages, bounds);
  }
  else
  {
    BoundCellsBetween<T, true>(cells, axis, strides, areNegated, passages, bounds);
  }
}

}
}
