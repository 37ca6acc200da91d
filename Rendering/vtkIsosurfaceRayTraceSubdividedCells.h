// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a grid, listed anew: those of shapes that are not traced (quadratic cells, polyhedra
// and others) in parts that are, the others as they are.

#ifndef vtkIsosurfaceRayTraceSubdividedCells_h
#define vtkIsosurfaceRayTraceSubdividedCells_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include <cstdint> // for std::int64_t
#include <string>  // for std::string
#include <vector>  // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkUnstructuredGrid;

struct vtkIsosurfaceRayTraceSubdividedCells
{
  /// Lists the cells of a grid of which the lists were checked. Returns what is wrong with a cell;
  /// else empty.
  std::string Subdivide(vtkUnstructuredGrid* grid, int threads);

  /// As those of a MeshView. Centres are numbered behind the points of the grid.
  std::vector<unsigned char> Shapes;
  std::vector<std::int64_t> Offsets;
  std::vector<std::int64_t> Connectivity;
  /// The id in the grid of each cell, or of the one that it is a part of.
  std::vector<vtkIdType> Ids;
  /// The points of each polyhedron that has its centre, their mean, as one more point.
  std::vector<std::vector<vtkIdType>> Centers;
  /// The first polyhedron whose hull is listed instead of it, or less than 0.
  vtkIdType FirstHull = -1;
};

VTK_ABI_NAMESPACE_END

#endif
