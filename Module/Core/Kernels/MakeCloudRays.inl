// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays that clouds are projected to. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The lengths of vectors, whose squares may overflow or vanish.
SIMD_INLINE Doubles FindLength(const Doubles a[3])
{
  const Doubles size = Max(Max(Abs(a[0]), Abs(a[1])), Abs(a[2]));
  const Doubles scaled[3] = { a[0] / size, a[1] / size, a[2] / size };
  return Select(0.0 < size, size * Sqrt(Dot(scaled, scaled)), Doubles(0.0));
}

/// Depths grow with the T of the ray: see MakePixelRays, where w is one over that of the clip
/// coordinates.
void MakeCloudRays(const PixelBlock& block, int firstRow, const double* worldFromObject,
  CloudTile& tile, CloudLighting* lighting)
{
  const double* object = block.ObjectFromClip;
  tile.Columns = block.Columns;
  tile.Rows = firstRow + block.Rows;
  for (int row = 0; row < block.Rows; ++row)
  {
    for (int first = 0; first < block.Columns; first += DoubleWidth)
    {
      double columns[DoubleWidth];
      double depths[DoubleWidth];
      for (int lane = 0; lane < DoubleWidth; ++lane)
      {
        const int column = SmallerOf(first + lane, block.Columns - 1);
        columns[lane] = block.Column + column;
        depths[lane] =
          block.Depth ? static_cast<double>(block.Depth[row * block.DepthStride + column]) : 1.0;
      }
      Doubles origin[3];
      Doubles direction[3];
      Doubles end;
      MakePixelRays(object, block.Width, block.Height, Load(columns), Doubles(block.Row + row),
        Load(depths), origin, direction, end);
      const Doubles x = (Load(columns) + 0.5) * (2.0 / block.Width) - 1.0;
      const double y = (block.Row + row + 0.5) * (2.0 / block.Height) - 1.0;
      const Doubles depthOfT = object[12] * x + object[13] * y + object[15] - object[14];
      const int pixel = (firstRow + row) * CloudTile::Edge + first;
      Store(Doubles(0.0), &tile.Begin[pixel]);
      Store(end * depthOfT, &tile.End[pixel]);
      Store(depthOfT, &tile.DepthOfT[pixel]);
      if (!worldFromObject)
      {
        continue;
      }
      Doubles inWorld[3];
      TransformDirection(worldFromObject, direction, inWorld);
      const Doubles length = FindLength(inWorld);
      Store(length / depthOfT, &tile.Length[pixel]);
      if (!lighting)
      {
        continue;
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        const double* m = worldFromObject + 4 * axis;
        Store(m[0] * origin[0] + m[1] * origin[1] + m[2] * origin[2] + m[3],
          &lighting->Origin[axis][pixel]);
        Store(0.0 - inWorld[axis] / length, &lighting->ToViewer[axis][pixel]);
      }
    }
  }
}

}
}
