// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/MeshCaps.h"

#include "Math/RoundOutward.h"
#include "Mesh/CutPlace.h"
#include "Rays/PlaneRounding.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The half-space with caps in whose plane a ray begins or ends; Hit::NoPlane if there is none.
int FindCappedPlane(const std::vector<HalfSpace>& halves, const Vector3& origin,
  const Vector3& direction, double t, RayEnd end)
{
  const auto plane = std::find_if(halves.begin(), halves.end(),
    [&](const HalfSpace& half)
    {
      const PlaneCrossing crossing = FindCrossing(half, origin, direction);
      const bool goesThrough = end == RayEnd::Begin ? crossing.Slope > 0.0 : crossing.Slope < 0.0;
      return half.IsCapped && goesThrough && crossing.T == t;
    });
  return plane != halves.end() ? static_cast<int>(plane - halves.begin()) : Hit::NoPlane;
}

/// The box of a cell and its largest value.
struct CellBox
{
  Vector3 Lower;
  Vector3 Upper;
  double High;

  CellBox(const MeshCell& cell, double margin)
    : Lower(cell.Points[0])
    , Upper(cell.Points[0])
    , High(*std::max_element(cell.Values, cell.Values + cell.Count))
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (int i = 1; i < cell.Count; ++i)
      {
        this->Lower[axis] = std::min(this->Lower[axis], cell.Points[i][axis]);
        this->Upper[axis] = std::max(this->Upper[axis], cell.Points[i][axis]);
      }
      this->Lower[axis] -= margin;
      this->Upper[axis] += margin;
    }
  }

  bool Contains(const Vector3& point) const
  {
    bool contains = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      contains &= this->Lower[axis] <= point[axis] && point[axis] <= this->Upper[axis];
    }
    return contains;
  }
};

/// A place where a ray is cut by a plane, and the cell that it is in.
struct PlaceInCell
{
  static constexpr std::int64_t NoCell = -1;

  int Ray;
  int Plane;
  CutPlace Place;
  PlaceInBoxes InBoxes;
  std::int64_t Cell = NoCell;

  PlaceInCell(int ray, int plane, const CutPlace& place, double leastInside)
    : Ray(ray)
    , Plane(plane)
    , Place(place)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->InBoxes.Below[axis] = RoundDown(place.GetPoint()[axis]);
      this->InBoxes.Above[axis] = RoundUp(place.GetPoint()[axis]);
    }
    this->InBoxes.LeastHigh = RoundUp(leastInside);
  }
};

/// Finds the cells that places are in, of those that reach an isovalue and are visible; where
/// several overlap, that with the smallest number. All places go down the tree together:
/// neighbours are in the same cells, each of which is read once.
class CellSearch
{
public:
  CellSearch(const MeshSelection& selection, CellHits& inCell, std::vector<PlaceInCell>& places)
    : Selection(&selection)
    , InCell(&inCell)
    , Places(&places)
    , LeastInside(selection.Surfaces.front().Isovalue)
  {
  }

  void FindCells();

private:
  // Sets are of numbers of places.
  void Visit(int level, std::size_t number, const RaySet& places);
  void VisitBlock(std::size_t block, const RaySet& places);

  const MeshSelection* Selection;
  CellHits* InCell;
  std::vector<PlaceInCell>* Places;
  /// The smallest isovalue.
  double LeastInside;
};

//------------------------------------------------------------------------------
void CellSearch::FindCells()
{
  RaySet all = {};
  for (std::size_t i = 0; i < this->Places->size(); ++i)
  {
    Add(static_cast<int>(i), all);
  }
  const int levels = this->Selection->Tree->GetNumberOfLevels();
  if (levels > 0)
  {
    this->Visit(levels - 1, 0, all);
  }
}

//------------------------------------------------------------------------------
void CellSearch::Visit(int level, std::size_t number, const RaySet& places)
{
  const Kernels* kernels = this->Selection->PacketKernels;
  const auto findChildren =
    kernels ? kernels->FindChildrenAround : BaselineKernels.FindChildrenAround;
  const CellTreeNode& node = this->Selection->Tree->GetNode(level, number);
  unsigned int met = 0;
  RaySet inChild[CellTree::Width] = {};
  ForEachRay(places,
    [&](int place)
    {
      const unsigned int found =
        findChildren(node, (*this->Places)[static_cast<std::size_t>(place)].InBoxes);
      met |= found;
      for (unsigned int children = found; children != 0; children &= children - 1)
      {
        Add(place, inChild[LowestBit(children)]);
      }
    });
  for (; met != 0; met &= met - 1)
  {
    const int child = LowestBit(met);
    const std::size_t below = number * CellTree::Width + static_cast<std::size_t>(child);
    if (level > CellTree::LowestLevel)
    {
      this->Visit(level - 1, below, inChild[child]);
    }
    else
    {
      this->VisitBlock(below, inChild[child]);
    }
  }
}

