// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrHierarchy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// The largest whole number that is not above a quotient.
int FloorDivide(int dividend, int divisor)
{
  return dividend / divisor - (dividend % divisor < 0 ? 1 : 0);
}

/// Whether a cell is in the box of a patch or of a region.
template <typename Cells>
bool IsIn(const Cells& cells, const Index3& cell)
{
  bool isIn = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int place = cell[axis] - cells.First[axis];
    isIn = isIn && place >= 0 && place < cells.Cells[axis];
  }
  return isIn;
}

std::size_t GetNumber(const AmrPatch& patch, const Index3& cell)
{
  return Offset(
    { cell[0] - patch.First[0], cell[1] - patch.First[1], cell[2] - patch.First[2] }, patch.Cells);
}

bool Owns(const AmrPatch& patch, const Index3& cell)
{
  return IsIn(patch, cell) && (!patch.GhostCells || patch.GhostCells[GetNumber(patch, cell)] == 0);
}

double GetSample(const AmrPatch& patch, const Index3& index)
{
  const Index3 place = { index[0] - patch.First[0], index[1] - patch.First[1],
    index[2] - patch.First[2] };
  return DispatchScalarType(patch.Samples,
    [&place](const auto& samples) { return static_cast<double>(*samples.At(place)); });
}

/// Calls visit(index) for the indices of a box, which may be empty.
template <typename Visit>
void ForEachIndex(const Index3& first, const Index3& count, const Visit& visit)
{
  Index3 i;
  for (i[2] = first[2]; i[2] < first[2] + count[2]; ++i[2])
  {
    for (i[1] = first[1]; i[1] < first[1] + count[1]; ++i[1])
    {
      for (i[0] = first[0]; i[0] < first[0] + count[0]; ++i[0])
      {
        visit(i);
      }
    }
  }
}

/// The cell behind the last one, along each axis.
Index3 GetEnd(const Index3& first, const Index3& count)
{
  return { first[0] + count[0], first[1] + count[1], first[2] + count[2] };
}

/// The box of some cells of a level.
Bounds GetBox(const Index3& first, const Index3& count)
{
  Bounds box;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    box.Lower[axis] = first[axis];
    box.Upper[axis] = first[axis] + count[axis];
  }
  return box;
}

/// Whether boxes have cells in common.
bool Overlap(const Bounds& a, const Bounds& b)
{
  bool overlap = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    overlap = overlap && a.Lower[axis] < b.Upper[axis] && b.Lower[axis] < a.Upper[axis];
  }
  return overlap;
}

/// Includes the samples of a patch that are of the cells of a box.
void Include(
  const AmrPatch& patch, bool ofCells, const Index3& first, const Index3& end, AmrRange& range)
{
  Index3 low;
  Index3 count;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    low[axis] = std::max(first[axis] - patch.First[axis], 0);
    count[axis] =
      std::min(end[axis] - patch.First[axis], patch.Cells[axis]) - low[axis] + (ofCells ? 0 : 1);
  }
  DispatchScalarType(patch.Samples,
    [&](const auto& samples)
    {
      ForEachIndex(low, count,
        [&](const Index3& i)
        {
          const auto value = static_cast<double>(*samples.At(i));
          const bool isFinite = std::isfinite(value);
          range.Min = isFinite ? std::min(range.Min, value) : range.Min;
          range.Max = isFinite ? std::max(range.Max, value) : range.Max;
        });
    });
}

/// The cells that touch a node, along one axis.
struct TouchingCells
{
  int First;
  int Count;
};

TouchingCells FindTouching(int node, int nodesOfCell)
{
  return nodesOfCell == 1 || node % 2 == 0 ? TouchingCells{ FloorDivide(node, nodesOfCell) - 1, 2 }
                                           : TouchingCells{ FloorDivide(node, nodesOfCell), 1 };
}

/// Calls visit(cell) for the cells that touch a node.
template <typename Visit>
void ForEachTouching(const Index3& node, int nodesOfCell, const Visit& visit)
{
  const TouchingCells x = FindTouching(node[0], nodesOfCell);
  const TouchingCells y = FindTouching(node[1], nodesOfCell);
  const TouchingCells z = FindTouching(node[2], nodesOfCell);
  ForEachIndex({ x.First, y.First, z.First }, { x.Count, y.Count, z.Count }, visit);
}

