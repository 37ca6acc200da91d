// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshView_h
#define MeshView_h

#include "Field/ScalarType.h"
#include "Math/Vector.h"

#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// The shapes of cells that are traced, by VTK's numbers and with VTK's order of corners. Cells of
/// other shapes are passed over.
enum class CellShape : unsigned char
{
  Tetrahedron = 10,
  Voxel = 11,
  Hexahedron = 12,
  Wedge = 13,
  Pyramid = 14
};

/// A mesh in the memory of its owner. Nothing is copied, nothing is owned.
///
/// The cells are either listed (an unstructured grid), or hexahedra between the points of a lattice
/// (a curvilinear grid), x fastest.
struct MeshView
{
  /// The coordinates x, y, z of all points, as Float32 or Float64.
  const void* Points = nullptr;
  ScalarType PointType = ScalarType::Float32;
  std::int64_t NumberOfPoints = 0;

  /// The values at the points.
  const void* Values = nullptr;
  ScalarType ValueType = ScalarType::Float32;
  /// The distance between the values of neighbours, in values (the number of interleaved
  /// components).
  std::ptrdiff_t ValueStride = 1;
  /// The values of all components at the first point, for clouds of so many: Values are those of
  /// one of them. Null for one component.
  const void* Components = nullptr;
  int NumberOfComponents = 1;

  /// Of listed cells, their shapes, and the ids of their corners: those of cell i are from
  /// Connectivity[Offsets[i]] to before Connectivity[Offsets[i + 1]]. Both are Int32 or Int64. They
  /// must be valid: see FindProblem in MeshCells.h.
  const unsigned char* Shapes = nullptr;
  const void* Offsets = nullptr;
  const void* Connectivity = nullptr;
  ScalarType IdType = ScalarType::Int64;
  std::int64_t NumberOfCells = 0;
  /// If all listed cells have as many corners, how many; and if all have one shape, which: then the
  /// offsets and the shapes are not read, and may be null. MeshCells finds both if they are 0.
  std::int64_t CornersOfAll = 0;
  unsigned char ShapeOfAll = 0;

  /// Of a lattice, the number of points along each axis; zero for listed cells.
  Index3 Dimensions = { 0, 0, 0 };

  bool IsLattice() const { return this->Dimensions[0] > 0; }

  CellShape GetShape(std::int64_t cell) const
  {
    if (this->IsLattice())
    {
      return CellShape::Hexahedron;
    }
    return static_cast<CellShape>(this->ShapeOfAll != 0 ? this->ShapeOfAll : this->Shapes[cell]);
  }
};

}

#endif
