// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TrilinearHulls_h
#define TrilinearHulls_h

#include "Kernels/Kernels.h"
#include "Mesh/MeshCell.h"
#include "Mesh/MeshSelection.h"

#include <cstddef>
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
    SubtractIsovalue(surface.Isovalue, surface.Scale, this->Records.Corner, count);
    pieces.Count = count;
    selection.PacketKernels->BoundTrilinear(this->Records, frame, pieces);
  }

  /// Whether a ray may meet the hull of one of them, given the frame of the ray alone.
  bool IsMet(const MeshSelection& selection, const MeshSurface& surface, std::uint32_t cell,
    const BeamNumbers& frame)
  {
    this->Bound(selection, surface, { cell }, 1, frame, this->OfOne);
    // The label of the ray is 0.
    const LabelBounds& bounds = this->OfOne.Bounds;
    bool isMet = true;
    for (std::size_t k = 0; k < 2; ++k)
    {
      isMet = isMet && bounds.Lower[k][0] <= 0.0F && 0.0F <= bounds.Upper[k][0];
    }
    for (const auto& line : this->OfOne.Line)
    {
      isMet = isMet && line[2][0] >= 0.0F;
    }
    return isMet;
  }

private:
  static_assert(PassedCellRecords::Capacity == PackedPieces::Capacity);

  PassedCellRecords Records;
  BeamPieces OfOne;
};

}

#endif
