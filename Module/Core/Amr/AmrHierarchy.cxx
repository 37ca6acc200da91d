// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Amr/AmrHierarchy.h"

#include "Amr/AmrHiddenCells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace vtkIsosurfaceRayTracing
{
namespace
{

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

/// Gives values to nodes around the data: they go on in a straight line, so that central
/// differences are one-sided.
void ContinueInto(const std::vector<Index3>& missing, AmrNodes& nodes)
{
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
}

}

//------------------------------------------------------------------------------
/// Finds the values of nodes, and keeps those of coarser levels, which many have in common.
class AmrHierarchy::NodeReader
{
public:
  explicit NodeReader(const AmrPatches& patches)
    : Patches(patches)
    , Lately(static_cast<std::size_t>(patches.GetNumberOfLevels()))
    , Coarser(static_cast<std::size_t>(patches.GetNumberOfLevels()))
    , Means(static_cast<std::size_t>(patches.GetNumberOfLevels()))
  {
  }

  /// None where no cell touches the node.
  std::optional<double> Read(int level, const Index3& node)
  {
    AmrPatches::Likely& likely = this->Lately[static_cast<std::size_t>(level)];
    const AmrPatch* owner = nullptr;
    bool isCoarser = false;
    double sum = 0.0;
    int count = 0;
    ForEachTouching(node, this->Patches.GetNodesOfCell(),
      [&](const Index3& cell)
      {
        if (const AmrPatch* patch = this->Patches.FindOwner(level, cell, likely))
        {
          owner = owner ? std::min(owner, patch) : patch;
          sum += this->Patches.AreOfCells() ? GetSample(*patch, cell) : 0.0;
          ++count;
        }
        else if (this->Patches.IsCoveredByFiner(level, cell))
        {
          sum += this->Patches.AreOfCells() ? this->ReadMean(level, cell) : 0.0;
          count += this->Patches.AreOfCells() ? 1 : 0;
        }
        else
        {
          isCoarser = isCoarser || this->Patches.IsCoveredByCoarser(level, cell, 0);
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
    return this->Patches.AreOfCells() ? sum / count : GetSample(*owner, node);
  }

private:
  /// At a node of a level, between the nodes of the one before.
  std::optional<double> Interpolate(int level, const Index3& node)
  {
    const Index3& ratio = this->Patches.GetLevel(level).Ratio;
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
      [&] { return this->Patches.FindMean(level, cell); });
  }

  template <typename Value, typename Find>
  static Value Remember(std::map<Index3, Value>& known, const Index3& place, const Find& find)
  {
    const auto found = known.find(place);
    return found != known.end() ? found->second : known.emplace(place, find()).first->second;
  }

  const AmrPatches& Patches;
  /// Of each level.
  std::vector<AmrPatches::Likely> Lately;
  std::vector<std::map<Index3, std::optional<double>>> Coarser;
  std::vector<std::map<Index3, double>> Means;
};

//------------------------------------------------------------------------------
AmrHierarchy::AmrHierarchy(std::vector<Index3> ratios, std::vector<AmrPatch> patches, bool ofCells)
  : Patches(std::move(ratios), std::move(patches), ofCells)
  , Ranges(this->Patches)
{
}

//------------------------------------------------------------------------------
/// The samples of all patches of a region. Of those that several have the first counts.
std::vector<double> AmrHierarchy::GatherSamples(const AmrRegion& region, Index3& dimensions) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    dimensions[axis] = region.Cells[axis] + (this->Patches.AreOfCells() ? 0 : 1);
  }
  std::vector<double> gathered(Count(dimensions));
  std::for_each(region.Patches.rbegin(), region.Patches.rend(),
    [&](std::size_t number)
    {
      const AmrPatch& patch = this->Patches.Get(number);
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
  if (this->Patches.GetLevel(region.Level).HasOverlaps ||
    std::any_of(region.Patches.begin(), region.Patches.end(),
      [this](std::size_t number) { return this->Patches.Get(number).GhostCells != nullptr; }))
  {
    return false;
  }
  Index3 dimensions;
  std::vector<double> samples = this->GatherSamples(region, dimensions);
  // Samples of points have the first inner node at 1, means of cells at 0.
  int first = 1;
  if (this->Patches.AreOfCells())
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
  const int nodesOfCell = this->Patches.GetNodesOfCell();
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
  NodeReader reader(this->Patches);
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
  ContinueInto(missing, nodes);
  this->HideCells(region, nodes);
  return nodes;
}

//------------------------------------------------------------------------------
void AmrHierarchy::HideCells(const AmrRegion& region, AmrNodes& nodes) const
{
  const AmrHiddenCells hidden(this->Patches, region);
  if (hidden.IsEmpty())
  {
    return;
  }
  const int nodesOfCell = this->Patches.GetNodesOfCell();
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
