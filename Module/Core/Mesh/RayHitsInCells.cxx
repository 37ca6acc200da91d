// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/RayHitsInCells.h"

#include "Mesh/HitOrder.h"
#include "Mesh/ShapeFunctions.h"

#include <algorithm>

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
void KeepHit(const MeshSelection& selection, const CellHit& found, std::int64_t cell, int surface,
  RayPart& part, std::vector<Hit>& hits)
{
  if (!(found.T >= part.Begin && found.T <= part.End))
  {
    return;
  }
  const Hit hit = { part.Base + found.T, cell, surface, found.Parametric, found.Entering };
  const TraceRequest& request = selection.Request;
  if (!request.Visible.IsConvex())
  {
    MeshCell loaded;
    selection.Cells->Load(cell, loaded);
    if (!request.Visible.Shows(hit, GetPoint(loaded, hit.Parametric)))
    {
      return;
    }
  }
  hits.push_back(hit);
  if (request.GetOpacity(hit) >= 1.0)
  {
    part.End = std::min(part.End, found.T + GetReachOfPlace(found.T, part.Base));
  }
}

//------------------------------------------------------------------------------
void KeepHitsInCell(const MeshSelection& selection, const RayFrame& frame, std::int64_t cell,
  int surface, CellHits& inCell, RayPart& part, std::vector<Hit>& hits)
{
  MeshCell loaded;
  selection.Cells->Load(cell, loaded);
  if (!inCell.Enter(frame, loaded))
  {
    return;
  }
  const MeshSurface& traced = selection.Surfaces[static_cast<std::size_t>(surface)];
  double differences[MaximumCorners];
  for (int i = 0; i < loaded.Count; ++i)
  {
    differences[i] = Difference(loaded.Values[i], traced.Isovalue, traced.Scale);
  }
  for (const CellHit& found : inCell.Find(differences))
  {
    KeepHit(selection, found, cell, surface, part, hits);
  }
}

}