/// Doubles the resolution of lines of values, from the centres of cells to all nodes between the
/// first and the last border: each line has a number of values side by side.
void Refine(const double* lines, int cells, std::size_t values, double* refined)
{
  for (int node = 1; node < 2 * cells; ++node)
  {
    const double* below = lines + static_cast<std::size_t>((node - 1) / 2) * values;
    const double* above = lines + static_cast<std::size_t>(node / 2) * values;
    double* to = refined + static_cast<std::size_t>(node - 1) * values;
    for (std::size_t i = 0; i < values; ++i)
    {
      to[i] = 0.5 * (below[i] + above[i]);
    }
  }
}

/// The means of values of cells at their inner nodes: along one axis after the other.
std::vector<double> RefineCells(std::vector<double> values, const Index3& cells)
{
  std::size_t before = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto nodes = static_cast<std::size_t>(2 * cells[axis] - 1);
    const std::size_t lines = values.size() / (before * static_cast<std::size_t>(cells[axis]));
    std::vector<double> refined(lines * before * nodes);
    for (std::size_t line = 0; line < lines; ++line)
    {
      Refine(&values[line * before * static_cast<std::size_t>(cells[axis])], cells[axis], before,
        &refined[line * before * nodes]);
    }
    values = std::move(refined);
    before *= nodes;
  }
  return values;
}

/// Whether all cells that touch a node of a region are its own.
bool IsInner(const Index3& node, const AmrNodes& nodes)
{
  bool isInner = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    isInner = isInner && node[axis] >= 2 && node[axis] < nodes.Dimensions[axis] - 2;
  }
  return isInner;
}

/// The places along an axis where the patches of a region can be parted: none reaches across.
std::vector<int> FindGaps(
  const std::vector<AmrPatch>& patches, const AmrRegion& region, std::size_t axis)
{
  std::vector<std::pair<int, int>> ranges;
  for (const std::size_t number : region.Patches)
  {
    const int first = patches[number].First[axis];
    ranges.emplace_back(first, first + patches[number].Cells[axis]);
  }
  std::sort(ranges.begin(), ranges.end());
  std::vector<int> gaps;
  int end = ranges.front().second;
  for (const auto& range : ranges)
  {
    if (range.first >= end)
    {
      gaps.push_back(range.first);
    }
    end = std::max(end, range.second);
  }
  return gaps;
}

/// A plane between patches.
struct Cut
{
  std::size_t Axis;
  int Place;
};

/// The cut of a region that is the nearest to the middle, in parts of its size.
std::optional<Cut> FindCut(const std::vector<AmrPatch>& patches, const AmrRegion& region)
{
  std::optional<Cut> cut;
  double nearest = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const int place : FindGaps(patches, region, axis))
    {
      const double part = static_cast<double>(place - region.First[axis]) / region.Cells[axis];
      if (std::abs(part - 0.5) < nearest)
      {
        nearest = std::abs(part - 0.5);
        cut = Cut{ axis, place };
      }
    }
  }
  return cut;
}

}

//------------------------------------------------------------------------------
/// Finds the values of nodes, and keeps those of coarser levels, which many have in common.
class AmrHierarchy::NodeReader
{
public:
  explicit NodeReader(const AmrHierarchy& hierarchy)
    : Hierarchy(hierarchy)
    , Lately(hierarchy.Levels.size())
    , Coarser(hierarchy.Levels.size())
    , Means(hierarchy.Levels.size())
  {
  }