//------------------------------------------------------------------------------
void CellSearch::VisitBlock(std::size_t block, const RaySet& places)
{
  const MeshCells& cells = *this->Selection->Cells;
  const CellTree& tree = *this->Selection->Tree;
  for (int i = 0; i < tree.GetNumberOfCells(block); ++i)
  {
    const std::int64_t number = tree.GetCell(block, i);
    MeshCell cell;
    if (this->Selection->Request.Visible.IsHidden(number) || !cells.Load(number, cell))
    {
      continue;
    }
    const CellBox box(cell, tree.GetMargin());
    if (box.High < this->LeastInside)
    {
      continue;
    }
    ForEachRay(places,
      [&](int place)
      {
        PlaceInCell& found = (*this->Places)[static_cast<std::size_t>(place)];
        const bool isNext = found.Cell == PlaceInCell::NoCell || number < found.Cell;
        if (isNext && box.Contains(found.Place.GetPoint()) &&
          found.Place.Enter(cell, *this->InCell))
        {
          found.Cell = number;
        }
      });
  }
}

//------------------------------------------------------------------------------
/// The surface of the largest isovalue that a place is inside of; Hit::NoSurface if there is none.
int FindSurface(const std::vector<MeshSurface>& surfaces, CutPlace& place)
{
  const auto surface = std::find_if(surfaces.rbegin(), surfaces.rend(),
    [&place](const MeshSurface& candidate) { return place.IsInside(candidate); });
  return surface != surfaces.rend() ? static_cast<int>(surfaces.rend() - surface) - 1
                                    : Hit::NoSurface;
}

}

//------------------------------------------------------------------------------
std::vector<HalfSpace> MovePlanesIntoCells(
  const std::vector<HalfSpace>& halves, const CellTree& tree, ScalarType pointType)
{
  constexpr double rounding = 0x1p-40;
  const double ofPoints = rounding + (pointType == ScalarType::Float32 ? 0x1p-24 : 0.0);
  const Bounds& box = tree.GetBounds();
  std::vector<HalfSpace> moved = halves;
  for (HalfSpace& half : moved)
  {
    half.Offset -= half.IsCapped ? FindRounding(half, box, rounding, ofPoints) : 0.0;
  }
  return moved;
}

//------------------------------------------------------------------------------
std::vector<Cap> FindCaps(const MeshSelection& selection, const RayPacket& packet,
  const RaySet& rays, RayEnd end, CellHits& inCell)
{
  std::vector<Cap> caps;
  if (selection.Surfaces.empty())
  {
    return caps;
  }
  const bool isBegin = end == RayEnd::Begin;
  const double* cuts = isBegin ? packet.Begin : packet.End;
  std::vector<PlaceInCell> places;
  ForEachRay(rays,
    [&](int ray)
    {
      const Vector3 origin = packet.GetOrigin(ray);
      const Vector3 direction = packet.GetDirection(ray);
      const int plane = FindCappedPlane(selection.HalfSpaces, origin, direction, cuts[ray], end);
      const CutPlace place(origin, direction, cuts[ray], end);
      if (plane != Hit::NoPlane && selection.Request.Visible.Regions.Contain(place.GetPoint()))
      {
        places.emplace_back(ray, plane, place, selection.Surfaces.front().Isovalue);
      }
    });
  CellSearch(selection, inCell, places).FindCells();
  for (PlaceInCell& found : places)
  {
    MeshCell cell;
    CutPlace& place = found.Place;
    const bool isInCell = found.Cell != PlaceInCell::NoCell &&
      selection.Cells->Load(found.Cell, cell) && place.Enter(cell, inCell);
    const int surface = isInCell ? FindSurface(selection.Surfaces, place) : Hit::NoSurface;
    if (surface != Hit::NoSurface)
    {
      Hit hit = { packet.Base[found.Ray] + cuts[found.Ray], found.Cell, surface,
        place.FindParametric(), isBegin };
      hit.Plane = found.Plane;
      hit.Value = place.GetValue(hit.Parametric);
      caps.push_back({ found.Ray, hit });
    }
  }
  return caps;
}

}
