// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// A part of the data that a mapper traces, which is a field of its own: blocks of images on one
// lattice, a rectilinear grid, a mesh.

#ifndef vtkIsosurfaceRayTracePart_h
#define vtkIsosurfaceRayTracePart_h

#include "vtkIsosurfaceRayTraceLeaves.h"   // for FlatIndex
#include "vtkIsosurfaceRayTraceLevel.h"    // for arguments
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Field/FieldSet.h"

#include <optional> // for std::optional
#include <string>   // for std::string
#include <vector>   // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkDataSet;
class vtkGenericCell;
class vtkObject;

class vtkIsosurfaceRayTracePart : public vtkIsosurfaceRayTracing::FieldSource
{
public:
  /// From the object space of the field to the coordinates of the data. Known before the field is.
  virtual vtkIsosurfaceRayTracing::Matrix4 FindPhysicalFromObject() const = 0;

  /// What the part was last selected of, the first of several; it may be gone. Null if the part is
  /// not kept for the same data.
  virtual vtkDataSet* GetFirstData() const { return nullptr; }

  /// Whether the field is so small that it is built when the first ray comes to it.
  virtual bool IsBuiltOnDemand() const = 0;

  /// Whether the part and others like it are one field, without seams.
  virtual bool IsSeamless() const { return false; }

  /// Builds the field, with all threads, or begins to. Returns whether it had to be built.
  virtual bool Update(int threads) = 0;

  /// Selects the field, after Update. Returns whether it is another than before.
  virtual bool SelectLevel(vtkIsosurfaceRayTraceLevel /*level*/, int /*threads*/) { return false; }
  virtual bool IsCoarse() const { return false; }

  ///@{
  /// Goes on building a field: reads the next slab of its data, which must be intact. Where they
  /// have not been read (the fraction is less than 1), rays hit nothing, unless the field is
  /// coarse.
  virtual void ReadSlab(int /*threads*/) {}
  virtual double GetFractionRead() const { return 1.0; }
  ///@}

  /// What went wrong when it was built, without harm to pictures; empty if nothing did.
  virtual std::string GetWarning() const { return ""; }

  /// The box of the field and the size of its cells, about, in its object space. The field must be
  /// there, unless it is built on demand.
  virtual vtkIsosurfaceRayTracing::Bounds FindBox() const = 0;
  virtual double FindCellSize() const = 0;

  /// The cell that a hit is in, and the point nearest to it, by their numbers through all leaves.
  virtual vtkIdType FindCell(const vtkIsosurfaceRayTracing::Hit& hit,
    vtkIsosurfaceRayTracing::Vector3& parametric) const = 0;
  virtual vtkIdType FindPoint(const vtkIsosurfaceRayTracing::Hit& hit) const = 0;

  /// Makes the parametric coordinates of a hit in what is traced of a cell those in the cell of the
  /// data, given any cell, which takes longer to make than to use. That may take longer than all
  /// else.
  virtual void MoveToWholeCell(const vtkIsosurfaceRayTracing::Hit& /*hit*/, vtkGenericCell* /*any*/,
    vtkIsosurfaceRayTracing::Vector3& /*parametric*/) const
  {
  }

  /// The opacity of all its surfaces, in place of those of the volume; or none.
  virtual std::optional<double> FindOpacity() const = 0;

  /// The leaf that has the cell of a hit.
  virtual const vtkIsosurfaceRayTraceLeaf& FindLeaf(
    const vtkIsosurfaceRayTracing::Hit& hit) const = 0;
  unsigned int GetBlock(const vtkIsosurfaceRayTracing::Hit& hit) const final
  {
    return this->FindLeaf(hit).FlatIndex;
  }

  /// Finds the first components of the array to colour by at a hit. Called by many threads at once.
  virtual void SampleColors(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const = 0;

  /// Whether the arrays that are traced are still where they were, and as long.
  virtual bool IsIntact() const = 0;

  /// Appends the objects that a picture depends on. Some may be null.
  virtual void AddObjects(std::vector<vtkObject*>& objects) const = 0;
};

VTK_ABI_NAMESPACE_END

#endif
