// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SharedTiles_h
#define SharedTiles_h

#include "Picture/Tiles.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The tiles of a picture that many processes draw: each is drawn by one of them, its owner, and
/// all work on them in the same order.
class SharedTiles
{
public:
  SharedTiles(const Scene& scene, int processes)
    : Tiles(MakeTiles(scene))
    , Columns((scene.Pixels.Width + scene.TileWidth - 1) / scene.TileWidth)
    , Processes(processes)
    , Step(FindStep(processes))
    , Stride(FindStep(this->GetCount()))
  {
  }

  int GetCount() const { return static_cast<int>(this->Tiles.size()); }
  const PixelRectangle& Get(int tile) const { return this->Tiles[static_cast<std::size_t>(tile)]; }

  /// Neighbours in rows, in columns and on diagonals have different owners, so that each has its
  /// share of what is dense.
  int GetOwner(int tile) const
  {
    const int row = tile / this->Columns;
    return (tile % this->Columns + row % this->Processes * this->Step) % this->Processes;
  }

  /// The tile that is the next in turn: those that follow each other lie all over the picture, so
  /// that there is work for all, whatever part of the data each has.
  int GetTile(int turn) const
  {
    return static_cast<int>(std::int64_t{ turn } * this->Stride % this->GetCount());
  }

private:
  /// A number without a common divisor, by the golden section.
  static int FindStep(int count)
  {
    int step = static_cast<int>(std::lround(0.618 * count));
    while (std::gcd(step, count) > 1)
    {
      ++step;
    }
    return step;
  }

  std::vector<PixelRectangle> Tiles;
  int Columns;
  int Processes;
  int Step;
  int Stride;
};

}

#endif
