// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ActiveRows_h
#define ActiveRows_h

#include "Image/Macrocells/ActiveMacrocells.h"
#include "Math/Vector.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Which samples of a volume rays may read: in each row along x those from the first active
/// macrocell of the finest level to the last, and around them one more on each side, for gradients.
class ActiveRows
{
public:
  /// From the first sample to the last; none if the first is larger.
  struct Row
  {
    int First = std::numeric_limits<int>::max();
    int Last = -1;

    bool IsEmpty() const { return this->First > this->Last; }

    void Include(const Row& other)
    {
      this->First = std::min(this->First, other.First);
      this->Last = std::max(this->Last, other.Last);
    }
  };

  /// There must be macrocells.
  explicit ActiveRows(const ActiveMacrocells& active)
    : Samples{ active.GetLattice().Cells[0] + 1, active.GetLattice().Cells[1] + 1,
      active.GetLattice().Cells[2] + 1 }
    , Edge(active.GetLattice().Levels.front().Edge)
  {
    const Index3& size = active.GetLattice().Levels.front().Size;
    for (int z = 0; z < size[2]; ++z)
    {
      std::vector<Row>& layer = this->Layers.emplace_back(size[1]);
      for (int y = 0; y < size[1]; ++y)
      {
        for (int x = 0; x < size[0]; ++x)
        {
          if (active.IsActive(0, { x, y, z }))
          {
            layer[static_cast<std::size_t>(y)].Include(
              { this->GetFirst(x), this->GetLast(x, this->Samples[0]) });
          }
        }
      }
    }
  }

  /// Makes those of macrocells empty that others have as a whole. (The others are of the same
  /// volume.)
  void Remove(const ActiveRows& others)
  {
    this->ForEachPair(others,
      [](Row& row, const Row& other)
      {
        const bool isThere = other.First <= row.First && row.Last <= other.Last;
        row = isThere ? Row{} : row;
      });
  }

  /// Adds those of others.
  void Include(const ActiveRows& others)
  {
    this->ForEachPair(others, [](Row& row, const Row& other) { row.Include(other); });
  }

  /// The rows of a slice across z, in the order of y.
  std::vector<Row> GetSlice(int z) const
  {
    std::vector<Row> rows(static_cast<std::size_t>(this->Samples[1]));
    const auto layers = static_cast<int>(this->Layers.size());
    const int last = std::min((z + 1) / this->Edge, layers - 1);
    for (int layer = std::max(z - 2, 0) / this->Edge; layer <= last; ++layer)
    {
      const std::vector<Row>& ofMacrocells = this->Layers[static_cast<std::size_t>(layer)];
      for (std::size_t i = 0; i < ofMacrocells.size(); ++i)
      {
        const auto y = static_cast<int>(i);
        for (int row = this->GetFirst(y);
             !ofMacrocells[i].IsEmpty() && row <= this->GetLast(y, this->Samples[1]); ++row)
        {
          rows[static_cast<std::size_t>(row)].Include(ofMacrocells[i]);
        }
      }
    }
    return rows;
  }

private:
  template <typename Change>
  void ForEachPair(const ActiveRows& others, const Change& change)
  {
    for (std::size_t z = 0; z < this->Layers.size(); ++z)
    {
      for (std::size_t y = 0; y < this->Layers[z].size(); ++y)
      {
        change(this->Layers[z][y], others.Layers[z][y]);
      }
    }
  }

  /// The samples of a macrocell along an axis, with one more on each side.
  int GetFirst(int macrocell) const { return std::max(macrocell * this->Edge - 1, 0); }
  int GetLast(int macrocell, int samples) const
  {
    return std::min((macrocell + 1) * this->Edge + 1, samples - 1);
  }

  Index3 Samples;
  int Edge;
  /// The samples that each row of macrocells needs along x.
  std::vector<std::vector<Row>> Layers;
};

}

#endif
