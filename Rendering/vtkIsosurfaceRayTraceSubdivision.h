// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Cells of a type that is not traced, in parts that are: the tetrahedra of vtkCell::Triangulate, if
// they fill the cell and cut faces as those of its neighbours do; they are asked for once if they
// do not depend on the cell. Those of VTK 9.1 do not fill VTK_TRIQUADRATIC_HEXAHEDRON and some
// others, and those of Lagrange and Bezier hexahedra and wedges cut faces otherwise. These are
// divided as VTK contours them, into hexahedra or wedges between neighbouring points (of Bezier
// cells, control points); where a point in the middle is missing, VTK_QUADRATIC_PYRAMID, and
// VTK_CONVEX_POINT_SET, into the tetrahedra of vtkOrderedTriangulator, which
// vtkDataSetTriangleFilter makes. Prisms are cut by the ids of their points.

#ifndef vtkIsosurfaceRayTraceSubdivision_h
#define vtkIsosurfaceRayTraceSubdivision_h

#include "vtkIsosurfaceRayTracePolyhedron.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"   // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkNew.h"                          // for ivars
#include "vtkType.h"                         // for vtkIdType

#include <array>  // for ivars
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCell;
class vtkGenericCell;
class vtkIdList;
class vtkOrderedTriangulator;
class vtkPoints;
class vtkUnstructuredGrid;

class vtkIsosurfaceRayTraceSubdivision
{
public:
  explicit vtkIsosurfaceRayTraceSubdivision(int type);
  ~vtkIsosurfaceRayTraceSubdivision();
  vtkIsosurfaceRayTraceSubdivision(const vtkIsosurfaceRayTraceSubdivision&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSubdivision&) = delete;

  ///@{
  /// Whether cells of a type have three dimensions. Others have no parts.
  static bool IsSolid(int type);
  bool IsSolid() const { return this->HasVolume; }
  ///@}

  /// Whether cells of a type have three dimensions, and Bezier's polynomials.
  static bool IsBezier(int type);

  /// Finds the ids of the corners of the parts of a cell, one part after the other, given those of
  /// its points. Returns false if the number of points is not that of the type, or of the order of
  /// the cell or its degrees, weights of its points are missing, or a face of a polyhedron has
  /// fewer than three, or others than the grid. The centre of a polyhedron is
  /// vtkIsosurfaceRayTracePolyhedron::Center.
  bool FindParts(vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* points, vtkIdList* ids);

  /// Whether the parts of the last cell are those of the convex hull of a cell that is not convex.
  bool IsHull() const { return this->HasHull; }

  int GetPartType() const { return this->PartType; }

private:
  void ChooseWay(vtkCell* reference);
  bool MayHave(vtkIdType points) const { return this->Points == 0 || this->Points == points; }
  bool DivideLattice(vtkCell* cell, int type, const std::array<int, 3>& order);
  void DivideByOrder(vtkCell* cell, const int* order);
  bool DividePolyhedron(
    vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdList* points, vtkIdList* ids);
  bool DivideCell(vtkGenericCell* cell, vtkIdList* ids);
  void TriangulatePoints(vtkCell* cell, vtkIdList* ids);

  bool HasVolume;
  /// Zero if not all cells have the same number.
  vtkIdType Points = 0;
  int PartType;
  bool IsPolyhedron = false;
  /// Of any order.
  bool IsTetrahedron = false;
  bool HasHull = false;
  bool IsPrism = false;
  bool IsTriangulatedByPoints = false;
  /// Whether all cells have the same parts.
  bool AreAlike = false;
  /// Of all cells, or of those of the last order: the numbers within the cell of the corners of the
  /// parts.
  std::vector<vtkIdType> Parts;
  /// That of the last cell, and its number of points, where cells of a type have any order.
  std::array<int, 4> Order = {};
  vtkIsosurfaceRayTracePolyhedron Polyhedron;
  /// The cell, if its type makes a difference, and the faces of a polyhedron.
  vtkNew<vtkGenericCell> Cell;
  vtkNew<vtkIdList> Faces;
  vtkNew<vtkOrderedTriangulator> Triangulator;
  vtkNew<vtkPoints> Corners;
};

VTK_ABI_NAMESPACE_END

#endif
