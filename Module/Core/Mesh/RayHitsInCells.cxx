// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/RayHitsInCells.h"

#include "Mesh/ShapeFunctions.h"

namespace vtkIsosurfaceRayTracing
{

//------------------------------------------------------------------------------
bool IsVisible(const MeshSelection& selection, const Hit& hit)
{
  MeshCell cell;
  selection.Cells->Load(hit.Cell, cell);
  return selection.Request.Visible.Shows(hit, GetPoint(cell, hit.Parametric));
}

//------------------------------------------------------------------------------
void KeepHitsInCell(const MeshSelection& selection, const RayFrame& frame, std::int64_t cell,
  int surface, CellHits& inCell, RayPart& part, std::vector<Hit>& hits,
  const TrilinearSolutions* solutions)
{
  MeshCell loaded;
  if (!selection.Cells->Load(cell, loaded))
  {
    return;
  }
  inCell.Enter(frame, loaded);
  const MeshSurface& traced = selection.Surfaces[static_cast<std::size_t>(surface)];
  double differences[MaximumCorners];
  for (int i = 0; i < loaded.Count; ++i)
  {
    differences[i] = Difference(loaded.Values[i], traced.Isovalue, traced.Scale);
  }
  for (const CellHit& found :
    solutions ? inCell.Find(differences, *solutions) : inCell.Find(differences))
  {
    const Hit hit = { part.Base + found.T, cell, surface, found.Parametric, found.Entering };
    if (part.Has(found.T) && KeepHit(selection, hit, found.T, part))
    {
      hits.push_back(hit);
    }
  }
}

}
