// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshSelection_h
#define MeshSelection_h

#include "Kernels/Kernels.h"
#include "Mesh/CellBoxes.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"
#include "Mesh/PointGradients.h"
#include "Mesh/SurfacePieces.h"
#include "Rays/TraceRequest.h"

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
  /// What a cell of average size is long, about.
  double CellSize = 1.0;
  /// With null each ray is traced by itself.
  const Kernels* PacketKernels = nullptr;
};

}

#endif