  /// None where no cell touches the node.
  std::optional<double> Read(int level, const Index3& node)
  {
    Likely& likely = this->Lately[static_cast<std::size_t>(level)];
    const AmrPatch* owner = nullptr;
    bool isCoarser = false;
    double sum = 0.0;
    int count = 0;
    ForEachTouching(node, this->Hierarchy.GetNodesOfCell(),
      [&](const Index3& cell)
      {
        if (const AmrPatch* patch = this->Hierarchy.FindOwner(level, cell, likely))
        {
          owner = owner ? std::min(owner, patch) : patch;
          sum += this->Hierarchy.OfCells ? GetSample(*patch, cell) : 0.0;
          ++count;
        }
        else if (this->Hierarchy.IsCoveredByFiner(level, cell))
        {
          sum += this->Hierarchy.OfCells ? this->ReadMean(level, cell) : 0.0;
          count += this->Hierarchy.OfCells ? 1 : 0;
        }
        else
        {
          isCoarser = isCoarser || this->Hierarchy.IsCoveredByCoarser(level, cell, 0);
        }
      });
    if (isCoarser)
    {
      return this->Interpolate(level, node);
    }
    if (count == 0)
    {
      return std::nullopt;
    }
    return this->Hierarchy.OfCells ? sum / count : GetSample(*owner, node);
  }

private:
  /// At a node of a level, between the nodes of the one before.
  std::optional<double> Interpolate(int level, const Index3& node)
  {
    const Index3& ratio = this->Hierarchy.Levels[static_cast<std::size_t>(level)].Ratio;
    Index3 first;
    Vector3 weights;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = FloorDivide(node[axis], ratio[axis]);
      weights[axis] = static_cast<double>(node[axis] - first[axis] * ratio[axis]) / ratio[axis];
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      Index3 place = first;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const bool isUpper = (corner >> axis & 1) != 0;
        weight *= isUpper ? weights[axis] : 1.0 - weights[axis];
        place[axis] += isUpper ? 1 : 0;
      }
      if (weight > 0.0)
      {
        const std::optional<double> value = this->ReadCoarser(level - 1, place);
        if (!value)
        {
          return std::nullopt;
        }
        sum += weight * *value;
      }
    }
    return sum;
  }

  std::optional<double> ReadCoarser(int level, const Index3& node)
  {
    return Remember(this->Coarser[static_cast<std::size_t>(level)], node,
      [&] { return this->Read(level, node); });
  }

  double ReadMean(int level, const Index3& cell)
  {
    return Remember(this->Means[static_cast<std::size_t>(level)], cell,
      [&] { return this->Hierarchy.FindMean(level, cell); });
  }

  template <typename Value, typename Find>
  static Value Remember(std::map<Index3, Value>& known, const Index3& place, const Find& find)
  {
    const auto found = known.find(place);
    return found != known.end() ? found->second : known.emplace(place, find()).first->second;
  }

  const AmrHierarchy& Hierarchy;
  /// Of each level.
  std::vector<Likely> Lately;
  std::vector<std::map<Index3, std::optional<double>>> Coarser;
  std::vector<std::map<Index3, double>> Means;
};

//------------------------------------------------------------------------------
AmrHierarchy::AmrHierarchy(std::vector<Index3> ratios, std::vector<AmrPatch> patches, bool ofCells)
  : OfCells(ofCells)
  , Patches(std::move(patches))
{
  for (const Index3& ratio : ratios)
  {
    this->Levels.push_back({ ratio, {}, nullptr });
  }
  for (std::size_t i = 0; i < this->Patches.size(); ++i)
  {
    this->Levels[static_cast<std::size_t>(this->Patches[i].Level)].Patches.push_back(i);
  }
  for (Level& level : this->Levels)
  {
    std::vector<Bounds> boxes;
    for (const std::size_t number : level.Patches)
    {
      const AmrPatch& patch = this->Patches[number];
      boxes.push_back(GetBox(patch.First, patch.Cells));
    }
    level.Tree = std::make_unique<BoundsTree>(boxes);
    level.HasOverlaps = this->HasOverlaps(level);
  }
  this->FindLentRanges();
}

//------------------------------------------------------------------------------
template <typename Visit>
void AmrHierarchy::Level::ForEachIn(const Bounds& box, const Visit& visit) const
{
  this->Tree->Find([&box](const Bounds& other) { return Overlap(other, box); },
    [&](std::size_t place) { visit(this->Patches[place]); });
}

//------------------------------------------------------------------------------
bool AmrHierarchy::HasOverlaps(const Level& level) const
{
  return std::any_of(level.Patches.begin(), level.Patches.end(),
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->Patches[number];
      const Bounds own = GetBox(patch.First, patch.Cells);
      int count = 0;
      level.ForEachIn(own, [&count](std::size_t) { ++count; });
      return count > 1;
    });
}

//------------------------------------------------------------------------------
void AmrHierarchy::FindLentRanges()
{
  for (std::size_t i = 0; this->OfCells && i < this->Patches.size(); ++i)
  {
    const AmrPatch& patch = this->Patches[i];
    if (!this->IsInCoarser(patch))
    {
      this->LentRanges.resize(this->Patches.size());
      Include(patch, true, patch.First, GetEnd(patch.First, patch.Cells), this->LentRanges[i]);
    }
  }
}

