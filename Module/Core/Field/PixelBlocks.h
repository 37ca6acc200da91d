// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelBlocks_h
#define PixelBlocks_h

#include "Kernels/Kernels.h"
#include "Rays/Camera.h"
#include "Rays/PixelRectangle.h"

namespace vtkIsosurfaceRayTracing
{

/// A rectangle of pixels as the kernels take it, without the dimensions.
inline PixelBlock MakePixelBlock(
  const Camera& view, const PixelRectangle& pixels, const PixelDepths& depths)
{
  PixelBlock block{};
  block.ObjectFromClip = view.GetObjectFromClip().data();
  block.Width = view.GetWidth();
  block.Height = view.GetHeight();
  block.Column = pixels.X;
  block.Row = pixels.Y;
  block.Columns = pixels.Width;
  block.Rows = pixels.Height;
  block.Depth = depths.First;
  block.DepthStride = depths.Stride;
  return block;
}

}

#endif
