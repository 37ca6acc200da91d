// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TwoLevelBricks_h
#define TwoLevelBricks_h

#include "Field/BuildTimer.h"
#include "Image/Samples/Unbricked.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// The layout of Parker et al. 1998, section 3.1: bricks of n^3 samples, to fill cache lines, lie
/// together in groups of m^3 bricks, to fill pages. The address of a sample is the sum of three
/// tables, Fx[x] + Fy[y] + Fz[z]. Here a brick is filled only when the first ray reads it; memory
/// that no brick fills is reserved but never touched, so the operating system does not provide it.
template <typename T>
class TwoLevelBricks
{
public:
  using Value = Stored<T>;
  using Kept = Value;

  TwoLevelBricks(const Samples<T>& samples, int brickSize, int groupSize)
    : TheSamples(samples)
    , Size(brickSize)
    , BrickDimensions(BlocksCovering(samples.GetDimensions(), brickSize))
    , States(Count(this->BrickDimensions))
  {
    std::size_t groupVolume = Count({ brickSize, brickSize, brickSize });
    Index3 group;
    Index3 groups;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // A group larger than the volume would only waste addresses.
      group[axis] = std::min(groupSize, this->BrickDimensions[axis]);
      groups[axis] = (this->BrickDimensions[axis] + group[axis] - 1) / group[axis];
      groupVolume *= static_cast<std::size_t>(group[axis]);
    }
    std::size_t sampleStride = 1;
    std::size_t brickStride = Count({ brickSize, brickSize, brickSize });
    std::size_t groupStride = groupVolume;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Address[axis].resize(static_cast<std::size_t>(samples.GetDimensions()[axis]));
      for (std::size_t i = 0; i < this->Address[axis].size(); ++i)
      {
        const std::size_t size = static_cast<std::size_t>(brickSize);
        const std::size_t bricks = static_cast<std::size_t>(group[axis]);
        this->Address[axis][i] = i % size * sampleStride + i / size % bricks * brickStride +
          i / (size * bricks) * groupStride;
      }
      sampleStride *= static_cast<std::size_t>(brickSize);
      brickStride *= static_cast<std::size_t>(group[axis]);
      groupStride *= static_cast<std::size_t>(groups[axis]);
    }
    this->Values.reset(new (std::nothrow) Value[groupStride]);
  }

  /// Has no limit: the address of a sample is fixed.
  void BeginFrame(std::size_t) {}

  class Reader
  {
  public:
    explicit Reader(TwoLevelBricks& layout)
      : Layout(layout)
    {
    }

    void Prefetch(const Index3&) {}

    void Load(const Index3& cell, Value corners[8])
    {
      if (!this->Layout.Values)
      {
        LoadCorners(this->Layout.TheSamples, cell, corners);
        return;
      }
      this->FillBricksOf(cell);
      for (int corner = 0; corner < 8; ++corner)
      {
        corners[corner] = this->Layout.Values[this->Layout.GetAddress(
          { cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2) })];
      }
    }

    const Kept* FindBlock(const Index3&, int) const { return nullptr; }

    const std::ptrdiff_t* GetStrides() const { return this->Layout.TheSamples.GetStrides(); }

  private:
    /// Makes sure that the bricks of all corners are filled: one, or up to eight where the cell
    /// lies between bricks.
    void FillBricksOf(const Index3& cell)
    {
      const int size = this->Layout.Size;
      const Index3 first = { cell[0] / size, cell[1] / size, cell[2] / size };
      const Index3 last = { (cell[0] + 1) / size, (cell[1] + 1) / size, (cell[2] + 1) / size };
      if (first == this->First && last == this->Last)
      {
        return;
      }
      this->First = first;
      this->Last = last;
      for (int z = first[2]; z <= last[2]; ++z)
      {
        for (int y = first[1]; y <= last[1]; ++y)
        {
          for (int x = first[0]; x <= last[0]; ++x)
          {
            this->Layout.RequireBrick({ x, y, z });
          }
        }
      }
    }

    TwoLevelBricks& Layout;
    Index3 First = { -1, -1, -1 };
    Index3 Last = { -1, -1, -1 };
  };

  std::size_t GetAddress(const Index3& sample) const
  {
    return this->Address[0][static_cast<std::size_t>(sample[0])] +
      this->Address[1][static_cast<std::size_t>(sample[1])] +
      this->Address[2][static_cast<std::size_t>(sample[2])];
  }

  std::size_t GetNumberOfBricks() const { return this->NumberOfBricks.load(); }
  std::size_t GetMaximumNumberOfBricks() const { return this->States.size(); }

  std::size_t GetMemory() const
  {
    std::size_t memory =
      this->NumberOfBricks.load() * Count({ this->Size, this->Size, this->Size }) * sizeof(Value);
    for (const auto& table : this->Address)
    {
      memory += table.size() * sizeof(std::size_t);
    }
    return memory + this->States.size();
  }

private:
  enum State : unsigned char
  {
    Absent,
    BeingFilled,
    Filled
  };

  void RequireBrick(const Index3& index)
  {
    std::atomic<unsigned char>& state = this->States[Offset(index, this->BrickDimensions)];
    unsigned char found = state.load(std::memory_order_acquire);
    if (found == Absent &&
      state.compare_exchange_strong(found, BeingFilled, std::memory_order_acq_rel))
    {
      const BuildTimer timer;
      this->FillBrick(index);
      this->NumberOfBricks.fetch_add(1, std::memory_order_relaxed);
      state.store(Filled, std::memory_order_release);
      return;
    }
    while (found != Filled)
    {
      std::this_thread::yield();
      found = state.load(std::memory_order_acquire);
    }
  }

  void FillBrick(const Index3& index)
  {
    const Index3& dimensions = this->TheSamples.GetDimensions();
    const int size = this->Size;
    const int xEnd = std::min((index[0] + 1) * size, dimensions[0]);
    const int yEnd = std::min((index[1] + 1) * size, dimensions[1]);
    const int zEnd = std::min((index[2] + 1) * size, dimensions[2]);
    const std::ptrdiff_t stride = this->TheSamples.GetStride(0);
    for (int z = index[2] * size; z < zEnd; ++z)
    {
      for (int y = index[1] * size; y < yEnd; ++y)
      {
        const T* from = this->TheSamples.At({ 0, y, z });
        for (int x = index[0] * size; x < xEnd; ++x)
        {
          this->Values[this->GetAddress({ x, y, z })] = static_cast<Value>(from[x * stride]);
        }
      }
    }
  }

  Samples<T> TheSamples;
  int Size;
  Index3 BrickDimensions;
  /// The tables Fx, Fy and Fz.
  std::array<std::vector<std::size_t>, 3> Address;
  /// Null if there was no memory: then rays read the array of the user.
  std::unique_ptr<Value[]> Values;
  std::vector<std::atomic<unsigned char>> States;
  std::atomic<std::size_t> NumberOfBricks{ 0 };
};

}

#endif