//------------------------------------------------------------------------------
/// Whether all coarser levels have the cells that a patch lies in. It is false, too, where that
/// is not seen from boxes alone.
bool AmrHierarchy::IsInCoarser(const AmrPatch& patch) const
{
  Index3 first = patch.First;
  Index3 end = GetEnd(first, patch.Cells);
  for (int coarser = patch.Level - 1; coarser >= 0; --coarser)
  {
    const Index3& ratio = this->Levels[static_cast<std::size_t>(coarser) + 1].Ratio;
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = FloorDivide(first[axis], ratio[axis]);
      end[axis] = -FloorDivide(-end[axis], ratio[axis]);
      count[axis] = end[axis] - first[axis];
    }
    if (!this->Covers(this->Levels[static_cast<std::size_t>(coarser)], first, count))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
/// Whether patches of a level without overlaps and ghosts fill a box.
bool AmrHierarchy::Covers(const Level& level, const Index3& first, const Index3& count) const
{
  const Bounds box = GetBox(first, count);
  double covered = 0.0;
  bool isPlain = !level.HasOverlaps;
  level.ForEachIn(box,
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->Patches[number];
      const Bounds other = GetBox(patch.First, patch.Cells);
      isPlain = isPlain && !patch.GhostCells;
      double common = 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        common *= std::min(box.Upper[axis], other.Upper[axis]) -
          std::max(box.Lower[axis], other.Lower[axis]);
      }
      covered += common;
    });
  return isPlain && covered == static_cast<double>(Count(count));
}

//------------------------------------------------------------------------------
/// The mean of the finer cells in a cell that its level lacks, each by its part of the volume.
double AmrHierarchy::FindMean(int level, const Index3& cell) const
{
  double sum = 0.0;
  double covered = 0.0;
  double volume = 1.0;
  Index3 first = cell;
  Index3 count = { 1, 1, 1 };
  for (int finer = level + 1; finer < static_cast<int>(this->Levels.size()); ++finer)
  {
    const Level& all = this->Levels[static_cast<std::size_t>(finer)];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] *= all.Ratio[axis];
      count[axis] *= all.Ratio[axis];
      volume /= all.Ratio[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t number)
      {
        const AmrPatch& patch = this->Patches[number];
        Index3 low;
        Index3 common;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::max(first[axis], patch.First[axis]);
          common[axis] =
            std::min(first[axis] + count[axis], patch.First[axis] + patch.Cells[axis]) - low[axis];
        }
        ForEachIndex(low, common,
          [&](const Index3& inside)
          {
            if (this->FindOwner(finer, inside) == &patch &&
              !this->IsCoveredByCoarser(finer, inside, level + 1))
            {
              sum += volume * GetSample(patch, inside);
              covered += volume;
            }
          });
      });
  }
  return sum / covered;
}

//------------------------------------------------------------------------------
/// The patch of a level that has a cell, which is likely to be one of some; null if there is none.
const AmrPatch* AmrHierarchy::FindOwner(int level, const Index3& cell, Likely& likely) const
{
  if (!this->Levels[static_cast<std::size_t>(level)].HasOverlaps)
  {
    for (const AmrPatch* patch : likely.Patches)
    {
      if (patch && Owns(*patch, cell))
      {
        return patch;
      }
    }
  }
  const AmrPatch* owner = this->FindOwner(level, cell);
  if (owner)
  {
    likely.Patches[likely.Next] = owner;
    likely.Next = (likely.Next + 1) % likely.Patches.size();
  }
  return owner;
}

//------------------------------------------------------------------------------
/// The first patch of a level that has a cell; null if there is none.
const AmrPatch* AmrHierarchy::FindOwner(int level, const Index3& cell) const
{
  const Level& all = this->Levels[static_cast<std::size_t>(level)];
  const Bounds ofCell = GetBox(cell, { 1, 1, 1 });
  const AmrPatch* owner = nullptr;
  all.ForEachIn(ofCell,
    [&](std::size_t number)
    {
      const AmrPatch* patch = &this->Patches[number];
      if (Owns(*patch, cell) && (!owner || patch < owner))
      {
        owner = patch;
      }
    });
  return owner;
}

