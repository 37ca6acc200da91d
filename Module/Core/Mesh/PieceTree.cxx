// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PieceTree.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr std::size_t Width = PieceTreeNode::Width;
constexpr std::size_t SetSize = PackedPieces::Capacity;

using PassedCell = PieceTree::PassedCell;

/// Appends cells, of which the corners are given.
template <int Corners>
void Append(const std::uint32_t* numbers, const double (*corners)[Corners][4], int count,
  std::vector<PassedCell>& cells)
{
  for (int i = 0; i < count; ++i)
  {
    PassedCell cell{};
    for (int axis = 0; axis < 3; ++axis)
    {
      double sum = 0.0;
      for (const double(&corner)[4] : corners[i])
      {
        sum += corner[axis] * (1.0 / Corners);
      }
      cell.Center[axis] = static_cast<float>(sum);
    }
    cell.Number = numbers[i];
    cells.push_back(cell);
  }
}

/// The cells that a surface passes, of both kinds.
struct CellsOfKinds
{
  std::vector<PassedCell> Tetrahedra;
  std::vector<PassedCell> Others;

  void Append(const MeshCells& cells, const CellsOfLeaf& tetrahedra, const CellsOfLeaf& others)
  {
    constexpr int most = PackedPieces::Capacity;
    for (int first = 0; first < tetrahedra.Count; first += most)
    {
      double corners[most][4][4];
      const int count = std::min(most, tetrahedra.Count - first);
      cells.LoadTetrahedra(&tetrahedra.Cells[first], count, corners);
      vtkIsosurfaceRayTracing::Append(&tetrahedra.Cells[first], corners, count, this->Tetrahedra);
    }
    for (int first = 0; first < others.Count; first += most)
    {
      double corners[most][PassedCellRecords::Corners][4];
      const int count = std::min(most, others.Count - first);
      cells.LoadTrilinear(&others.Cells[first], count, corners);
      vtkIsosurfaceRayTracing::Append(&others.Cells[first], corners, count, this->Others);
    }
  }
};

CellsOfKinds FindCells(const PieceMaker& maker)
{
  CellsOfKinds found;
  for (std::size_t leaf = 0; leaf < maker.GetNumberOfLeaves(); ++leaf)
  {
    CellsOfLeaf tetrahedra;
    CellsOfLeaf others;
    maker.FindPassedCells(leaf, tetrahedra, others);
    found.Append(maker.GetCells(), tetrahedra, others);
  }
  return found;
}

/// The axis along which the centres of some cells are farthest from each other.
std::size_t FindLongestAxis(const PassedCell* cells, std::size_t count)
{
  float lower[3] = { HUGE_VALF, HUGE_VALF, HUGE_VALF };
  float upper[3] = { -HUGE_VALF, -HUGE_VALF, -HUGE_VALF };
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], cells[i].Center[axis]);
      upper[axis] = std::max(upper[axis], cells[i].Center[axis]);
    }
  }
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    longest = upper[axis] - lower[axis] > upper[longest] - lower[longest] ? axis : longest;
  }
  return longest;
}

/// Puts cells in the order of the tree: the first half has as many sets as a power of two.
void SortCells(PassedCell* cells, std::size_t count)
{
  while (count > SetSize)
  {
    std::size_t half = SetSize;
    while (2 * half < count)
    {
      half *= 2;
    }
    const std::size_t axis = FindLongestAxis(cells, count);
    std::nth_element(cells, cells + half, cells + count,
      [axis](const PassedCell& a, const PassedCell& b) { return a.Center[axis] < b.Center[axis]; });
    SortCells(cells, half);
    cells += half;
    count -= half;
  }
}

/// The boxes of the pieces of a set, of which so many corners are packed.
void FindBoxes(const PackedPieces& set, int corners, PieceBoxes& boxes)
{
  constexpr unsigned int steps = PieceBoxes::Steps;
  constexpr unsigned int perSteps = PackedPieces::Steps;
  boxes.Count = set.Count;
  for (int axis = 0; axis < 3; ++axis)
  {
    boxes.Lower[axis] = set.Lower[axis];
    boxes.Step[axis] = static_cast<float>(
      (static_cast<double>(set.Upper[axis]) - static_cast<double>(set.Lower[axis])) / steps);
    for (int i = 0; i < PieceBoxes::Capacity; ++i)
    {
      unsigned int lower = perSteps;
      unsigned int upper = 0;
      for (int corner = 0; corner < corners; ++corner)
      {
        const unsigned int place =
          set.Polygons[corner][i] >> (PackedPieces::Bits * axis) & PackedPieces::Steps;
        lower = std::min(lower, place);
        upper = std::max(upper, place);
      }
      boxes.Ends[axis][i] = static_cast<std::uint8_t>(lower * steps / perSteps);
      boxes.Ends[axis + 3][i] =
        static_cast<std::uint8_t>((upper * steps + perSteps - 1) / perSteps);
    }
  }
}

void Include(const float (&lower)[3], const float (&upper)[3], int child, PieceTreeNode& node)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    node.Ends[axis][child] = lower[axis];
    node.Ends[axis + 3][child] = upper[axis];
  }
}

}

