// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Whether a mesh joins in a cell what the trilinear interpolant joins.

#ifndef vtkIsosurfaceComparisonTopology_h
#define vtkIsosurfaceComparisonTopology_h

#include "vtkType.h"

class vtkImageData;
class vtkPolyData;

namespace vtkIsosurfaceComparison
{

struct TopologyCount
{
  /// The cells whose corners inside are not all joined by edges inside, or those outside by edges
  /// outside: their signs alone do not tell how the surface runs.
  vtkIdType AmbiguousCells = 0;
  /// Those of them in which the mesh parts the eight corners otherwise than the isosurface does:
  /// two corners are together if a path inside the cell joins them without crossing the surface.
  vtkIdType Differences = 0;
};

/// Cells with a corner that is exactly at the isovalue, or is not a number, are left out: there the
/// triangles touch corners, and to which edge they belong cannot be told. The mesh is of triangles
/// whose vertices are on the edges of cells.
TopologyCount CompareTopology(vtkImageData* image, double isovalue, vtkPolyData* mesh);

}

#endif
