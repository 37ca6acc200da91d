// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelRectangle_h
#define PixelRectangle_h

#include <algorithm>
#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// A rectangle of pixels, counted from the lower left of the viewport.
struct PixelRectangle
{
  int X = 0;
  int Y = 0;
  int Width = 0;
  int Height = 0;
};

inline bool IsEmpty(const PixelRectangle& pixels)
{
  return pixels.Width <= 0 || pixels.Height <= 0;
}

inline bool Overlap(const PixelRectangle& a, const PixelRectangle& b)
{
  return a.X < b.X + b.Width && b.X < a.X + a.Width && a.Y < b.Y + b.Height && b.Y < a.Y + a.Height;
}

/// The smallest rectangle with the pixels of both.
inline PixelRectangle Unite(const PixelRectangle& a, const PixelRectangle& b)
{
  if (IsEmpty(a) || IsEmpty(b))
  {
    return IsEmpty(a) ? b : a;
  }
  const int x = std::min(a.X, b.X);
  const int y = std::min(a.Y, b.Y);
  return { x, y, std::max(a.X + a.Width, b.X + b.Width) - x,
    std::max(a.Y + a.Height, b.Y + b.Height) - y };
}

/// The depths, in [0, 1] as in the depth buffer, of a rectangle of pixels.
struct PixelDepths
{
  /// Of the pixel at the lower left; null for the far plane everywhere.
  const float* First = nullptr;
  /// From one row to the next.
  std::ptrdiff_t Stride = 0;

  double Get(int x, int y) const
  {
    return this->First ? static_cast<double>(this->First[y * this->Stride + x]) : 1.0;
  }
};

}

#endif
