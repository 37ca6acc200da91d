// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of composite data, joined to the one grid that they are pieces of.

#ifndef vtkIsosurfaceRayTraceBlocks_h
#define vtkIsosurfaceRayTraceBlocks_h

#include "vtkIsosurfaceRayTraceBlock.h"    // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Math/Vector.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCompositeDataSet;

/// Blocks lie on one lattice if their samples coincide, or are whole numbers of cells apart; they
/// may overlap. The grid that they form has the samples of all, so that neither the surface nor its
/// normals show where a block ends; cells that no block has are hidden in it. It costs a copy of
/// the samples over the box of the blocks. A single block is the grid itself.
class vtkIsosurfaceRayTraceBlocks
{
public:
  using Block = vtkIsosurfaceRayTraceBlock;

  /// What is taken from the blocks, by the names of vtkAbstractMapper.
  struct Choice
  {
    int ScalarMode;
    int ArrayAccessMode;
    int ArrayId;
    const char* ArrayName;
    /// Empty for none.
    std::string ColorArrayName;
  };

  /// Joins the blocks, unless they are the same as before. Returns the problem, if there is one;
  /// else empty.
  std::string Update(vtkCompositeDataSet* input, const Choice& choice);

  /// The grid of the blocks: an image, or a single block.
  vtkDataSet* GetGrid() const { return this->Grid; }
  vtkDataArray* GetScalars() const { return this->Scalars; }
  bool AreOfCells() const { return this->OfCells; }

  /// The numbers of points and cells of all blocks.
  vtkIdType GetNumberOfPoints() const { return this->NumberOfPoints; }
  vtkIdType GetNumberOfCells() const { return this->NumberOfCells; }

  /// The number of a cell of the grid, counted through all blocks: in the block that shows it.
  vtkIdType GetCellId(const vtkIsosurfaceRayTracing::Index3& cell) const;

  /// The number of a corner of that cell: the index of the point is that of the cell, or one more.
  vtkIdType GetPointId(const vtkIsosurfaceRayTracing::Index3& cell,
    const vtkIsosurfaceRayTracing::Index3& point) const;

  /// The block that has a cell, given its number through all blocks; null if there is none.
  const Block* FindBlock(vtkIdType cellId) const;

private:
  std::string Collect(vtkCompositeDataSet* input, const Choice& choice);
  std::string Append(Block block, const Choice& choice, std::vector<Block>& blocks);
  std::string PlaceBlocks();
  void Join();
  const Block& FindOwner(const vtkIsosurfaceRayTracing::Index3& cell) const;

  std::vector<Block> Blocks;
  /// The modification times of the blocks and of their arrays, of which the grid was made.
  std::vector<vtkMTimeType> Times;
  /// The number of points along each axis.
  vtkIsosurfaceRayTracing::Index3 Dimensions = {};
  vtkSmartPointer<vtkDataSet> Grid;
  vtkSmartPointer<vtkDataArray> Scalars;
  bool OfCells = false;
  vtkIdType NumberOfPoints = 0;
  vtkIdType NumberOfCells = 0;
};

VTK_ABI_NAMESPACE_END

#endif