//------------------------------------------------------------------------------
PieceTree::PieceTree(const PieceMaker& maker, std::vector<PassedCell>& cells, bool areTetrahedra,
  const Kernels& kernels)
{
  SortCells(cells.data(), cells.size());
  this->Cells.resize(cells.size());
  std::transform(cells.begin(), cells.end(), this->Cells.begin(),
    [](const PassedCell& cell) { return cell.Number; });
  this->BuildLevels(this->PackSets(maker, areTetrahedra, kernels));
}

//------------------------------------------------------------------------------
std::vector<PieceTreeNode> PieceTree::PackSets(
  const PieceMaker& maker, bool areTetrahedra, const Kernels& kernels)
{
  const std::size_t count = this->Cells.size();
  const std::size_t sets = (count + SetSize - 1) / SetSize;
  this->Boxes.resize(sets);
  this->Polygons.resize(areTetrahedra ? sets : 0);
  std::vector<PieceTreeNode> nodes((sets + Width - 1) / Width);
  for (std::size_t number = 0; number < sets; ++number)
  {
    const std::size_t first = number * SetSize;
    PackedPieces other;
    PackedPieces& set = areTetrahedra ? this->Polygons[number] : other;
    set.Count = static_cast<std::uint8_t>(std::min(count - first, SetSize));
    set.AreInTetrahedra = areTetrahedra;
    maker.Pack(&this->Cells[first], kernels, set);
    FindBoxes(set, areTetrahedra ? PackedPieces::Corners : 2, this->Boxes[number]);
    Include(set.Lower, set.Upper, static_cast<int>(number % Width), nodes[number / Width]);
  }
  return nodes;
}

//------------------------------------------------------------------------------
void PieceTree::BuildLevels(std::vector<PieceTreeNode> nodes)
{
  this->Levels.push_back(std::move(nodes));
  std::size_t children = this->Boxes.size();
  while (this->Levels.back().size() > 1)
  {
    const std::vector<PieceTreeNode>& below = this->Levels.back();
    nodes.assign((below.size() + Width - 1) / Width, {});
    for (std::size_t i = 0; i < below.size(); ++i)
    {
      const auto count = static_cast<std::ptrdiff_t>(std::min(children - i * Width, Width));
      float lower[3];
      float upper[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        lower[axis] = *std::min_element(below[i].Ends[axis], below[i].Ends[axis] + count);
        upper[axis] = *std::max_element(below[i].Ends[axis + 3], below[i].Ends[axis + 3] + count);
      }
      Include(lower, upper, static_cast<int>(i % Width), nodes[i / Width]);
    }
    children = below.size();
    this->Levels.push_back(std::move(nodes));
  }
}

//------------------------------------------------------------------------------
PieceTreeLevels PieceTree::GetLevels() const
{
  PieceTreeLevels levels{};
  levels.Boxes = this->Boxes.data();
  levels.Polygons = this->Polygons.empty() ? nullptr : this->Polygons.data();
  levels.Cells = this->Cells.data();
  std::size_t children = this->Boxes.size();
  for (const std::vector<PieceTreeNode>& level : this->Levels)
  {
    levels.Nodes[levels.Count] = level.data();
    levels.Children[levels.Count++] = static_cast<std::uint32_t>(children);
    children = level.size();
  }
  return levels;
}

//------------------------------------------------------------------------------
std::size_t PieceTree::GetMemory() const
{
  std::size_t nodes = 0;
  for (const std::vector<PieceTreeNode>& level : this->Levels)
  {
    nodes += level.size();
  }
  return this->Cells.size() * sizeof(std::uint32_t) + this->Boxes.size() * sizeof(PieceBoxes) +
    this->Polygons.size() * sizeof(PackedPieces) + nodes * sizeof(PieceTreeNode);
}

//------------------------------------------------------------------------------
PieceTrees::PieceTrees(const PieceMaker& maker, const Kernels& kernels)
{
  CellsOfKinds cells = FindCells(maker);
  for (std::vector<PassedCell>* some : { &cells.Tetrahedra, &cells.Others })
  {
    if (!some->empty())
    {
      this->Trees.emplace_back(maker, *some, some == &cells.Tetrahedra, kernels);
    }
  }
}

//------------------------------------------------------------------------------
std::size_t PieceTrees::GetMemory() const
{
  std::size_t memory = 0;
  for (const PieceTree& tree : this->Trees)
  {
    memory += tree.GetMemory();
  }
  return memory;
}

//------------------------------------------------------------------------------
const PieceTrees* PieceTreesOnDemand::Find(int rays, double raysForTrees, const Kernels& kernels)
{
  if (static_cast<double>(this->Rays.fetch_add(rays, std::memory_order_relaxed)) < raysForTrees)
  {
    return nullptr;
  }
  const PieceTrees* built = this->Get();
  if (built || this->AreBegun.exchange(true))
  {
    return built;
  }
  try
  {
    this->Trees = std::make_unique<PieceTrees>(this->Maker, kernels);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
  this->Built.store(this->Trees.get(), std::memory_order_release);
  return this->Trees.get();
}

}
