// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Tetrahedralization_h
#define Tetrahedralization_h

#include "Mesh/MeshCells.h"
#include "Mesh/MeshView.h"

#include <cstdint>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// Whether no other cells are traced.
bool AreAllTetrahedra(const MeshCells& cells);

/// How many tetrahedra the cells of a mesh are split into. The arrays of the points are not read.
std::int64_t CountTetrahedra(const MeshCells& cells, int threads = 1);

/// The cells of a mesh, split into tetrahedra by SubdivideCell, one cell after the other. Those
/// that are tetrahedra stay as they are.
class Tetrahedralization
{
public:
  explicit Tetrahedralization(const MeshCells& cells, int threads = 1);

  /// The mesh with these cells instead of its own. They are read here.
  MeshView MakeView(const MeshView& mesh) const;

  std::int64_t GetNumberOfTetrahedra() const
  {
    return static_cast<std::int64_t>(this->Cells.size());
  }
  /// The cell that a tetrahedron is a part of.
  std::int64_t GetCell(std::int64_t tetrahedron) const
  {
    return this->Cells[static_cast<std::size_t>(tetrahedron)];
  }

private:
  /// The ids of the corners, four of each tetrahedron.
  std::vector<std::int64_t> Connectivity;
  std::vector<std::uint32_t> Cells;
};

}

#endif
