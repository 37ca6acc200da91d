// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Gradients from central differences at the corners of cells. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Finds the slope at a corner of the lower side of each cell along an axis, or of the upper one.
template <bool Even>
struct Slopes
{
  // Even spacing: half the difference of the neighbours.
  SIMD_INLINE Slopes(const InnerCells& /*cells*/, int /*first*/) {}

  SIMD_INLINE Doubles Get(
    int /*axis*/, int /*side*/, Doubles below, Doubles /*own*/, Doubles above) const
  {
    return (above - below) * Doubles(0.5);
  }
};

template <>
struct Slopes<false>
{
  // For each axis, those of InnerCells::Weights.
  Doubles Weights[3][4];

  SIMD_INLINE Slopes(const InnerCells& cells, int first)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* weights[DoubleWidth];
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        weights[lane] = cells.Weights[axis][SmallerOf(first + lane, cells.Count - 1)];
      }
      LoadFours(weights, this->Weights[axis]);
    }
  }

  SIMD_INLINE Doubles Get(int axis, int side, Doubles below, Doubles own, Doubles above) const
  {
    const Doubles* weights = &this->Weights[axis][2 * side];
    return weights[0] * (own - below) + weights[1] * (above - own);
  }
};

// Each sample is read once for all corners that it is a neighbour of.
template <typename T, bool Even>
SIMD_INLINE void InterpolateSlopes(const InnerCells& cells, const std::ptrdiff_t strides[3],
  double (*gradients)[RayPacket::Capacity])
{
  for (int i = 0; i < cells.Count; i += DoubleWidth)
  {
    const void* corners[DoubleWidth];
    TakeRows(cells.First, i, cells.Count, corners);
    const Slopes<Even> slopes(cells, i);
    Doubles samples[8];
    Doubles differences[3][8];
    for (int z = 0; z < 2; ++z)
    {
      for (int y = 0; y < 2; ++y)
      {
        const int corner = 2 * y + 4 * z;
        Doubles row[4];
        LoadRow<T, 4>(corners, y * strides[1] + z * strides[2] - strides[0], strides[0], row);
        samples[corner] = row[1];
        samples[corner + 1] = row[2];
        differences[0][corner] = slopes.Get(0, 0, row[0], row[1], row[2]);
        differences[0][corner + 1] = slopes.Get(0, 1, row[1], row[2], row[3]);
      }
    }
    for (int side = 0; side < 2; ++side)
    {
      for (int axis = 1; axis < 3; ++axis)
      {
        // The rows before and behind two corners of the cell.
        const std::ptrdiff_t index = side * strides[3 - axis];
        const int low = side * (axis == 1 ? 4 : 2);
        const int high = low + (axis == 1 ? 2 : 4);
        Doubles before[2];
        Doubles behind[2];
        LoadRow<T, 2>(corners, index - strides[axis], strides[0], before);
        LoadRow<T, 2>(corners, index + 2 * strides[axis], strides[0], behind);
        for (int x = 0; x < 2; ++x)
        {
          const Doubles first = samples[low + x];
          const Doubles second = samples[high + x];
          differences[axis][low + x] = slopes.Get(axis, 0, before[x], first, second);
          differences[axis][high + x] = slopes.Get(axis, 1, first, second, behind[x]);
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

template <typename T>
void InterpolateDifferences(const InnerCells& cells, const std::ptrdiff_t strides[3],
  double (*gradients)[RayPacket::Capacity])
{
  if (cells.AreUneven)
  {
    InterpolateSlopes<T, false>(cells, strides, gradients);
  }
  else
  {
    InterpolateSlopes<T, true>(cells, strides, gradients);
  }
}

}
}
