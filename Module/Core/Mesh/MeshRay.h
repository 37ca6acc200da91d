// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshRay_h
#define MeshRay_h

#include "Mesh/CellHits.h"
#include "Mesh/MeshSelection.h"
#include "Mesh/RayHitsInCells.h"
#include "Rays/Hit.h"
#include "Rays/RayFrame.h"
#include "Rays/RayPacket.h"

#include <cstddef>
#include <vector>

namespace vtkIsosurfaceRayTracing
{

/// A ray of a packet, traced through a mesh by itself.
class MeshRay
{
public:
  MeshRay(const MeshSelection& selection, const RayPacket& packet, int ray);

  /// Appends all hits; those beyond the first opaque one may be missing.
  void FindHits(CellHits& inCell, std::vector<Hit>& hits);

private:
  struct Child;

  bool IsActive(const CellTreeNode& node, int child) const;
  double FindBegin(const CellTreeNode& node, int child) const;
  void Visit(int level, std::size_t number, CellHits& inCell, std::vector<Hit>& hits);
  void VisitBlock(std::size_t block, CellHits& inCell, std::vector<Hit>& hits);

  const MeshSelection* Selection;
  Vector3 Origin;
  Vector3 Direction;
  Vector3 Inverse;
  RayPart Part;
  RayFrame Frame;
};

}

#endif
