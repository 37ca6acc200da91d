// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The data sets that a mapper traces: the blocks of composite data, or a data set by itself.

#ifndef vtkIsosurfaceRayTraceLeaves_h
#define vtkIsosurfaceRayTraceLeaves_h

#include "vtkDataSet.h"                        // for ivars
#include "vtkIsosurfaceRayTraceBlockDisplay.h" // for ivars
#include "vtkIsosurfaceRayTraceSnapshot.h"     // for ivars
#include "vtkIsosurfaceRayTracingCompat.h"     // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"                   // for ivars
#include "vtkType.h"                           // for vtkIdType

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkCompositeDataDisplayAttributes;
class vtkCompositeDataSet;
class vtkDataArray;

/// A data set that is traced.
struct vtkIsosurfaceRayTraceLeaf
{
  vtkSmartPointer<vtkDataSet> Data;
  /// In composite data.
  unsigned int FlatIndex;
  /// The numbers of points and cells of the data sets before it.
  vtkIdType FirstPoint;
  vtkIdType FirstCell;
  vtkIdType NumberOfCells;
  /// Its scalars; and the array of points, or else of cells, to colour by, which may be null.
  vtkDataArray* Scalars;
  vtkDataArray* Colors;
  vtkDataArray* CellColors;
  /// In composite data; often empty.
  std::string Name;
  vtkIsosurfaceRayTraceBlockDisplay Display;

  /// The array to colour by, of points or cells.
  vtkDataArray* GetAnyColors() const { return this->Colors ? this->Colors : this->CellColors; }

  /// For the beginning of a sentence.
  std::string GetName() const;
};

/// What is wrong with blocks that are left out.
class vtkIsosurfaceRayTraceLeftOut
{
public:
  void Add(const vtkIsosurfaceRayTraceLeaf& leaf, const std::string& problem)
  {
    if (this->Count++ == 0)
    {
      this->First = leaf.GetName() + " is left out. " + problem;
    }
  }

  /// About the first of them, and how many there are; empty if there are none.
  std::string Describe() const;

private:
  std::string First;
  int Count = 0;
};

/// Points and cells are numbered through all data sets of composite data that are not empty.
class vtkIsosurfaceRayTraceLeaves
{
public:
  using Leaf = vtkIsosurfaceRayTraceLeaf;

  /// What is not as it was: nothing, how blocks are displayed, or anything.
  enum class Change
  {
    None,
    OfDisplay,
    OfAnything
  };

  /// Finds the blocks that are visible, have a volume and the scalars of a mapper. Others are
  /// passed over. What is wrong with a block is told, and the block left out. Returns what has
  /// changed: if nothing, all that is known of blocks is as it was.
  Change Collect(vtkCompositeDataSet* input, vtkAbstractVolumeMapper* mapper,
    const std::string& colorArrayName, vtkCompositeDataDisplayAttributes* attributes, int threads);

  /// Takes a data set by itself. Its scalars may be null.
  void Take(vtkDataSet* data, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName);

  const std::vector<Leaf>& Get() const { return this->Leaves; }
  const vtkIsosurfaceRayTraceLeftOut& GetLeftOut() const { return this->LeftOut; }
  bool AreScalarsOfCells() const { return this->OfCells; }

  /// Whether there are blocks that are not visible.
  bool AreSomeHidden() const { return this->SomeAreHidden; }

  /// Whether leaves have opacities of their own.
  bool HaveOpacities() const { return this->SomeHaveOpacities; }

  /// Whether the leaves have arrays of cells to colour by: those of all are of the same kind.
  bool AreColorsOfCells() const
  {
    return !this->Leaves.empty() && this->Leaves.front().CellColors != nullptr;
  }

  vtkIdType GetNumberOfPoints() const { return this->NumberOfPoints; }
  vtkIdType GetNumberOfCells() const { return this->NumberOfCells; }

  ///@{
  /// The block that has a point or a cell, given its number through all of them, which becomes that
  /// in the block; null if there is none.
  const Leaf* FindLeafOfPoint(vtkIdType& point) const;
  const Leaf* FindLeafOfCell(vtkIdType& cell) const;
  ///@}

private:
  std::string Append(Leaf leaf, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName);

  /// What blocks were collected by.
  vtkIsosurfaceRayTraceSnapshot Collected;
  vtkMTimeType MapperTime = 0;
  vtkIsosurfaceRayTraceLeftOut LeftOut;
  std::vector<Leaf> Leaves;
  bool OfCells = false;
  bool SomeAreHidden = false;
  bool SomeHaveOpacities = false;
  vtkIdType NumberOfPoints = 0;
  vtkIdType NumberOfCells = 0;
};

VTK_ABI_NAMESPACE_END

#endif