//------------------------------------------------------------------------------
bool AmrHierarchy::IsCoveredByFiner(int level, const Index3& cell) const
{
  Index3 inside = cell;
  for (std::size_t finer = static_cast<std::size_t>(level) + 1; finer < this->Levels.size();
       ++finer)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      inside[axis] =
        inside[axis] * this->Levels[finer].Ratio[axis] + this->Levels[finer].Ratio[axis] / 2;
    }
    if (this->FindOwner(static_cast<int>(finer), inside))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool AmrHierarchy::IsCoveredByCoarser(int level, const Index3& cell, int coarsest) const
{
  Index3 around = cell;
  for (int coarser = level - 1; coarser >= coarsest; --coarser)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      around[axis] =
        FloorDivide(around[axis], this->Levels[static_cast<std::size_t>(coarser) + 1].Ratio[axis]);
    }
    if (this->FindOwner(coarser, around))
    {
      return true;
    }
  }
  return false;
}

//------------------------------------------------------------------------------
/// Whether the patch that has a cell, of its level or else of the next coarser one, shows it.
bool AmrHierarchy::IsShown(int level, const Index3& cell) const
{
  Index3 around = cell;
  for (int coarser = level; coarser >= 0; --coarser)
  {
    if (const AmrPatch* owner = this->FindOwner(coarser, around))
    {
      return !owner->HiddenCells || owner->HiddenCells[GetNumber(*owner, around)] == 0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      around[axis] =
        FloorDivide(around[axis], this->Levels[static_cast<std::size_t>(coarser)].Ratio[axis]);
    }
  }
  return false;
}

//------------------------------------------------------------------------------
std::vector<AmrRegion> AmrHierarchy::MakeRegions(int cells) const
{
  std::vector<AmrRegion> regions;
  for (const Level& level : this->Levels)
  {
    std::map<Index3, std::vector<std::size_t>> cubes;
    for (const std::size_t number : level.Patches)
    {
      const AmrPatch& patch = this->Patches[number];
      Index3 cube;
      bool isInCube = !level.HasOverlaps;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cube[axis] = FloorDivide(patch.First[axis], cells);
        isInCube =
          isInCube && FloorDivide(patch.First[axis] + patch.Cells[axis] - 1, cells) == cube[axis];
      }
      if (isInCube)
      {
        cubes[cube].push_back(number);
      }
      else
      {
        regions.push_back(this->MakeRegion({ number }));
      }
    }
    for (auto& [cube, patches] : cubes)
    {
      this->Split(this->MakeRegion(std::move(patches)), regions);
    }
  }
  return regions;
}

//------------------------------------------------------------------------------
/// With the box around some patches of a level.
AmrRegion AmrHierarchy::MakeRegion(std::vector<std::size_t>&& patches) const
{
  const AmrPatch& one = this->Patches[patches.front()];
  AmrRegion region = { one.Level, one.First, one.Cells, std::move(patches) };
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = this->Patches[number];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int first = std::min(region.First[axis], patch.First[axis]);
      const int end =
        std::max(region.First[axis] + region.Cells[axis], patch.First[axis] + patch.Cells[axis]);
      region.First[axis] = first;
      region.Cells[axis] = end - first;
    }
  }
  return region;
}

//------------------------------------------------------------------------------
/// Whether patches that do not overlap fill the box of a region, and are of one kind.
bool AmrHierarchy::IsFilled(const AmrRegion& region) const
{
  const int kind = this->Patches[region.Patches.front()].Kind;
  std::size_t cells = 0;
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = this->Patches[number];
    cells += patch.Kind == kind ? Count(patch.Cells) : 0;
  }
  return cells == Count(region.Cells);
}

//------------------------------------------------------------------------------
/// Cuts patches that do not overlap apart until they fill boxes, and appends these.
void AmrHierarchy::Split(AmrRegion&& region, std::vector<AmrRegion>& regions) const
{
  if (this->IsFilled(region))
  {
    regions.push_back(std::move(region));
    return;
  }
  const std::optional<Cut> cut = FindCut(this->Patches, region);
  if (!cut)
  {
    for (const std::size_t number : region.Patches)
    {
      regions.push_back(this->MakeRegion({ number }));
    }
    return;
  }
  const auto middle = std::stable_partition(region.Patches.begin(), region.Patches.end(),
    [&](std::size_t number) { return this->Patches[number].First[cut->Axis] < cut->Place; });
  this->Split(this->MakeRegion({ region.Patches.begin(), middle }), regions);
  this->Split(this->MakeRegion({ middle, region.Patches.end() }), regions);
}

