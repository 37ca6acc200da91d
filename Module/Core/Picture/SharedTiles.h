// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef SharedTiles_h
#define SharedTiles_h

#include "Kernels/CloudTile.h"
#include "Picture/PixelRows.h"
#include "Picture/Tiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The tiles of a picture that many processes draw together.
///
/// All work on the tiles in the same order, by groups of a few. A group is drawn in as many shares,
/// each by a process, its owner: a share has every so many-th row of each tile of the group. Tiles
/// that follow each other lie all over the picture, so all shares have about as much to draw, and
/// there is work for all, whatever part of the data each has. (K.-L. Ma and T. W. Crockett deal out
/// interleaved pixels: A Scalable Parallel Cell-Projection Volume Rendering Algorithm for
/// Three-Dimensional Unstructured Data, 1997.)
class SharedTiles
{
public:
  /// The most tiles of a group.
  static constexpr int MaximumGroupSize = CloudTile::Edge;

  /// The tiles of the scene may not be larger than a CloudTile.
  SharedTiles(const Scene& scene, int processes)
    : Tiles(MakeTiles(scene))
    , Processes(processes)
    , GroupSize(FindGroupSize(processes))
    , Stride(FindStride(static_cast<int>(this->Tiles.size())))
  {
  }

  int GetNumberOfTiles() const { return static_cast<int>(this->Tiles.size()); }
  int GetNumberOfGroups() const
  {
    return (this->GetNumberOfTiles() + this->GroupSize - 1) / this->GroupSize;
  }
  int GetNumberOfShares() const { return this->GetNumberOfGroups() * this->GroupSize; }

  /// The number of shares of a group, and of its tiles, of which the last group may have fewer.
  int GetGroupSize() const { return this->GroupSize; }
  int GetNumberOfTilesOf(int group) const
  {
    return std::min(this->GroupSize, this->GetNumberOfTiles() - group * this->GroupSize);
  }

  const PixelRectangle& GetTile(int group, int number) const
  {
    const std::int64_t turn = std::int64_t{ group } * this->GroupSize + number;
    return this->Tiles[static_cast<std::size_t>(turn * this->Stride % this->GetNumberOfTiles())];
  }

  /// The shares of a group follow each other.
  int GetShare(int group, int number) const { return group * this->GroupSize + number; }
  int GetGroup(int share) const { return share / this->GroupSize; }
  int GetNumber(int share) const { return share % this->GroupSize; }
  int GetOwner(int share) const { return share % this->Processes; }

  /// Of the rows of a tile of a group: the number of the share that has one, and where.
  int GetNumberOfShare(int tile, int row) const { return (row + tile) % this->GroupSize; }
  int GetRowInShare(int tile, int row) const
  {
    return tile * this->GetRowsOfTile() + row / this->GroupSize;
  }

  /// The other way: the tile that a row of a share is of, and the row there.
  int GetTileOfRow(int row) const { return row / this->GetRowsOfTile(); }
  int GetRowInTile(int number, int row) const
  {
    const int first = number - this->GetTileOfRow(row) + this->GroupSize;
    return row % this->GetRowsOfTile() * this->GroupSize + first % this->GroupSize;
  }

  /// How many groups processes with so many threads may be apart: enough for all of them, and no
  /// more than it takes.
  int FindWindow(int threads) const
  {
    const int tiles =
      std::max({ 16, 2 * this->Processes, 4 * threads, this->GetNumberOfTiles() / 64 });
    return (tiles + this->GroupSize - 1) / this->GroupSize;
  }

  PixelRows FindRows(int share) const
  {
    const int group = this->GetGroup(share);
    PixelRows rows;
    for (int i = 0; i < CloudTile::Edge; ++i)
    {
      const int tile = this->GetTileOfRow(i);
      const int row = this->GetRowInTile(this->GetNumber(share), i);
      const PixelRectangle pixels =
        tile < this->GetNumberOfTilesOf(group) ? this->GetTile(group, tile) : PixelRectangle{};
      rows.Add({ pixels.X, pixels.Y + row, row < pixels.Height ? pixels.Width : 0, 1 });
    }
    return rows;
  }

private:
  /// Of few processes each has many tiles, which balance by themselves. A power of two.
  static int FindGroupSize(int processes)
  {
    int size = 1;
    while (2 * size < processes && size < MaximumGroupSize)
    {
      size *= 2;
    }
    return size;
  }

  /// A number without a common divisor, by the golden section.
  static int FindStride(int count)
  {
    int stride = static_cast<int>(std::lround(0.618 * count));
    while (std::gcd(stride, count) > 1)
    {
      ++stride;
    }
    return stride;
  }

  /// The number of rows of a tile that are in a share.
  int GetRowsOfTile() const { return CloudTile::Edge / this->GroupSize; }

  std::vector<PixelRectangle> Tiles;
  int Processes;
  int GroupSize;
  int Stride;
};

}

#endif
