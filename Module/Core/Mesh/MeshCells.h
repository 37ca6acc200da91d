// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshCells_h
#define MeshCells_h

#include "Kernels/BeamPieces.h"
#include "Kernels/MeshCellArrays.h"
#include "Math/Compiler.h"
#include "Mesh/CornerOrder.h"
#include "Mesh/MeshCell.h"
#include "Mesh/MeshView.h"
#include "Rays/RayPacket.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace vtkIsosurfaceRayTracing
{

/// Reads the cells of a mesh, whatever the types of its arrays are.
class MeshCells
{
public:
  explicit MeshCells(const MeshView& view, int threads = 1);

  std::int64_t GetNumberOfCells() const { return this->NumberOfCells; }
  std::int64_t GetNumberOfPoints() const { return this->View.NumberOfPoints; }
  ScalarType GetPointType() const { return this->View.PointType; }

  int GetNumberOfComponents() const { return this->View.NumberOfComponents; }
  /// The same cells, of which a component is traced.
  MeshCells OfComponent(int component) const;

  /// Reads the shape and the ids of the corners. Returns whether the cell has a shape that is
  /// traced.
  bool LoadIds(std::int64_t number, MeshCell& cell) const;

  /// The same, given a place for eight ids. Returns the shape; if it is not traced, nothing is
  /// read.
  CellShape LoadIds(std::int64_t number, std::int64_t* ids) const;

  /// Reads the points and values of the corners whose ids are there. Returns whether they are
  /// finite.
  bool LoadCorners(MeshCell& cell) const;

  /// Reads the points, or the values, alone.
  void LoadPoints(MeshCell& cell) const { this->ReadPoints(this->View, cell); }
  void LoadValues(MeshCell& cell) const { this->ReadValues(this->View, cell); }

  /// Reads the values of all components at the corners of a cell of which the ids are there.
  void LoadComponents(const MeshCell& cell, double (*values)[MaximumCorners]) const
  {
    this->ReadComponents(this->View, cell, values);
  }

  /// Both ids and corners. A cell that is not to be traced returns false.
  bool Load(std::int64_t number, MeshCell& cell) const
  {
    return this->LoadIds(number, cell) && this->LoadCorners(cell);
  }

  CellShape GetShape(std::int64_t number) const { return this->View.GetShape(number); }
  /// Whether all have this shape.
  bool AreTetrahedra() const
  {
    return static_cast<CellShape>(this->View.ShapeOfAll) == CellShape::Tetrahedron;
  }

  /// Finds which of up to 16 cells have values on both sides of an isovalue, below it and at or
  /// above it; a bit for each. Cells that are not finite may be among them.
  unsigned int FindStraddling(const std::uint32_t* numbers, int count, double isovalue) const
  {
    return this->ReadStraddling(*this, numbers, count, isovalue);
  }

  /// Begins to fetch the ids of a cell's corners, if they are where they should be.
  void Prefetch(std::int64_t number) const
  {
    const char* ids =
      static_cast<const char*>(this->View.Connectivity) + number * this->BytesOfCell;
    PrefetchLine(ids);
    // Those of lattices are nowhere, and have no size.
    PrefetchLine(ids + std::max<std::int64_t>(this->BytesOfCell - 1, 0));
  }

  /// Reads the ids of the corners of tetrahedra, in their order, and begins to fetch the points and
  /// the values.
  void ReadCornerIds(
    const std::uint32_t* numbers, int count, CornerOrder* orders, std::int64_t (*ids)[4]) const;

  /// Reads the ids of the corners of as many tetrahedra as there are pairs, or of as many cells of
  /// any shape, as corners of trilinear cells.
  void LoadIdsOfTetrahedra(const std::uint32_t* numbers, int count, std::int64_t (*ids)[4]) const
  {
    this->ReadTetrahedra(this->View, numbers, count, ids);
  }
  void LoadTrilinearIds(
    const std::uint32_t* numbers, int count, std::int64_t (*ids)[PassedCellRecords::Corners]) const
  {
    this->ReadTrilinear(this->View, numbers, count, ids);
  }

  /// Finds the points of hits, and stores them from a number on.
  void InterpolatePoints(
    const WeightedCorners& corners, int first, double (*points)[RayPacket::Capacity]) const;

  /// The ids of the corners of a cell and those that follow it, where they are in memory as 64-bit
  /// numbers, 4 or 8 for each; else null.
  const std::int64_t* FindIdsInPlace(std::int64_t number) const
  {
    const std::int64_t corners = this->View.CornersOfAll;
    const bool areInPlace = this->View.IdType == ScalarType::Int64 &&
      (corners == 4 || corners == 8) &&
      corners == GetTraits(static_cast<CellShape>(this->View.ShapeOfAll)).Corners;
    return areInPlace ? static_cast<const std::int64_t*>(this->View.Connectivity) + corners * number
                      : nullptr;
  }

  /// What the ids are of.
  PointArrays GetPointArrays() const
  {
    return { this->View.Points, this->View.PointType == ScalarType::Float32, this->View.Values,
      this->View.ValueStride };
  }
  ScalarType GetValueType() const { return this->View.ValueType; }

  /// Reads cells that are traced and finite: their corners, and in place of differences the values.
  /// Tetrahedra, as many as there are pairs...
  void LoadTetrahedra(const std::uint32_t* numbers, int count, double (*corners)[4][4]) const;
  /// ...or those with the given ids of corners.
  void LoadTetrahedra(const std::int64_t (*ids)[4], int count, double (*corners)[4][4]) const;
  /// The same of as many cells of any shape, as in PassedCellRecords.
  void LoadTrilinear(const std::uint32_t* numbers, int count,
    double (*corners)[PassedCellRecords::Corners][4]) const;
  void LoadTrilinear(const std::int64_t (*ids)[PassedCellRecords::Corners], int count,
    double (*corners)[PassedCellRecords::Corners][4]) const;

private:
  /// The largest number of cells that are read at once.
  static constexpr int MaximumCells = TetrahedronPairs::Capacity;

  CellShape LoadLatticeIds(std::int64_t number, std::int64_t* ids) const;
  void PrefetchPoints(const std::int64_t* ids, int count) const;
  template <typename Id, typename Value>
  static unsigned int FindListedStraddling(
    const MeshCells& cells, const std::uint32_t* numbers, int count, double isovalue);
  template <typename Value>
  static unsigned int FindLatticeStraddling(
    const MeshCells& cells, const std::uint32_t* numbers, int count, double isovalue);

  MeshView View;
  std::int64_t NumberOfCells;
  /// The mean size of a listed cell in the connectivity.
  std::int64_t BytesOfCell = 0;
  /// From one to the next, in memory.
  std::int64_t BytesOfPoint = 0;
  std::int64_t BytesOfValue = 0;
  /// For the types of the arrays.
  CellShape (*ReadIds)(const MeshView& view, std::int64_t number, std::int64_t* ids) = nullptr;
  void (*ReadPoints)(const MeshView& view, MeshCell& cell) = nullptr;
  void (*ReadValues)(const MeshView& view, MeshCell& cell) = nullptr;
  void (*ReadComponents)(
    const MeshView& view, const MeshCell& cell, double (*values)[MaximumCorners]) = nullptr;
  unsigned int (*ReadStraddling)(
    const MeshCells& cells, const std::uint32_t* numbers, int count, double isovalue) = nullptr;
  void (*ReadTetrahedra)(const MeshView& view, const std::uint32_t* numbers, int count,
    std::int64_t (*ids)[4]) = nullptr;
  void (*ReadOrderedTetrahedra)(const MeshView& view, const std::uint32_t* numbers, int count,
    CornerOrder* orders, std::int64_t (*ids)[4]) = nullptr;
  void (*ReadTrilinear)(const MeshView& view, const std::uint32_t* numbers, int count,
    std::int64_t (*ids)[PassedCellRecords::Corners]) = nullptr;
  void (*ReadCornerPoints)(
    const MeshView& view, const std::int64_t* ids, int count, double (*corners)[4]) = nullptr;
  void (*ReadCornerValues)(
    const MeshView& view, const std::int64_t* ids, int count, double (*corners)[4]) = nullptr;
};

/// Which cells of a list are looked at: those of other shapes may refer to anything if nobody reads
/// them.
enum class CheckedCells
{
  Traced,
  All
};

/// What is wrong with the list of cells of a mesh, as a sentence that names the first bad cell;
/// empty if nothing is. Everything that reading cells relies on is checked: the number of corners
/// of each, and that there is a point of every id. The length of the connectivity is that which
/// its owner allocated.
std::string FindProblem(const MeshView& view, std::int64_t lengthOfConnectivity, int threads,
  CheckedCells checked = CheckedCells::Traced);

}

#endif
