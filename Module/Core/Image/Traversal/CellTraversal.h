// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CellTraversal_h
#define CellTraversal_h

#include "Image/Lattice/Ray.h"
#include "Image/Macrocells/ActiveMacrocells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace vtkIsosurfaceRayTracing
{

/// Visits the blocks of a lattice that a ray passes, one after the other (J. Amanatides, A. Woo: A
/// Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987). Blocks are cells (edge 1) or
/// macrocells. The order of crossings is that of Crossing, so the traversal over cells within a
/// macrocell is just the piece of the traversal over all cells that lies in it.
class LatticeTraversal
{
public:
  LatticeTraversal() = default;

  /// Starts at a crossing of the ray within the region of blocks first <= block < last.
  LatticeTraversal(
    const Ray& ray, int edge, const Index3& first, const Index3& last, const Crossing& start)
    : TheRay(&ray)
    , Edge(edge)
    , First(first)
    , Last(last)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Block[axis] = this->Locate(axis, start);
      this->Next[axis] = ray.Step[axis] == 0 ? std::numeric_limits<double>::infinity()
                                             : this->FarCrossingT(axis, this->Block[axis]);
    }
  }

  const Index3& GetBlock() const { return this->Block; }

  /// Where the ray leaves the block.
  Crossing GetExit() const
  {
    const auto& next = this->Next;
    const int axis = next[0] <= next[1] && next[0] <= next[2] ? 0 : (next[1] <= next[2] ? 1 : 2);
    return { next[static_cast<std::size_t>(axis)], axis };
  }

  /// Steps over the exit of the block. Returns false at the end of the ray or of the region.
  bool Advance(const Crossing& exit)
  {
    if (!(exit.T < this->TheRay->End))
    {
      return false;
    }
    const auto axis = static_cast<std::size_t>(exit.Axis);
    int& block = this->Block[axis];
    block += this->TheRay->Step[axis];
    if (block < this->First[axis] || block >= this->Last[axis])
    {
      return false;
    }
    this->Next[axis] = this->FarCrossingT(axis, block);
    return true;
  }

private:
  double NearCrossingT(std::size_t axis, int block) const
  {
    return this->TheRay->CrossingT(
      axis, (this->TheRay->Step[axis] > 0 ? block : block + 1) * this->Edge);
  }

  double FarCrossingT(std::size_t axis, int block) const
  {
    return this->TheRay->CrossingT(
      axis, (this->TheRay->Step[axis] > 0 ? block + 1 : block) * this->Edge);
  }

  // The floor of a coordinate is a guess, off by one through rounding; the planes decide.
  int Locate(std::size_t axis, const Crossing& start) const
  {
    const int step = this->TheRay->Step[axis];
    const int lowest = this->First[axis];
    const int highest = this->Last[axis] - 1;
    const UnevenPlanes* planes = this->TheRay->Planes;
    if (planes && start.Axis == static_cast<int>(axis))
    {
      // The ray has just crossed the border of the region, but not the flat cells behind it.
      return step > 0 ? lowest : highest;
    }
    const double coordinate =
      step == 0 ? this->TheRay->Origin[axis] : this->TheRay->Coordinate(axis, start.T);
    const double guess =
      std::floor((planes ? planes->FindCell(axis, coordinate) : coordinate) / this->Edge);
    int block = static_cast<int>(
      std::clamp(guess, static_cast<double>(lowest), static_cast<double>(highest)));
    if (step == 0)
    {
      return block;
    }
    const int front = step > 0 ? highest : lowest;
    const int back = step > 0 ? lowest : highest;
    const auto crossed = [&start, axis](double t) {
      return !(start < Crossing{ t, static_cast<int>(axis) });
    };
    while (block != front && crossed(this->FarCrossingT(axis, block)))
    {
      block += step;
    }
    while (block != back && !crossed(this->NearCrossingT(axis, block)))
    {
      block -= step;
    }
    return block;
  }

  const Ray* TheRay;
  int Edge;
  Index3 First;
  Index3 Last;
  Index3 Block;
  Vector3 Next;
};

/// A block of cells, first <= cell < last, and the crossing at which a ray enters it.
struct CellRegion
{
  Index3 First;
  Index3 Last;
  Crossing Start;
};

