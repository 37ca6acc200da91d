// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells of a grid as they are traced: where they are, or listed anew, if some are divided into
// parts of shapes that are traced, or all are split into tetrahedra.

#ifndef vtkIsosurfaceRayTraceTracedCells_h
#define vtkIsosurfaceRayTraceTracedCells_h

#include "vtkIsosurfaceRayTraceSubdividedCells.h" // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"        // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                              // for vtkIdType

#include "Mesh/MeshView.h"
#include "Mesh/Tetrahedralization.h"

#include <cstdint>  // for std::int64_t
#include <optional> // for ivars
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkDataSet;
class vtkIsosurfaceRayTraceReadArrays;
class vtkPointSet;
class vtkStructuredGrid;
class vtkUnstructuredGrid;

class vtkIsosurfaceRayTraceTracedCells
{
public:
  /// Whether a grid has cells of three dimensions.
  static bool HasVolume(vtkDataSet* grid);

  /// Finds the cells of a grid. Returns why they cannot be traced, or split into tetrahedra if that
  /// is to follow; else empty. Those of all shapes are checked if VTK itself reads them.
  std::string Select(vtkPointSet* grid, bool isTetrahedralized, bool areAllRead, int threads,
    vtkIsosurfaceRayTraceReadArrays& arrays);

  /// The cells, and the number of points; no arrays of these.
  const vtkIsosurfaceRayTracing::MeshView& GetView() const { return this->View; }

  /// Splits the cells into tetrahedra, given a view of the mesh with its points, and lists these in
  /// it. Does nothing if all are tetrahedra.
  void Tetrahedralize(vtkIsosurfaceRayTracing::MeshView& view, int threads);

  /// Whether some cells may be parts of cells of the grid.
  bool MayBeParts() const { return this->Tetrahedra.has_value() || this->Parts.has_value(); }
  /// The id in the grid of a cell, or of the one that it is a part of.
  vtkIdType FindId(std::int64_t cell) const
  {
    const std::int64_t whole = this->Tetrahedra ? this->Tetrahedra->GetCell(cell) : cell;
    return this->Parts ? this->Parts->Ids[static_cast<std::size_t>(whole)] : whole;
  }
  int GetShape(std::int64_t cell) const { return static_cast<int>(this->View.GetShape(cell)); }

  ///@{
  /// Polyhedra may have their centre as one more point, after those of the grid: the mean of their
  /// own. AddMeans adds what centres have to an array of the points.
  bool HaveCenters() const { return this->Parts && !this->Parts->Centers.empty(); }
  std::int64_t CountPointsOfGrid() const;
  void AddMeans(vtkDataArray* array) const;
  double FindMean(std::int64_t center, vtkDataArray* array, int component) const;
  ///@}

  /// What is not traced as it is; empty if nothing is.
  std::string GetWarning() const;

private:
  std::string SelectLattice(vtkStructuredGrid* grid);
  std::string SelectListed(vtkUnstructuredGrid* grid, bool areAllRead, int threads,
    vtkIsosurfaceRayTraceReadArrays& arrays);
  void ViewListed(vtkUnstructuredGrid* grid, vtkIsosurfaceRayTraceReadArrays& arrays);
  std::string Subdivide(vtkUnstructuredGrid* grid, int threads);

  vtkIsosurfaceRayTracing::MeshView View;
  /// Lists of cells that cannot be read where they are.
  std::vector<std::int64_t> Offsets;
  std::vector<std::int64_t> Connectivity;
  /// The cells, if some had to be subdivided.
  std::optional<vtkIsosurfaceRayTraceSubdividedCells> Parts;
  /// What all of these are split into, if they are.
  std::optional<vtkIsosurfaceRayTracing::Tetrahedralization> Tetrahedra;
};

VTK_ABI_NAMESPACE_END

#endif
