// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CutPlace_h
#define CutPlace_h

#include "Mesh/CellHits.h"
#include "Mesh/MeshCell.h"
#include "Mesh/MeshSelection.h"
#include "Rays/RayFrame.h"
#include "Rays/Visibility.h"

namespace vtkIsosurfaceRayTracing
{

/// A place on a ray, where the ray is cut, in a cell of a mesh.
class CutPlace
{
public:
  CutPlace(const Vector3& origin, const Vector3& direction, double t, RayEnd end)
    : Frame(origin, direction)
    , Point(origin + direction * t)
    , T(t)
    , End(end)
  {
  }

  const Vector3& GetPoint() const { return this->Point; }

  /// Returns whether the place is in a cell. Of two cells that a crossing there separates it is in
  /// the one that is left out otherwise: its hits at the crossing are traced, too.
  ///
  /// What follows is about the cell that was entered last, which must be there still; and so must
  /// what hits in it are found with.
  bool Enter(const MeshCell& cell, CellHits& inCell);

  Vector3 FindParametric();
  double GetValue(const Vector3& parametric) const;
  bool IsInside(const MeshSurface& surface);

private:
  RayFrame Frame;
  Vector3 Point;
  double T;
  RayEnd End;

  const MeshCell* Cell = nullptr;
  CellHits* InCell = nullptr;
  /// By which the ray enters and leaves the cell before and behind the place.
  const FaceCrossing* First = nullptr;
  const FaceCrossing* Last = nullptr;
};

}

#endif
