// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ApronBricks_h
#define ApronBricks_h

#include "Field/BuildTimer.h"
#include "Image/Samples/BlockCache.h"
#include "Image/Samples/Unbricked.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

/// Bricks of n^3 cells, each with all (n + 1)^3 corners of its cells: the samples on a face between
/// two bricks are in both (the apron), so that a cell never needs a second brick. A brick is made
/// by the first ray that reads it.
template <typename T>
class ApronBricks
{
public:
  using Value = Stored<T>;
  using Kept = Value;

  ApronBricks(const Samples<T>& samples, int size)
    : TheSamples(samples)
    , Size(size)
    , Edge(static_cast<std::size_t>(size) + 1)
    , Strides{ 1, size + 1, (size + 1) * (size + 1) }
    , BrickDimensions(
        BlocksCovering({ samples.GetDimensions()[0] - 1, samples.GetDimensions()[1] - 1,
                         samples.GetDimensions()[2] - 1 },
          size))
    , Bricks(Count(this->BrickDimensions), GetSlotSize(size))
  {
  }

  /// The size of a brick in bytes, in whole cache lines.
  static std::size_t GetSlotSize(int size)
  {
    const int edge = size + 1;
    return (Count({ edge, edge, edge }) * sizeof(Value) + 63) / 64 * 64;
  }

  void BeginFrame(std::size_t maximumMemory) { this->Bricks.BeginFrame(maximumMemory); }

  class Reader
  {
  public:
    explicit Reader(ApronBricks& layout)
      : Layout(layout)
    {
    }

    /// Prefetches the brick of a cell.
    void Prefetch(const Index3& cell) const
    {
      const int size = this->Layout.Size;
      this->Layout.Bricks.Prefetch(
        Offset({ cell[0] / size, cell[1] / size, cell[2] / size }, this->Layout.BrickDimensions));
    }

    void Load(const Index3& cell, Value corners[8])
    {
      const Value* low = this->Find(cell);
      if (!low)
      {
        LoadCorners(this->Layout.TheSamples, cell, corners);
        return;
      }
      const std::size_t edge = this->Layout.Edge;
      const Value* high = low + edge * edge;
      corners[0] = low[0];
      corners[1] = low[1];
      corners[2] = low[edge];
      corners[3] = low[edge + 1];
      corners[4] = high[0];
      corners[5] = high[1];
      corners[6] = high[edge];
      corners[7] = high[edge + 1];
    }

    const Kept* FindBlock(const Index3& first, int edge)
    {
      return this->Layout.Size % edge == 0 ? this->Find(first) : nullptr;
    }

    const std::ptrdiff_t* GetStrides() const { return this->Layout.Strides.data(); }

  private:
    /// The first corner of a cell; null if its brick is not there.
    const Value* Find(const Index3& cell)
    {
      if (!this->IsInBrick(cell))
      {
        this->MoveTo(cell);
      }
      if (!this->Brick)
      {
        return nullptr;
      }
      const std::size_t edge = this->Layout.Edge;
      return this->Brick + static_cast<std::size_t>(cell[0] - this->First[0]) +
        edge *
        (static_cast<std::size_t>(cell[1] - this->First[1]) +
          edge * static_cast<std::size_t>(cell[2] - this->First[2]));
    }

    bool IsInBrick(const Index3& cell) const
    {
      const auto size = static_cast<unsigned int>(this->Layout.Size);
      // Cells before the first wrap round to large numbers.
      return static_cast<unsigned int>(cell[0] - this->First[0]) < size &&
        static_cast<unsigned int>(cell[1] - this->First[1]) < size &&
        static_cast<unsigned int>(cell[2] - this->First[2]) < size;
    }

    void MoveTo(const Index3& cell)
    {
      const int size = this->Layout.Size;
      const Index3 brick = { cell[0] / size, cell[1] / size, cell[2] / size };
      this->First = { brick[0] * size, brick[1] * size, brick[2] * size };
      this->Brick = this->Layout.GetBrick(brick);
    }

    ApronBricks& Layout;
    /// Null before the first brick, and where there is none.
    const Value* Brick = nullptr;
    Index3 First = { -(1 << 30), -(1 << 30), -(1 << 30) };
  };

  std::size_t GetNumberOfBricks() const { return this->Bricks.GetNumberOfBlocks(); }
  std::size_t GetMaximumNumberOfBricks() const { return this->Bricks.GetMaximumNumberOfBlocks(); }
  std::size_t GetMemory() const { return this->Bricks.GetMemory(); }

private:
  /// The brick, made now if it is missing; null if there is no room for it, or while another thread
  /// is making it.
  const Value* GetBrick(const Index3& index)
  {
    return static_cast<const Value*>(this->Bricks.Get(Offset(index, this->BrickDimensions),
      [this, &index](void* memory)
      {
        const BuildTimer timer;
        this->FillBrick(index, static_cast<Value*>(memory));
      }));
  }

  void FillBrick(const Index3& index, Value* brick) const
  {
    const Index3& dimensions = this->TheSamples.GetDimensions();
    const int edge = static_cast<int>(this->Edge);
    Index3 first;
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = index[axis] * this->Size;
      count[axis] = std::min(edge, dimensions[axis] - first[axis]);
    }
    const std::ptrdiff_t stride = this->TheSamples.GetStride(0);
    for (int z = 0; z < count[2]; ++z)
    {
      for (int y = 0; y < count[1]; ++y)
      {
        const T* from = this->TheSamples.At({ first[0], first[1] + y, first[2] + z });
        Value* to = brick + Offset({ 0, y, z }, { edge, edge, edge });
        for (int x = 0; x < count[0]; ++x)
        {
          to[x] = static_cast<Value>(from[x * stride]);
        }
      }
    }
  }

  Samples<T> TheSamples;
  int Size;
  std::size_t Edge;
  /// Within a brick.
  std::array<std::ptrdiff_t, 3> Strides;
  Index3 BrickDimensions;
  BlockCache Bricks;
};

}

#endif
