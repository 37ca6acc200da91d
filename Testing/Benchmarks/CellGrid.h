// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellGrid_h
#define CellGrid_h

#include "Views.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkUnstructuredGrid;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// Tetrahedra with values at their points, for hierarchies that trace rays one by one. A ray has
/// its hit by the gradient and by barycentric coordinates, in double precision: rays may slip
/// through between two cells.
class TetrahedronList
{
public:
  /// All cells of the grid must be tetrahedra.
  explicit TetrahedronList(vtkUnstructuredGrid* grid);

  std::size_t GetSize() const { return this->Cells.size(); }

  /// x, y, z and value.
  struct Extent
  {
    std::array<float, 4> Lower;
    std::array<float, 4> Upper;
  };
  Extent GetExtent(std::size_t cell) const;

  /// Returns the t where a ray meets an isosurface in a cell; infinite if it does not.
  double Intersect(
    std::size_t cell, const Triple& origin, const Triple& direction, double isovalue) const;

private:
  using Point = std::array<float, 4>;

  std::vector<Point> Points;
  std::vector<std::array<std::uint32_t, 4>> Cells;
};

/// A uniform grid of boxes with lists of the cells that they overlap, about as many boxes as cells,
/// and the range of values in boxes of 1, 6 and 36 to an edge: how S. G. Parker et al. (1998) trace
/// images, with lists instead of samples.
class CellGrid
{
public:
  /// The cells must outlive it.
  explicit CellGrid(const TetrahedronList& cells);

  /// Returns the t of the first hit of a ray; infinite if there is none.
  double FindFirst(const Triple& origin, const Triple& direction, double isovalue) const;

  /// In bytes.
  double GetMemory() const;

private:
  static constexpr int Levels = 3;
  static constexpr int Branching = 6;

  using Index = std::array<int, 3>;

  /// Boxes, x fastest, and the ranges of their values.
  struct Level
  {
    Index Size;
    std::vector<float> Low;
    std::vector<float> High;

    std::size_t GetNumber(const Index& box) const
    {
      const auto row = static_cast<std::size_t>(this->Size[0]);
      return static_cast<std::size_t>(box[0]) +
        row * static_cast<std::size_t>(box[1] + this->Size[1] * box[2]);
    }
    void Include(std::size_t box, float low, float high);
  };

  class Walk;

  template <typename Function>
  void ForEachBox(const TetrahedronList::Extent& extent, const Function& function) const;
  void MakeLists();
  void FindRanges();

  const TetrahedronList* Cells;
  Triple Lower;
  Triple Upper;
  Triple BoxSize;
  Level Boxes[Levels];
  /// Those of a box are from its first to before the first of the next.
  std::vector<std::uint32_t> First;
  std::vector<std::uint32_t> Lists;
};

}

#endif
