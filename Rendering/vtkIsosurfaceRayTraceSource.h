// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The field that a mapper traces: made from the scalars of an image or a rectilinear grid, and kept
// while they are the same.

#ifndef vtkIsosurfaceRayTraceSource_h
#define vtkIsosurfaceRayTraceSource_h

#include "vtkIsosurfaceRayTraceGeometry.h" // for ivars
#include "vtkIsosurfaceRayTraceLevel.h"    // for arguments
#include "vtkIsosurfaceRayTraceScalars.h"  // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Image/CoarseLevel.h"
#include "Image/ImageField.h"

#include <memory> // for std::unique_ptr
#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkDataSet;
class vtkIsosurfaceRayTraceMacrocellCache;

class vtkIsosurfaceRayTraceSource
{
public:
  vtkIsosurfaceRayTraceSource();
  ~vtkIsosurfaceRayTraceSource();
  vtkIsosurfaceRayTraceSource(const vtkIsosurfaceRayTraceSource&) = delete;
  void operator=(const vtkIsosurfaceRayTraceSource&) = delete;

  /// The problem with the input, or with a block before it is joined with others; empty if there is
  /// none.
  static std::string FindProblem(vtkDataSet* grid, const vtkIsosurfaceRayTraceScalars& selection);

  /// Why a grid has too few samples; empty if it has enough.
  static std::string FindProblemOfSize(vtkDataSet* grid, bool areOfCells);

  /// Makes the field of the input, which must have no problem, unless it is up to date. Returns
  /// whether it had to be made: then its samples are still to be read. Where they are in a file,
  /// macrocells are kept in a directory and taken from there, unless it has no name.
  bool Update(vtkDataSet* grid, const vtkIsosurfaceRayTraceScalars& selection,
    const vtkIsosurfaceRayTracing::ImageSettings& settings, const std::string& cacheDirectory,
    int threads);

  /// Selects the field, after Update. Where that is a coarse level which is not complete, reads
  /// more of it: samples must be intact. Returns whether the field is another.
  bool SelectLevel(vtkIsosurfaceRayTraceLevel level, int threads);

  /// Whether a coarse level is selected, and the scale of the object space of the grid in its.
  bool IsCoarse() const { return this->AtCoarse; }
  const vtkIsosurfaceRayTracing::Vector3& GetCoarseScale() const
  {
    return this->Coarse->GetScale();
  }

  ///@{
  /// Reads the next slab of samples, which must be intact, and not all read. The fraction is that
  /// of all samples, whatever is selected.
  void ReadSlab(int threads);
  double GetFractionRead() const { return this->Field->GetFractionRead(); }
  ///@}

  /// Why macrocells could not be kept when all samples were read; empty if they could be.
  const std::string& GetCacheProblem() const { return this->CacheProblem; }

  /// Whether the samples are still where they were at the last update, and as many. Their array
  /// must exist.
  bool IsIntact() const;

  /// That which is selected; null before the first update.
  vtkIsosurfaceRayTracing::ImageField* GetField() const
  {
    return this->AtCoarse ? this->Coarse->GetField() : this->Field.get();
  }

  /// The coordinates of the samples.
  const vtkIsosurfaceRayTraceGeometry& GetGeometry() const { return this->Geometry; }

  /// The number of points of the grid along each axis.
  vtkIsosurfaceRayTracing::Index3 GetNumberOfPoints() const
  {
    return { this->Cells[0] + 1, this->Cells[1] + 1, this->Cells[2] + 1 };
  }

  /// One for every cell of the field, not zero where it is blanked or belongs to another piece;
  /// null if all are visible.
  const unsigned char* GetHiddenCells() const;

  /// The cell of the grid that a hit is in, and its parametric coordinates.
  vtkIsosurfaceRayTracing::Index3 FindStructuredCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;
  vtkIdType FindCell(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;

  /// The point of the grid that is nearest to a hit.
  vtkIsosurfaceRayTracing::Index3 FindStructuredPoint(
    const vtkIsosurfaceRayTracing::Hit& hit) const;
  vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const;

private:
  struct Key;

  void UpdateHiddenCells(vtkDataSet* grid, bool areOfCells);
  const unsigned char* GetHiddenCellsOfSamples() const;
  void MakeField(const vtkIsosurfaceRayTraceScalars& selection, const std::string& cacheDirectory,
    const Key& key, int threads);

  /// The cell of the samples that a hit is in.
  vtkIsosurfaceRayTracing::Index3 FindCellOfSamples(
    const vtkIsosurfaceRayTracing::Hit& hit, vtkIsosurfaceRayTracing::Vector3& parametric) const;

  vtkIsosurfaceRayTracing::VolumeView View;
  std::unique_ptr<vtkIsosurfaceRayTracing::ImageField> Field;
  /// Null until it is first selected for the field.
  std::unique_ptr<vtkIsosurfaceRayTracing::CoarseLevel> Coarse;
  bool AtCoarse = false;
  std::unique_ptr<Key> Built;
  /// Until all samples are read; null if nothing is kept.
  std::unique_ptr<vtkIsosurfaceRayTraceMacrocellCache> Cache;
  std::string CacheProblem;
  vtkIsosurfaceRayTraceGeometry Geometry;
  vtkMTimeType GridTime = 0;
  /// The number of cells of the grid.
  vtkIsosurfaceRayTracing::Index3 Cells = {};
  /// A copy of scalars that are not plain arrays in memory.
  vtkSmartPointer<vtkDataArray> PlainScalars;
  std::vector<unsigned char> HiddenCells;
};

VTK_ABI_NAMESPACE_END

#endif
