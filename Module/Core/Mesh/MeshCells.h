// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCells_h
#define MeshCells_h

#include "Kernels/BeamPieces.h"
#include "Mesh/CornerOrder.h"
#include "Mesh/MeshCell.h"
#include "Mesh/MeshView.h"

#include <cstdint>
#include <string>

namespace vtkIsosurfaceRayTracing
{

/// Reads the cells of a mesh, whatever the types of its arrays are.
class MeshCells
{
public:
  explicit MeshCells(const MeshView& view);

  std::int64_t GetNumberOfCells() const { return this->NumberOfCells; }
  std::int64_t GetNumberOfPoints() const { return this->View.NumberOfPoints; }
  ScalarType GetPointType() const { return this->View.PointType; }

  /// Reads the shape and the ids of the corners. Returns whether the cell has a shape that is
  /// traced.
  bool LoadIds(std::int64_t number, MeshCell& cell) const;

  /// Begins to fetch what is read first of some consecutive cells.
  void Prefetch(std::int64_t first, int count) const;

  /// Reads the points and values of the corners whose ids are there. Returns whether they are
  /// finite.
  bool LoadCorners(MeshCell& cell) const;

  /// Both. A cell that is not to be traced returns false.
  bool Load(std::int64_t number, MeshCell& cell) const
  {
    return this->LoadIds(number, cell) && this->LoadCorners(cell);
  }

  bool IsTetrahedron(std::int64_t number) const
  {
    return !this->View.IsLattice() &&
      this->View.Shapes[number] == static_cast<unsigned char>(CellShape::Tetrahedron);
  }

  /// Reads the corners of cells that are traced and finite: all of them tetrahedra, whose order is
  /// found, or all others. In place of differences there are values.
  void LoadRecords(const std::uint32_t* numbers, int count, bool areTetrahedra, CornerOrder* orders,
    PassedCellRecords& records) const;

private:
  /// The ids of the corners of records.
  using RecordIds = std::int64_t[PassedCellRecords::Corners][PassedCellRecords::Capacity];

  void LoadLatticeIds(std::int64_t number, MeshCell& cell) const;

  MeshView View;
  std::int64_t NumberOfCells;
  std::int64_t LengthOfConnectivity = 0;
  /// For the types of the arrays.
  bool (*ReadIds)(const MeshView& view, std::int64_t number, MeshCell& cell) = nullptr;
  void (*ReadPoints)(const MeshView& view, MeshCell& cell) = nullptr;
  void (*ReadValues)(const MeshView& view, MeshCell& cell) = nullptr;
  void (*ReadTetrahedra)(const MeshView& view, const std::uint32_t* numbers, int count,
    CornerOrder* orders, RecordIds& ids) = nullptr;
  void (*ReadRecordPoints)(const MeshView& view, const RecordIds& ids, int corners, int count,
    PassedCellRecords& records) = nullptr;
  void (*ReadRecordValues)(const MeshView& view, const RecordIds& ids, int corners, int count,
    PassedCellRecords& records) = nullptr;
};

/// What is wrong with the list of cells of a mesh, as a sentence that names the first bad cell;
/// empty if nothing is. Everything that reading cells relies on is checked: the number of corners
/// of each, and that there is a point of every id. The length of the connectivity is that which
/// its owner allocated.
std::string FindProblem(const MeshView& view, std::int64_t lengthOfConnectivity, int threads);

}

#endif
