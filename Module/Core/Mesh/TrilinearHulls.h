// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearHulls_h
#define TrilinearHulls_h

#include "Kernels/Kernels.h"
#include "Mesh/MeshCell.h"
#include "Mesh/MeshSelection.h"

#include <cstdint>

namespace vtkIsosurfaceRayTracing
{

/// Bounds the pieces of a surface in trilinear cells by the hulls that they are in.
class TrilinearHulls
{
public:
  /// Reads so many cells, of which there may be as many as a set has pieces: all numbers must be
  /// initialized.
  void Bound(const MeshSelection& selection, const MeshSurface& surface,
    const std::uint32_t (&cells)[PackedPieces::Capacity], int count, const BeamNumbers& frame,
    BeamPieces& pieces)
  {
    selection.Cells->LoadTrilinear(cells, count, this->Records.Corner);
    for (int i = 0; i < count; ++i)
    {
      SubtractIsovalue(surface.Isovalue, surface.Scale, this->Records.Corner[i]);
    }
    pieces.Count = count;
    selection.PacketKernels->BoundTrilinear(this->Records, frame, pieces);
  }

private:
  PassedCellRecords Records;
};

}

#endif