//------------------------------------------------------------------------------
std::size_t AmrHierarchy::FindPatch(const AmrRegion& region, const Index3& cell) const
{
  std::size_t found = region.Patches.front();
  if (region.Patches.size() > 1)
  {
    const Level& level = this->Levels[static_cast<std::size_t>(region.Level)];
    const Bounds ofCell = GetBox(cell, { 1, 1, 1 });
    level.ForEachIn(ofCell, [&](std::size_t number) { found = number; });
  }
  return found;
}

//------------------------------------------------------------------------------
/// The samples of all patches of a region. Of those that several have the first counts.
std::vector<double> AmrHierarchy::GatherSamples(const AmrRegion& region, Index3& dimensions) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    dimensions[axis] = region.Cells[axis] + (this->OfCells ? 0 : 1);
  }
  std::vector<double> gathered(Count(dimensions));
  std::for_each(region.Patches.rbegin(), region.Patches.rend(),
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->Patches[number];
      DispatchScalarType(patch.Samples,
        [&](const auto& samples)
        {
          ForEachIndex({ 0, 0, 0 }, samples.GetDimensions(),
            [&](const Index3& i)
            {
              Index3 place;
              for (std::size_t axis = 0; axis < 3; ++axis)
              {
                place[axis] = patch.First[axis] - region.First[axis] + i[axis];
              }
              gathered[Offset(place, dimensions)] = static_cast<double>(*samples.At(i));
            });
        });
    });
  return gathered;
}

//------------------------------------------------------------------------------
/// Fills the nodes that only cells of a region touch, as NodeReader reads them, but faster. Returns
/// false if other patches may have some of these cells.
bool AmrHierarchy::FillInner(const AmrRegion& region, AmrNodes& nodes) const
{
  if (this->Levels[static_cast<std::size_t>(region.Level)].HasOverlaps ||
    std::any_of(region.Patches.begin(), region.Patches.end(),
      [this](std::size_t number) { return this->Patches[number].GhostCells != nullptr; }))
  {
    return false;
  }
  Index3 dimensions;
  std::vector<double> samples = this->GatherSamples(region, dimensions);
  // Samples of points have the first inner node at 1, means of cells at 0.
  int first = 1;
  if (this->OfCells)
  {
    samples = RefineCells(std::move(samples), region.Cells);
    dimensions = { 2 * region.Cells[0] - 1, 2 * region.Cells[1] - 1, 2 * region.Cells[2] - 1 };
    first = 0;
  }
  ForEachIndex({ 2, 2, 2 },
    { nodes.Dimensions[0] - 4, nodes.Dimensions[1] - 4, nodes.Dimensions[2] - 4 },
    [&](const Index3& node)
    {
      const Index3 place = { node[0] - 2 + first, node[1] - 2 + first, node[2] - 2 + first };
      nodes.Values[Offset(node, nodes.Dimensions)] = samples[Offset(place, dimensions)];
    });
  return true;
}

//------------------------------------------------------------------------------
AmrNodes AmrHierarchy::MakeNodes(const AmrRegion& region) const
{
  const int nodesOfCell = this->GetNodesOfCell();
  AmrNodes nodes;
  Index3 first;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    first[axis] = nodesOfCell * region.First[axis] - 1;
    nodes.Dimensions[axis] = nodesOfCell * region.Cells[axis] + 3;
  }
  nodes.Values.resize(Count(nodes.Dimensions));
  const bool isInnerKnown = this->FillInner(region, nodes);
  std::vector<Index3> missing;
  NodeReader reader(*this);
  ForEachIndex({ 0, 0, 0 }, nodes.Dimensions,
    [&](const Index3& i)
    {
      if (isInnerKnown && IsInner(i, nodes))
      {
        return;
      }
      const std::optional<double> value =
        reader.Read(region.Level, { first[0] + i[0], first[1] + i[1], first[2] + i[2] });
      nodes.Values[Offset(i, nodes.Dimensions)] = value.value_or(0.0);
      if (!value)
      {
        missing.push_back(i);
      }
    });
  // Around the data, values go on in a straight line, so that central differences are one-sided.
  for (const Index3& node : missing)
  {
    Index3 nearest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      nearest[axis] = std::clamp(node[axis], 1, nodes.Dimensions[axis] - 2);
    }
    const double atNearest = nodes.Values[Offset(nearest, nodes.Dimensions)];
    double value = atNearest;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Index3 next = nearest;
      next[axis] -= node[axis] - nearest[axis];
      value += atNearest - nodes.Values[Offset(next, nodes.Dimensions)];
    }
    nodes.Values[Offset(node, nodes.Dimensions)] = value;
    nodes.Continued.push_back(Offset(node, nodes.Dimensions));
  }
  this->HideCells(region, nodes);
  return nodes;
}

