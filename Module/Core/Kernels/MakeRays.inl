// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays through the pixels of a block, clipped to the volume. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

void MakeRays(const PixelBlock& block, RayPacket& packet)
{
  double columns[RayPacket::Capacity + DoubleWidth];
  double rows[RayPacket::Capacity + DoubleWidth];
  double depths[RayPacket::Capacity + DoubleWidth];
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
  packet.Count = count;
  packet.Exists.Words[0] = 0;
  packet.Exists.Words[1] = 0;
  for (int i = count; i < count + DoubleWidth; ++i)
  {
    columns[i] = columns[0];
    rows[i] = rows[0];
    depths[i] = depths[0];
  }
  const double lastPlanes[3] = { block.Dimensions[0] - 1.0, block.Dimensions[1] - 1.0,
    block.Dimensions[2] - 1.0 };
  for (int i = 0; i < count; i += DoubleWidth)
  {
    ClippedRays<Doubles> rays;
    MakePixelRays(block.ObjectFromClip, block.Width, block.Height, Load(&columns[i]),
      Load(&rows[i]), Load(&depths[i]), rays.Origin, rays.Direction, rays.End);
    rays.Begin = 0.0;
    const Mask exists = ClipToVolume(block.Dimensions, lastPlanes, rays) &
      FirstLanes(SmallerOf(count - i, DoubleWidth));
    packet.Exists.Words[i >> 6] |= static_cast<std::uint64_t>(ToBits(exists)) << (i & 63);
    for (int axis = 0; axis < 3; ++axis)
    {
      Store(rays.Origin[axis], &packet.Origin[axis][i]);
      Store(rays.Direction[axis], &packet.Direction[axis][i]);
      Store(rays.Inverse[axis], &packet.Inverse[axis][i]);
    }
    Store(rays.Begin, &packet.Begin[i]);
    Store(rays.End, &packet.End[i]);
    Store(rays.Base, &packet.Base[i]);
  }
}

}
}
