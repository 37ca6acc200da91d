// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The blocks of composite data, joined to the one grid that they are pieces of.

#ifndef vtkIsosurfaceRayTraceBlocks_h
#define vtkIsosurfaceRayTraceBlocks_h

#include "vtkIsosurfaceRayTraceBlock.h"    // for ivars
#include "vtkIsosurfaceRayTraceLeaves.h"   // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for ivars
#include "vtkType.h"                       // for vtkIdType

#include "Math/Vector.h"

#include <string> // for std::string
#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkAbstractVolumeMapper;
class vtkCompositeDataSet;

/// Blocks lie on one lattice if their samples coincide, or are whole numbers of cells apart; they
/// may overlap. The grid that they form has the samples of all, so that neither the surface nor its
/// normals show where a block ends; cells that no block has are hidden in it. It costs a copy of
/// the samples over the box of the blocks. A single block is the grid itself.
class vtkIsosurfaceRayTraceBlocks
{
public:
  using Block = vtkIsosurfaceRayTraceBlock;

  /// Joins the blocks, unless they are the same as before, with the scalars of a mapper. Returns
  /// the problem, if there is one; else empty.
  std::string Update(
    vtkCompositeDataSet* input, vtkAbstractVolumeMapper* mapper, const std::string& colorArrayName);

  /// The grid of the blocks: an image, or a single block.
  vtkDataSet* GetGrid() const { return this->Grid; }
  vtkDataArray* GetScalars() const { return this->Scalars; }

  /// As they are in the composite data.
  const vtkIsosurfaceRayTraceLeaves& GetLeaves() const { return this->Leaves; }

  /// The number of a cell of the grid, counted through all blocks: in the block that shows it.
  vtkIdType GetCellId(const vtkIsosurfaceRayTracing::Index3& cell) const;

  /// The number of a corner of that cell: the index of the point is that of the cell, or one more.
  vtkIdType GetPointId(const vtkIsosurfaceRayTracing::Index3& cell,
    const vtkIsosurfaceRayTracing::Index3& point) const;

private:
  std::string PlaceBlocks();
  void Join();
  const Block& FindOwner(const vtkIsosurfaceRayTracing::Index3& cell) const;

  vtkIsosurfaceRayTraceLeaves Leaves;
  std::vector<Block> Blocks;
  /// The modification times of the blocks and of their arrays, of which the grid was made.
  std::vector<vtkMTimeType> Times;
  /// The number of points along each axis.
  vtkIsosurfaceRayTracing::Index3 Dimensions = {};
  vtkSmartPointer<vtkDataSet> Grid;
  vtkSmartPointer<vtkDataArray> Scalars;
};

VTK_ABI_NAMESPACE_END

#endif
