// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshSelection_h
#define MeshSelection_h

#include "Kernels/Kernels.h"
#include "Mesh/CellBoxes.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"
#include "Mesh/PieceTree.h"
#include "Mesh/PointGradients.h"
#include "Mesh/SurfacePieces.h"
#include "Rays/TraceRequest.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A surface of a request, as it is traced in a mesh.
struct MeshSurface
{
  double Isovalue;
  /// The power of two that values are multiplied by before the isovalue is subtracted.
  double Scale;
  std::shared_ptr<SurfacePieces> Pieces;
  std::shared_ptr<PieceTreesOnDemand> Trees;
};

/// What is traced of a mesh, and with what. All must outlive it.
struct MeshSelection
{
  const MeshCells* Cells = nullptr;
  const CellTree* Tree = nullptr;
  /// Null without a cloud.
  const CellBoxes* Boxes = nullptr;
  /// Of each component that lights a cloud, if the gradients are those at points.
  std::vector<const PointGradients*> GradientsOfCloud;
  TraceRequest Request;
  /// Those of the request, as rays are cut to them: see MeshCaps.h.
  std::vector<HalfSpace> HalfSpaces;
  std::vector<MeshSurface> Surfaces;
  /// The floats that their isovalues are between.
  std::vector<IsovalueSpan> Spans;
  /// What a cell of average size is long, about.
  double CellSize = 1.0;
  /// With null each ray is traced by itself.
  const Kernels* PacketKernels = nullptr;
  /// After so many rays that have little in common there are trees for them; see Execution.
  double RaysForTrees = 0.0;

  /// Begins to fetch what is read when rays come to a node of the tree.
  void Prefetch(int level, std::size_t node) const
  {
    if (level > CellTree::LowestLevel)
    {
      this->Tree->Prefetch(level, node);
    }
    for (const MeshSurface& surface : this->Surfaces)
    {
      if (level == CellTree::LowestLevel)
      {
        surface.Pieces->PrefetchBoxes(node);
      }
      else if (level == CellTree::LowestLevel + 1)
      {
        surface.Pieces->Prefetch(node * CellTree::Width, CellTree::Width);
      }
    }
  }
};

}

#endif
