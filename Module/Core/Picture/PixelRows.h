// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PixelRows_h
#define PixelRows_h

#include "Kernels/CloudTile.h"
#include "Rays/PixelRectangle.h"

namespace vtkIsosurfaceRayTracing
{

/// The rows of pixels that are drawn together as a tile, counted from the rectangle drawn: those of
/// a tile of the picture, or of several. Each is one pixel high; those that are empty have no
/// width.
struct PixelRows
{
  int Count = 0;
  PixelRectangle Rows[CloudTile::Edge];

  PixelRows() = default;

  /// Those of a rectangle.
  PixelRows(const PixelRectangle& tile)
  {
    for (int row = 0; row < tile.Height; ++row)
    {
      this->Add({ tile.X, tile.Y + row, tile.Width, 1 });
    }
  }

  void Add(const PixelRectangle& row) { this->Rows[this->Count++] = row; }

  /// The rows from one on that lie next to each other in the picture, as a rectangle.
  PixelRectangle FindRectangle(int first) const
  {
    PixelRectangle rectangle = this->Rows[first];
    for (int next = first + 1; next < this->Count; ++next)
    {
      const PixelRectangle& row = this->Rows[next];
      if (row.X != rectangle.X || row.Width != rectangle.Width ||
        row.Y != rectangle.Y + rectangle.Height)
      {
        break;
      }
      ++rectangle.Height;
    }
    return rectangle;
  }
};

}

#endif
