// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The pixels of opaque hits. Included by Kernels.inl only.

namespace vtkIsosurfaceRayTracing
{
namespace
{

void MakePixels(const double* clipFromObject, const ShadedHits& hits,
  const double (*points)[RayPacket::Capacity], HitPixels& pixels)
{
  const Doubles zero = 0.0;
  const Doubles one = 1.0;
  for (int i = 0; i < hits.Count; i += DoubleWidth)
  {
    int bytes[3][DoubleWidth];
    for (int k = 0; k < 3; ++k)
    {
      StoreTruncated(ScaleToByte(Load(&hits.Color[k][i])), bytes[k]);
    }
    const Doubles point[3] = { Load(&points[0][i]), Load(&points[1][i]), Load(&points[2][i]) };
    const Doubles depth = GetPixelDepth(clipFromObject, point);
    double depths[DoubleWidth];
    Store(Clamp(depth, zero, one), depths);
    for (int lane = 0; lane < DoubleWidth; ++lane)
    {
      pixels.Colors[i + lane] = static_cast<std::uint32_t>(bytes[0][lane]) |
        static_cast<std::uint32_t>(bytes[1][lane]) << 8 |
        static_cast<std::uint32_t>(bytes[2][lane]) << 16 | 0xFF000000U;
      pixels.Depths[i + lane] = static_cast<float>(depths[lane]);
    }
  }
}

}
}
