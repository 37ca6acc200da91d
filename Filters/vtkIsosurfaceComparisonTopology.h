// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Compares the topology of a mesh with that of the trilinear interpolant, cell by cell.

#ifndef vtkIsosurfaceComparisonTopology_h
#define vtkIsosurfaceComparisonTopology_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkType.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

struct TopologyCount
{
  /// The cells whose inside corners are not all connected by edges between inside corners, or whose
  /// outside corners by edges between outside ones: their signs do not determine the topology.
  vtkIdType AmbiguousCells = 0;
  /// Ambiguous cells in which the mesh connects other corners than the isosurface: two corners are
  /// connected if there is a path between them inside the cell that does not cross the surface.
  vtkIdType Differences = 0;
};

/// Cells with a corner that is exactly at the isovalue, or is not a number, are left out: triangles
/// that touch a corner cannot be assigned to an edge. The vertices of the triangles must be on
/// edges of cells.
TopologyCount CompareTopology(vtkImageData* image, double isovalue, vtkPolyData* mesh);

}

#endif
