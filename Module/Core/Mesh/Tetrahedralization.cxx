// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/Tetrahedralization.h"

#include "Math/ThreadsOfLoop.h"
#include "Mesh/CellSubdivision.h"
#include "Mesh/MeshCell.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// So many cells are counted, and split, by one thread at once.
constexpr std::int64_t CellsOfBlock = 4096;

/// The number of tetrahedra before each block of cells, and that of all.
std::vector<std::int64_t> CountBeforeBlocks(const MeshCells& cells, int threads)
{
  const std::int64_t end = cells.GetNumberOfCells();
  const std::int64_t blocks = (end + CellsOfBlock - 1) / CellsOfBlock;
  std::vector<std::int64_t> counts(static_cast<std::size_t>(blocks) + 1, 0);
  const int worth = GetThreadsOfLoop(static_cast<std::size_t>(end), 1.0, threads);
#pragma omp parallel for schedule(static) num_threads(worth)
  for (std::int64_t block = 0; block < blocks; ++block)
  {
    const std::int64_t last = std::min((block + 1) * CellsOfBlock, end);
    std::int64_t count = 0;
    for (std::int64_t i = block * CellsOfBlock; i < last; ++i)
    {
      count += CountTetrahedra(cells.GetShape(i));
    }
    counts[static_cast<std::size_t>(block) + 1] = count;
  }
  std::partial_sum(counts.begin(), counts.end(), counts.begin());
  return counts;
}

/// Finds the corners of the tetrahedra of a cell whose ids were read, as numbers within it. Returns
/// how many tetrahedra there are.
int Split(const MeshCells& cells, MeshCell& cell, int (&corners)[MaximumTetrahedra][4])
{
  if (cell.Shape == CellShape::Tetrahedron)
  {
    std::iota(corners[0], corners[0] + 4, 0);
    return 1;
  }
  cells.LoadPoints(cell);
  return SubdivideCell(cell, corners);
}

}

//------------------------------------------------------------------------------
bool AreAllTetrahedra(const MeshCells& cells)
{
  const std::int64_t end = cells.GetNumberOfCells();
  std::int64_t i = 0;
  while (i < end && CountTetrahedra(cells.GetShape(i)) <= 1)
  {
    ++i;
  }
  return i == end;
}

//------------------------------------------------------------------------------
std::int64_t CountTetrahedra(const MeshCells& cells, int threads)
{
  return CountBeforeBlocks(cells, threads).back();
}

//------------------------------------------------------------------------------
Tetrahedralization::Tetrahedralization(const MeshCells& cells, int threads)
{
  const std::vector<std::int64_t> before = CountBeforeBlocks(cells, threads);
  this->Cells.resize(static_cast<std::size_t>(before.back()));
  this->Connectivity.resize(4 * this->Cells.size());
  const std::int64_t end = cells.GetNumberOfCells();
  const int worth = GetThreadsOfLoop(static_cast<std::size_t>(end), 100.0, threads);
#pragma omp parallel for schedule(static) num_threads(worth)
  for (std::size_t block = 0; block < before.size() - 1; ++block)
  {
    const std::int64_t first = static_cast<std::int64_t>(block) * CellsOfBlock;
    auto number = static_cast<std::size_t>(before[block]);
    for (std::int64_t i = first; i < std::min(first + CellsOfBlock, end); ++i)
    {
      MeshCell cell;
      if (!cells.LoadIds(i, cell))
      {
        continue;
      }
      int corners[MaximumTetrahedra][4];
      const int count = Split(cells, cell, corners);
      for (int k = 0; k < count; ++k, ++number)
      {
        this->Cells[number] = static_cast<std::uint32_t>(i);
        std::transform(corners[k], corners[k] + 4, this->Connectivity.data() + 4 * number,
          [&cell](int corner) { return cell.Ids[corner]; });
      }
    }
  }
}

//------------------------------------------------------------------------------
MeshView Tetrahedralization::MakeView(const MeshView& mesh) const
{
  MeshView view = mesh;
  view.Dimensions = { 0, 0, 0 };
  view.NumberOfCells = this->GetNumberOfTetrahedra();
  view.Shapes = nullptr;
  view.Offsets = nullptr;
  view.Connectivity = this->Connectivity.data();
  view.IdType = ScalarType::Int64;
  view.ShapeOfAll = static_cast<unsigned char>(CellShape::Tetrahedron);
  view.CornersOfAll = 4;
  return view;
}

}
