// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Gradients from central differences at the corners of cells. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The two samples of a row that belong to a cell. A row has a neighbour on both sides.
template <typename T>
SIMD_INLINE void LoadPair(const void* const* rows, int lanes, std::ptrdiff_t index,
  std::ptrdiff_t stride, Doubles values[2])
{
  if constexpr (sizeof(T) == 1)
  {
    // Two bytes cannot be gathered, but four can.
    Doubles row[4];
    LoadRow<T, 4>(rows, lanes, index - stride, stride, row);
    values[0] = row[1];
    values[1] = row[2];
  }
  else
  {
    LoadRow<T, 2>(rows, lanes, index, stride, values);
  }
}

// Each sample is read once for all corners that it is a neighbour of.
template <typename T>
void InterpolateDifferences(const InnerCells& cells, const std::ptrdiff_t strides[3],
  double (*gradients)[RayPacket::Capacity])
{
  const Doubles half = 0.5;
  for (int i = 0; i < cells.Count; i += DoubleWidth)
  {
    const void* const* first = &cells.First[i];
    const int lanes = SmallerOf(cells.Count - i, DoubleWidth);
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
        const std::ptrdiff_t index = side * strides[3 - axis];
        const int low = side * (axis == 1 ? 4 : 2);
        const int high = low + (axis == 1 ? 2 : 4);
        Doubles before[2];
        Doubles behind[2];
        LoadPair<T>(first, lanes, index - strides[axis], strides[0], before);
        LoadPair<T>(first, lanes, index + 2 * strides[axis], strides[0], behind);
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

}
}