/// The active macrocells of the finest level that a ray passes, in order, each as the region of its
/// cells; without macrocells, the whole volume. The ray and the macrocells must outlive the
/// traversal. Whether a macrocell is active is read when the traversal reaches it, and may change
/// meanwhile.
template <typename Macrocells>
class MacrocellTraversal
{
public:
  /// More than any volume needs.
  static constexpr std::size_t MaximumLevels = 8;

  MacrocellTraversal(const Ray& ray, const Macrocells& active)
    : TheRay(&ray)
    , Active(&active)
    , Top(active.GetLattice().Levels.size())
    , Level(this->Top)
  {
  }

  /// Moves to the next one. Returns false at the end of the ray.
  bool Next(CellRegion& region)
  {
    if (this->Level == this->Top)
    {
      // Above the levels there is one region: the volume.
      const MacrocellLattice& lattice = this->Active->GetLattice();
      const Index3& size = this->Top == 0 ? lattice.Cells : lattice.Levels.back().Size;
      region = { { 0, 0, 0 }, size, { this->TheRay->Begin, Crossing::StartAxis } };
      if (std::exchange(this->IsDone, true))
      {
        return false;
      }
      if (this->Top == 0)
      {
        return true;
      }
      this->Descend(region);
    }
    else
    {
      this->Advance();
    }
    while (this->Level < this->Top)
    {
      const Index3& block = this->Traversals[this->Level].GetBlock();
      if (!this->Active->IsActive(this->Level, block))
      {
        this->Advance();
        continue;
      }
      region = this->GetChildren(block);
      if (this->Level == 0)
      {
        return true;
      }
      this->Descend(region);
    }
    return false;
  }

private:
  /// Moves to the next block of the level, or of the level above if it has none.
  void Advance()
  {
    while (this->Level < this->Top)
    {
      LatticeTraversal& traversal = this->Traversals[this->Level];
      this->Starts[this->Level] = traversal.GetExit();
      if (traversal.Advance(this->Starts[this->Level]))
      {
        return;
      }
      ++this->Level;
    }
  }

  void Descend(const CellRegion& region)
  {
    --this->Level;
    const int edge = this->Active->GetLattice().Levels[this->Level].Edge;
    this->Traversals[this->Level] =
      LatticeTraversal(*this->TheRay, edge, region.First, region.Last, region.Start);
    this->Starts[this->Level] = region.Start;
  }

  /// What a block of the level is made of: blocks of the level below, or cells.
  CellRegion GetChildren(const Index3& block) const
  {
    const MacrocellLattice& lattice = this->Active->GetLattice();
    const int branching = lattice.Levels[this->Level].Branching;
    const Index3& size = this->Level == 0 ? lattice.Cells : lattice.Levels[this->Level - 1].Size;
    CellRegion region{ {}, {}, this->Starts[this->Level] };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      region.First[axis] = block[axis] * branching;
      region.Last[axis] = std::min(region.First[axis] + branching, size[axis]);
    }
    return region;
  }

  const Ray* TheRay;
  const Macrocells* Active;
  std::size_t Top;
  /// Where the traversal is; the top when it has not begun or has ended.
  std::size_t Level;
  bool IsDone = false;
  std::array<LatticeTraversal, MaximumLevels> Traversals;
  std::array<Crossing, MaximumLevels> Starts;
};

/// Calls visit(cell) for the cells of a region that the ray passes, in order, until visit returns
/// true. Returns whether it did.
template <typename Visit>
bool VisitCells(const Ray& ray, const CellRegion& region, Visit&& visit)
{
  LatticeTraversal traversal(ray, 1, region.First, region.Last, region.Start);
  do
  {
    if (visit(traversal.GetBlock()))
    {
      return true;
    }
  } while (traversal.Advance(traversal.GetExit()));
  return false;
}

/// Calls visit(cell) for every cell the ray passes, in order, except those in macrocells that are
/// not active, until visit returns true. Without macrocells, for every cell.
template <typename Visit>
void TraverseCells(const Ray& ray, const ActiveMacrocells& active, Visit&& visit)
{
  MacrocellTraversal traversal(ray, active);
  CellRegion region;
  while (traversal.Next(region) && !VisitCells(ray, region, visit))
  {
  }
}

}

#endif
