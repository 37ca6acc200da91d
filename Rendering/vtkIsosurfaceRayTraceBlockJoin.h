// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The samples of blocks that lie on one lattice, joined to those of one image.

#ifndef vtkIsosurfaceRayTraceBlockJoin_h
#define vtkIsosurfaceRayTraceBlockJoin_h

#include "vtkIsosurfaceRayTraceBlock.h"    // for ivars
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkSmartPointer.h"               // for results

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;

class vtkIsosurfaceRayTraceBlockJoin
{
public:
  using Block = vtkIsosurfaceRayTraceBlock;

  /// The dimensions are the numbers of points of the image. The scalars are those of cells, or of
  /// points.
  vtkIsosurfaceRayTraceBlockJoin(const std::vector<Block>& blocks,
    const vtkIsosurfaceRayTracing::Index3& dimensions, bool ofCells);

  vtkSmartPointer<vtkDataArray> JoinScalars() const;
  /// All blocks must have colours, which are those of points.
  vtkSmartPointer<vtkDataArray> JoinColors() const;

  /// Hides the cells that no block shows.
  void HideMissingCells(vtkImageData* image) const;

private:
  vtkSmartPointer<vtkDataArray> JoinArrays(vtkDataArray* Block::*array, bool ofCells) const;
  void CopySamples(const Block& block, vtkDataArray* from, bool ofCells, bool onlyOwn,
    vtkDataArray* to, std::vector<bool>& known) const;

  const std::vector<Block>& Blocks;
  vtkIsosurfaceRayTracing::Index3 Points;
  vtkIsosurfaceRayTracing::Index3 Cells;
  bool OfCells;
};

VTK_ABI_NAMESPACE_END

#endif
