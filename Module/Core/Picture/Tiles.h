// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Tiles_h
#define Tiles_h

#include "Picture/PixelBlockRenderer.h"
#include "Picture/Scene.h"
#include "Rays/PixelRectangle.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The tiles of a picture, in rows from the bottom, in pixels from the lower left of the rectangle
/// drawn.
inline std::vector<PixelRectangle> MakeTiles(const Scene& scene)
{
  std::vector<PixelRectangle> tiles;
  for (int y = 0; y < scene.Pixels.Height; y += scene.TileHeight)
  {
    for (int x = 0; x < scene.Pixels.Width; x += scene.TileWidth)
    {
      tiles.push_back({ x, y, std::min(scene.TileWidth, scene.Pixels.Width - x),
        std::min(scene.TileHeight, scene.Pixels.Height - y) });
    }
  }
  return tiles;
}

/// Calls visit(blocks, count) for groups of neighbouring parts of a tile that make a packet of rays
/// each, until it returns false. Parts and groups are as square as may be, since their rays are
/// traced together.
template <typename Visit>
void ForEachGroup(const PixelRectangle& tile, int blocksAtOnce, const Visit& visit)
{
  constexpr int width = 16;
  const int columns = std::min(width, tile.Width);
  const int rows = RayPacket::Capacity / columns;
  const int across = blocksAtOnce > 1 ? 2 : 1;
  const int up = blocksAtOnce / across;
  for (int y = 0; y < tile.Height; y += up * rows)
  {
    for (int x = 0; x < tile.Width; x += across * columns)
    {
      PixelRectangle blocks[PixelBlockRenderer::MaximumBlocks];
      int count = 0;
      for (int blockY = y; blockY < std::min(y + up * rows, tile.Height); blockY += rows)
      {
        for (int blockX = x; blockX < std::min(x + across * columns, tile.Width); blockX += columns)
        {
          blocks[count++] = { tile.X + blockX, tile.Y + blockY,
            std::min(columns, tile.Width - blockX), std::min(rows, tile.Height - blockY) };
        }
      }
      if (!visit(blocks, count))
      {
        return;
      }
    }
  }
}

}

#endif
