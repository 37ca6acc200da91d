// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Measures the distance of a surface from the isosurface of the trilinear interpolant.

#ifndef vtkIsosurfaceComparisonErrors_h
#define vtkIsosurfaceComparisonErrors_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkDataSet;
class vtkPoints;
class vtkPolyData;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

class TracedIsosurface;
struct Row;

/// One for each point of a surface, NaN where no isosurface was found.
struct SurfaceErrors
{
  std::vector<double> Cells;
  std::vector<double> World;
  /// Degrees, 0 to 90. NaN too where the surface has no normal.
  std::vector<double> Angles;
};

/// Measures points of a surface that have normals, of any length and sign (0 for none).
///
/// The distance is measured along the gradient of the interpolant at the point, to the nearest
/// crossing of the isosurface; or to the nearest crossing of an edge of the cell, if that is nearer
/// (near a saddle the gradient does not point at the surface). It is never smaller than the true
/// distance. Points outside of an image are measured by way of its border; those outside of all
/// cells of a mesh are lost. Returns early, with the rest NaN, if it is told to stop.
SurfaceErrors MeasureErrors(vtkDataSet* data, TracedIsosurface& isosurface, double isovalue,
  vtkPoints* points, vtkDataArray* normals, const std::function<bool()>& isAborted);

/// The triangles whose vertices are all finite: near samples that are not, VTK generates others.
/// The vertices keep their ids; those that are not finite are moved to a finite point, and no
/// triangle uses them.
vtkSmartPointer<vtkPolyData> FiniteTriangles(vtkPolyData* mesh, const double place[3]);

/// The mesh with each triangle split into three at its centroid: the vertices are on edges of
/// cells, where linear interpolation is exact, so that the error is inside. First come the points
/// of the mesh, then a centroid for each triangle.
vtkSmartPointer<vtkPolyData> CutAtCentroids(vtkPolyData* mesh);

/// For the points of CutAtCentroids(mesh): the normal of the triangle for a centroid, else 0.
vtkSmartPointer<vtkDataArray> NormalsOfCentroids(vtkPolyData* mesh);

/// Fills in distances, normal errors and lost points of a row from the points from the first on.
void Summarize(const SurfaceErrors& errors, std::size_t first, Row& row);

}

#endif
