// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTraversal_h
#define CellTraversal_h

#include "ActiveMacrocells.h"
#include "Ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// Visits the blocks of a lattice that a ray passes, one after the other (J. Amanatides, A. Woo: A
/// Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987). Blocks are cells (edge 1) or
/// macrocells. The order of crossings is that of Place, so the walk over cells within a macrocell
/// is just the piece of the walk over all cells that lies in it.
class LatticeWalk
{
public:
  /// Starts at a place of the ray within the region of blocks first <= block < last.
  LatticeWalk(const Ray& ray, int edge, const Index3& first, const Index3& last, const Place& start)
    : TheRay(ray)
    , Edge(edge)
    , First(first)
    , Last(last)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Block[axis] = this->Locate(axis, start);
      this->Next[axis] = ray.Step[axis] == 0 ? std::numeric_limits<double>::infinity()
                                             : this->FarCrossing(axis, this->Block[axis]);
    }
  }

  const Index3& GetBlock() const { return this->Block; }

  /// Where the ray leaves the block.
  Place GetExit() const
  {
    const auto& next = this->Next;
    const int axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : (next[1] <= next[2] ? 1 : 2);
    return { next[static_cast<std::size_t>(axis)], axis };
  }

  /// Steps over the exit of the block. Returns false at the end of the ray or of the region.
  bool Advance(const Place& exit)
  {
    if (!(exit.T < this->TheRay.End))
    {
      return false;
    }
    const auto axis = static_cast<std::size_t>(exit.Axis);
    int& block = this->Block[axis];
    block += this->TheRay.Step[axis];
    if (block < this->First[axis] || block >= this->Last[axis])
    {
      return false;
    }
    this->Next[axis] = this->FarCrossing(axis, block);
    return true;
  }

private:
  double NearCrossing(std::size_t axis, int block) const
  {
    return this->TheRay.Crossing(
      axis, (this->TheRay.Step[axis] > 0 ? block : block + 1) * this->Edge);
  }

  double FarCrossing(std::size_t axis, int block) const
  {
    return this->TheRay.Crossing(
      axis, (this->TheRay.Step[axis] > 0 ? block + 1 : block) * this->Edge);
  }

  // The floor of a coordinate is a guess, off by one where rounding will have it so; the planes
  // decide.
  int Locate(std::size_t axis, const Place& start) const
  {
    const int step = this->TheRay.Step[axis];
    const double coordinate =
      step == 0 ? this->TheRay.Origin[axis] : this->TheRay.Coordinate(axis, start.T);
    const double guess = std::floor(coordinate / this->Edge);
    const int lowest = this->First[axis];
    const int highest = this->Last[axis] - 1;
    int block = static_cast<int>(
      std::clamp(guess, static_cast<double>(lowest), static_cast<double>(highest)));
    if (step == 0)
    {
      return block;
    }
    const int front = step > 0 ? highest : lowest;
    const int back = step > 0 ? lowest : highest;
    const auto crossed = [&start, axis](double t) {
      return !(start < Place{ t, static_cast<int>(axis) });
    };
    while (block != front && crossed(this->FarCrossing(axis, block)))
    {
      block += step;
    }
    while (block != back && !crossed(this->NearCrossing(axis, block)))
    {
      block -= step;
    }
    return block;
  }

  const Ray& TheRay;
  int Edge;
  Index3 First;
  Index3 Last;
  Index3 Block;
  Vector3 Next;
};

/// Walks the cells of a region that the ray passes from a place on, until visit(cell) returns true.
template <typename Visit>
bool WalkCells(const Ray& ray, const Index3& first, const Index3& last, Place place, Visit&& visit)
{
  LatticeWalk walk(ray, 1, first, last, place);
  do
  {
    if (visit(walk.GetBlock()))
    {
      return true;
    }
    place = walk.GetExit();
  } while (walk.Advance(place));
  return false;
}

/// Walks the macrocells of a level in a region, and descends into the active ones.
template <typename Visit>
bool WalkMacrocells(const Ray& ray, const ActiveMacrocells& active, std::size_t level,
  const Index3& first, const Index3& last, Place place, Visit&& visit)
{
  const MacrocellLattice& lattice = active.GetLattice();
  const int branching = lattice.Levels[level].Branching;
  const Index3& childSize = level == 0 ? lattice.Cells : lattice.Levels[level - 1].Size;
  LatticeWalk walk(ray, lattice.Levels[level].Edge, first, last, place);
  do
  {
    const Index3& block = walk.GetBlock();
    if (active.IsActive(level, block))
    {
      Index3 childFirst;
      Index3 childLast;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        childFirst[axis] = block[axis] * branching;
        childLast[axis] = std::min(childFirst[axis] + branching, childSize[axis]);
      }
      if (level == 0 ? WalkCells(ray, childFirst, childLast, place, visit)
                     : WalkMacrocells(ray, active, level - 1, childFirst, childLast, place, visit))
      {
        return true;
      }
    }
    place = walk.GetExit();
  } while (walk.Advance(place));
  return false;
}

/// Calls visit(cell) for every cell the ray passes, in order, except those in macrocells that are
/// not active, until visit returns true. Without macrocells, for every cell.
template <typename Visit>
void TraverseCells(const Ray& ray, const ActiveMacrocells& active, Visit&& visit)
{
  const MacrocellLattice& lattice = active.GetLattice();
  const Place start{ ray.Begin, Place::StartAxis };
  const Index3 origin = { 0, 0, 0 };
  if (lattice.Levels.empty())
  {
    WalkCells(ray, origin, lattice.Cells, start, visit);
  }
  else
  {
    WalkMacrocells(
      ray, active, lattice.Levels.size() - 1, origin, lattice.Levels.back().Size, start, visit);
  }
}

}

#endif