//------------------------------------------------------------------------------
/// Includes what finer patches may give the cells of a box that a level lacks: their samples there,
/// or, quicker but for more, all of them.
void AmrHierarchy::IncludeLent(
  int level, Index3 first, Index3 end, bool asWhole, AmrRange& range) const
{
  if (this->LentRanges.empty())
  {
    return;
  }
  for (auto finer = static_cast<std::size_t>(level) + 1; finer < this->Levels.size(); ++finer)
  {
    const Level& all = this->Levels[finer];
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] *= all.Ratio[axis];
      end[axis] *= all.Ratio[axis];
      count[axis] = end[axis] - first[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t number)
      {
        const AmrRange& lent = this->LentRanges[number];
        if (asWhole)
        {
          range.Min = std::min(range.Min, lent.Min);
          range.Max = std::max(range.Max, lent.Max);
        }
        else if (lent.Min <= lent.Max)
        {
          Include(this->Patches[number], true, first, end, range);
        }
      });
  }
}

//------------------------------------------------------------------------------
/// Nodes have values of samples, means of them, or are between those of coarser levels.
AmrRange AmrHierarchy::FindRange(const AmrRegion& region) const
{
  // The cells that touch nodes of the region, of the layer behind it, and of the cells of coarser
  // levels that these are in.
  const int margin = this->OfCells ? 1 : 2;
  Index3 first = region.First;
  Index3 end = GetEnd(first, region.Cells);
  AmrRange range;
  for (int level = region.Level; level >= 0; --level)
  {
    const Level& all = this->Levels[static_cast<std::size_t>(level)];
    Index3 count;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] -= margin;
      end[axis] += margin;
      count[axis] = end[axis] - first[axis];
    }
    const Bounds box = GetBox(first, count);
    all.ForEachIn(box,
      [&](std::size_t other) { Include(this->Patches[other], this->OfCells, first, end, range); });
    // Coarser cells are as large as many of the finest.
    this->IncludeLent(level, first, end, level < region.Level, range);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = FloorDivide(first[axis], all.Ratio[axis]);
      end[axis] = -FloorDivide(-end[axis], all.Ratio[axis]);
    }
  }
  // More than the rounding of means.
  const double slack = 1e-12 * std::max(std::abs(range.Min), std::abs(range.Max));
  return range.Min <= range.Max ? AmrRange{ range.Min - slack, range.Max + slack } : range;
}

//------------------------------------------------------------------------------
/// Which cells of a region, and of the layer behind it, are hidden.
class AmrHierarchy::HiddenCells
{
public:
  explicit HiddenCells(const AmrRegion& region)
    : First(region.First)
    , Size{ region.Cells[0] + 1, region.Cells[1] + 1, region.Cells[2] + 1 }
    , Flags(Count(this->Size), 0)
  {
  }

  const Index3& GetSize() const { return this->Size; }
  bool IsEmpty() const
  {
    return std::find(this->Flags.begin(), this->Flags.end(), 1) == this->Flags.end();
  }

  /// Cells are on the lattice of the level.
  bool Has(const Index3& cell) const { return this->Flags[this->GetPlace(cell)] != 0; }
  void Add(const Index3& cell) { this->Flags[this->GetPlace(cell)] = 1; }

private:
  std::size_t GetPlace(const Index3& cell) const
  {
    return Offset(
      { cell[0] - this->First[0], cell[1] - this->First[1], cell[2] - this->First[2] }, this->Size);
  }

