// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Rays through the pixels of a block, clipped to the volume. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Makes rays for all pixels, in vectors. Move(origin, direction, end, first) moves those of a
/// vector to the field, stores them and returns which exist.
template <typename Move>
SIMD_INLINE void MakePixelVectors(const PixelBlock& block, RayPacket& packet, const Move& move)
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
  packet.Columns = block.Columns;
  packet.Exists.Words[0] = 0;
  packet.Exists.Words[1] = 0;
  for (int i = count; i < count + DoubleWidth; ++i)
  {
    columns[i] = columns[0];
    rows[i] = rows[0];
    depths[i] = depths[0];
  }
  for (int i = 0; i < count; i += DoubleWidth)
  {
    Doubles origin[3];
    Doubles direction[3];
    Doubles end;
    MakePixelRays(block.ObjectFromClip, block.Width, block.Height, Load(&columns[i]),
      Load(&rows[i]), Load(&depths[i]), origin, direction, end);
    const Mask exists =
      move(origin, direction, end, i) & FirstLanes(SmallerOf(count - i, DoubleWidth));
    packet.Exists.Words[i >> 6] |= static_cast<std::uint64_t>(ToBits(exists)) << (i & 63);
  }
}

template <typename Rays>
SIMD_INLINE void StoreRays(const Rays& rays, int first, RayPacket& packet)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    Store(rays.Origin[axis], &packet.Origin[axis][first]);
    Store(rays.Direction[axis], &packet.Direction[axis][first]);
    Store(rays.Inverse[axis], &packet.Inverse[axis][first]);
  }
  Store(rays.Begin, &packet.Begin[first]);
  Store(rays.End, &packet.End[first]);
  Store(rays.Base, &packet.Base[first]);
}

template <typename Rays>
SIMD_INLINE void SetRays(
  const Doubles origin[3], const Doubles direction[3], Doubles end, Rays& rays)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    rays.Origin[axis] = origin[axis];
    rays.Direction[axis] = direction[axis];
  }
  rays.Begin = 0.0;
  rays.End = end;
}

void MakeRays(const PixelBlock& block, RayPacket& packet)
{
  const double lastPlanes[3] = { block.Dimensions[0] - 1.0, block.Dimensions[1] - 1.0,
    block.Dimensions[2] - 1.0 };
  MakePixelVectors(block, packet,
    [&](const Doubles origin[3], const Doubles direction[3], Doubles end, int first)
    {
      ClippedRays<Doubles> rays;
      SetRays(origin, direction, end, rays);
      const Mask exists = ClipToVolume(block.Dimensions, lastPlanes, rays);
      StoreRays(rays, first, packet);
      return exists;
    });
}

void MakeBoxedRays(
  const PixelBlock& block, const double lower[3], const double upper[3], RayPacket& packet)
{
  MakePixelVectors(block, packet,
    [&](const Doubles origin[3], const Doubles direction[3], Doubles end, int first)
    {
      BoxedRays<Doubles> rays;
      SetRays(origin, direction, end, rays);
      const Mask exists = MoveToBox(lower, upper, rays);
      StoreRays(rays, first, packet);
      return exists;
    });
}

}
}
