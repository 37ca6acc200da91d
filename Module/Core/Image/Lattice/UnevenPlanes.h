// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef UnevenPlanes_h
#define UnevenPlanes_h

#include "Kernels/LatticePlanes.h"
#include "Math/Vector.h"

#include <algorithm>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Where the lattice planes of a volume stand whose samples are not evenly spaced.
///
/// Rays are straight lines in the space of these coordinates. A cell is a box there, and its
/// interpolant is trilinear in the coordinates of the box, so that all that is said of a ray in a
/// cell holds as it does where planes stand at whole numbers. The first plane of an axis stands at
/// 0 and the last, plane n, at n: the mean spacing is 1, and the box of the volume is the same as
/// with even spacing.
///
/// Coordinates never decrease. Where two planes coincide, the cell between them is flat: a ray
/// crosses it at one t, from one face to the other, and meets a surface there if it has one.
class UnevenPlanes
{
public:
  /// At least two coordinates for each axis, non-decreasing from 0 to the number of the last plane.
  explicit UnevenPlanes(std::array<std::vector<double>, 3> coordinates)
    : Coordinates(std::move(coordinates))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int planes = static_cast<int>(this->Coordinates[axis].size());
      for (int plane = 0; plane < planes; ++plane)
      {
        const double below = plane > 0 ? this->GetWidth(axis, plane - 1) : 0.0;
        const double above = plane < planes - 1 ? this->GetWidth(axis, plane) : 0.0;
        this->Slopes[axis].push_back(ParabolaWeights(below, above));
      }
      this->AddBlocks(axis);
      this->AddFirstCells(axis);
    }
  }

  /// The coordinate of a plane. Beyond the last plane it is that of the last: macrocells may extend
  /// further.
  double Get(std::size_t axis, int plane) const
  {
    const std::vector<double>& coordinates = this->Coordinates[axis];
    return coordinates[std::min(static_cast<std::size_t>(plane), coordinates.size() - 1)];
  }

  double GetWidth(std::size_t axis, int cell) const
  {
    return this->Get(axis, cell + 1) - this->Get(axis, cell);
  }

  bool IsFlat(const Index3& cell) const
  {
    return !(this->GetWidth(0, cell[0]) > 0.0 && this->GetWidth(1, cell[1]) > 0.0 &&
      this->GetWidth(2, cell[2]) > 0.0);
  }

  /// Whether the first or the last cells along an axis are flat.
  bool HasFlatBorder() const
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = static_cast<int>(this->Coordinates[axis].size()) - 2;
      if (!(this->GetWidth(axis, 0) > 0.0 && this->GetWidth(axis, last) > 0.0))
      {
        return true;
      }
    }
    return false;
  }

  /// The weights of the differences of a field to the plane below and to the plane above in its
  /// slope at a plane: that of the parabola through the three values.
  struct SlopeWeights
  {
    double Below;
    double Above;
  };

  const SlopeWeights& GetSlopeWeights(std::size_t axis, int plane) const
  {
    return this->Slopes[axis][static_cast<std::size_t>(plane)];
  }

  /// The cell that contains a coordinate; in a plane, the cell above it. Outside the volume, the
  /// nearest cell.
  int FindCell(std::size_t axis, double coordinate) const
  {
    return this->FindCellIn(axis, coordinate, this->FindCells(axis, coordinate));
  }

  /// The block that contains a coordinate, of blocks of two to some power of cells. Outside the
  /// volume and in its first plane, where cells may be flat, the nearest block.
  int FindBlock(std::size_t axis, double coordinate, int power) const
  {
    if (!(coordinate > 0.0))
    {
      return 0;
    }
    const CellRange cells = this->FindCells(axis, coordinate);
    const int first = cells.First >> power;
    return first == cells.Last >> power ? first : this->FindCell(axis, coordinate) >> power;
  }

  /// The same for kernels; valid as long as this is.
  LatticePlanes GetLatticePlanes() const
  {
    LatticePlanes planes;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      planes.Coordinates[axis] = this->Coordinates[axis].data();
      planes.Blocks[axis] = this->Blocks[axis].data();
    }
    return planes;
  }

  /// A point given in the coordinates of a cell.
  Vector3 GetPoint(const Index3& cell, const Vector3& parametric) const
  {
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] =
        this->Get(axis, cell[axis]) + parametric[axis] * this->GetWidth(axis, cell[axis]);
    }
    return point;
  }

private:
  /// The slope is the mean of those to both sides, of which the nearer counts more. (The rise
  /// between the neighbours over their distance would be off by half the difference of the two
  /// widths, times the second derivative, which is visible.) At the border of the volume and beside
  /// a flat cell, it is the slope to the other side.
  static SlopeWeights ParabolaWeights(double below, double above)
  {
    if (below > 0.0 && above > 0.0)
    {
      return { above / (below + above) / below, below / (below + above) / above };
    }
    return { below > 0.0 ? 1.0 / below : 0.0, above > 0.0 ? 1.0 / above : 0.0 };
  }

  struct CellRange
  {
    int First;
    int Last;
  };

  /// Those that may contain a coordinate.
  CellRange FindCells(std::size_t axis, double coordinate) const
  {
    const std::vector<int>& cells = this->FirstCells[axis];
    const double last = static_cast<double>(cells.size()) - 2.0;
    const auto below =
      static_cast<std::size_t>(coordinate > 0.0 ? std::min(coordinate, last) : 0.0);
    return { cells[below], cells[below + 1] };
  }

  int FindCellIn(std::size_t axis, double coordinate, const CellRange& cells) const
  {
    const auto planes = this->Coordinates[axis].begin() + 1;
    return static_cast<int>(
      std::upper_bound(planes + cells.First, planes + cells.Last, coordinate) - planes);
  }

  void AddFirstCells(std::size_t axis)
  {
    const auto lastCell = static_cast<int>(this->Coordinates[axis].size()) - 2;
    for (int coordinate = 0; coordinate <= lastCell + 1; ++coordinate)
    {
      this->FirstCells[axis].push_back(this->FindCellIn(axis, coordinate, { 0, lastCell }));
    }
  }

  void AddBlocks(std::size_t axis)
  {
    const auto cells = static_cast<int>(this->Coordinates[axis].size()) - 1;
    for (int first = 0; first < cells; first += BlockPlanes::Edge)
    {
      this->Blocks[axis].push_back(this->MakeBlock(axis, first));
    }
  }

  BlockPlanes MakeBlock(std::size_t axis, int first) const
  {
    BlockPlanes block;
    block.First = this->Get(axis, first);
    block.Extent = this->Get(axis, first + BlockPlanes::Edge) - block.First;
    for (int i = 0; i <= BlockPlanes::Edge; ++i)
    {
      block.Planes[i] = static_cast<float>(this->Get(axis, first + i) - block.First);
    }
    for (int i = 0; i < BlockPlanes::Edge; ++i)
    {
      const double width = this->GetWidth(axis, first + i);
      block.Cells[i] = { block.Planes[i], static_cast<float>(width),
        static_cast<float>(1.0 / width), static_cast<float>(block.Extent) };
    }
    return block;
  }

  std::array<std::vector<double>, 3> Coordinates;
  std::array<std::vector<SlopeWeights>, 3> Slopes;
  /// The cell that contains each whole coordinate.
  std::array<std::vector<int>, 3> FirstCells;
  std::array<std::vector<BlockPlanes>, 3> Blocks;
};

}

#endif