  Index3 First;
  Index3 Size;
  std::vector<unsigned char> Flags;
};

//------------------------------------------------------------------------------
/// Hides the cells that patches of a region do not have, or do not show.
void AmrHierarchy::HideOwn(const AmrRegion& region, HiddenCells& hidden) const
{
  for (const std::size_t number : region.Patches)
  {
    const AmrPatch& patch = this->Patches[number];
    ForEachIndex(patch.First, patch.Cells,
      [&](const Index3& cell)
      {
        const std::size_t place = GetNumber(patch, cell);
        if ((patch.GhostCells && patch.GhostCells[place] != 0) ||
          (patch.HiddenCells && patch.HiddenCells[place] != 0))
        {
          hidden.Add(cell);
        }
      });
  }
}

//------------------------------------------------------------------------------
/// Hides the cells in place of which others count: finer ones, and those of the patches of the
/// level that come first. Cells behind the region count, too: a ray in a face of it may be taken
/// for one in these.
void AmrHierarchy::HideReplaced(const AmrRegion& region, HiddenCells& hidden) const
{
  // In cells of each level.
  Bounds around = GetBox(region.First, hidden.GetSize());
  Index3 ratio = { 1, 1, 1 };
  for (auto level = static_cast<std::size_t>(region.Level); level < this->Levels.size(); ++level)
  {
    const bool isOwnLevel = level == static_cast<std::size_t>(region.Level);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ratio[axis] *= isOwnLevel ? 1 : this->Levels[level].Ratio[axis];
      around.Lower[axis] *= isOwnLevel ? 1.0 : this->Levels[level].Ratio[axis];
      around.Upper[axis] *= isOwnLevel ? 1.0 : this->Levels[level].Ratio[axis];
    }
    this->Levels[level].ForEachIn(around,
      [&](std::size_t number)
      {
        // A region of several patches overlaps no other.
        if (isOwnLevel && number >= region.Patches.front())
        {
          return;
        }
        const AmrPatch& other = this->Patches[number];
        // The cells that the other patch has as a whole.
        Index3 low;
        Index3 count;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const int end = FloorDivide(other.First[axis] + other.Cells[axis], ratio[axis]);
          low[axis] = std::max(-FloorDivide(-other.First[axis], ratio[axis]), region.First[axis]);
          count[axis] = std::min(end, region.First[axis] + region.Cells[axis] + 1) - low[axis];
        }
        ForEachIndex(low, count,
          [&](const Index3& cell)
          {
            if (!isOwnLevel || (IsIn(region, cell) && Owns(other, cell)))
            {
              hidden.Add(cell);
            }
          });
      });
  }
}

//------------------------------------------------------------------------------
/// Hides cells of the layer behind a region that are behind hidden ones, and have nothing of their
/// own to show: rays of projections go on into them.
void AmrHierarchy::HideBehind(const AmrRegion& region, HiddenCells& hidden) const
{
  ForEachIndex(region.First, hidden.GetSize(),
    [&](const Index3& cell)
    {
      Index3 last;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        last[axis] = std::min(cell[axis], region.First[axis] + region.Cells[axis] - 1);
      }
      if (cell != last && hidden.Has(last) && !this->IsShown(region.Level, cell))
      {
        hidden.Add(cell);
      }
    });
}

//------------------------------------------------------------------------------
void AmrHierarchy::HideCells(const AmrRegion& region, AmrNodes& nodes) const
{
  HiddenCells hidden(region);
  this->HideOwn(region, hidden);
  this->HideReplaced(region, hidden);
  if (hidden.IsEmpty())
  {
    return;
  }
  this->HideBehind(region, hidden);
  const int nodesOfCell = this->GetNodesOfCell();
  const Index3 cells = { nodes.Dimensions[0] - 2, nodes.Dimensions[1] - 2,
    nodes.Dimensions[2] - 2 };
  nodes.HiddenCells.resize(Count(cells), 0);
  ForEachIndex({ 0, 0, 0 }, cells,
    [&](const Index3& i)
    {
      Index3 cell;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cell[axis] = region.First[axis] + i[axis] / nodesOfCell;
      }
      nodes.HiddenCells[Offset(i, cells)] = hidden.Has(cell) ? 1 : 0;
    });
}

}
