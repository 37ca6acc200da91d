// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of composite data, joined to the one grid that they are pieces of.

#ifndef vtkIsosurfaceRayTraceBlocks_h
#define vtkIsosurfaceRayTraceBlocks_h

#include "vtkIsosurfaceRayTraceBlock.h"    // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Field/BoundsTree.h"

#include <memory> // for std::unique_ptr
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

/// Blocks lie on one lattice if their samples coincide, or are whole numbers of cells apart; they
/// may overlap. The grid that they form has the samples of all, so that neither the surface nor its
/// normals show where a block ends; cells that no block has are hidden in it. It costs a copy of
/// the samples over the box of the blocks. A single block is the grid itself.
class vtkIsosurfaceRayTraceBlocks
{
public:
  using Block = vtkIsosurfaceRayTraceBlock;

  /// Joins leaves, which lie on one lattice, unless they are the same as before. Their scalars are
  /// those of cells, or of points.
  void Update(const std::vector<vtkIsosurfaceRayTraceLeaf>& leaves, bool ofCells);

  const std::vector<Block>& Get() const { return this->Blocks; }

  /// The grid of the blocks: an image, or a single block.
  vtkDataSet* GetGrid() const { return this->Grid; }
  vtkDataArray* GetScalars() const { return this->Scalars; }

  /// The array to colour by; null if blocks have none.
  vtkDataArray* GetColors() const { return this->Colors; }

  /// The block that shows a cell of the grid.
  const Block& FindOwner(const vtkIsosurfaceRayTracing::Index3& cell) const;

  /// The number of a cell of the grid, counted through all blocks: in the block that shows it.
  vtkIdType GetCellId(const vtkIsosurfaceRayTracing::Index3& cell) const;

  /// The number of a corner of that cell: the index of the point is that of the cell, or one more.
  vtkIdType GetPointId(const vtkIsosurfaceRayTracing::Index3& cell,
    const vtkIsosurfaceRayTracing::Index3& point) const;

private:
  void PlaceBlocks();
  void Join();

  std::vector<Block> Blocks;
  bool OfCells = false;
  /// Over the boxes of the blocks, in indices of points; null for a single block.
  std::unique_ptr<vtkIsosurfaceRayTracing::BoundsTree> Tree;
  /// The modification times of the blocks and of their arrays, of which the grid was made.
  std::vector<vtkMTimeType> Times;
  /// The number of points along each axis.
  vtkIsosurfaceRayTracing::Index3 Dimensions = {};
  vtkSmartPointer<vtkDataSet> Grid;
  vtkSmartPointer<vtkDataArray> Scalars;
  vtkSmartPointer<vtkDataArray> Colors;
};

VTK_ABI_NAMESPACE_END

#endif
