// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/PieceTree.h"

#include "Math/ThreadsOfLoop.h"

#include <algorithm>
#include <cmath>

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

CellsOfKinds FindCells(const PieceMaker& maker, int threads)
{
  const std::size_t leaves = maker.GetNumberOfLeaves();
  const int worth = GetThreadsOfLoop(leaves, 1000.0, threads);
  // Some for each thread, in order.
  const int parts = worth > 1 ? 8 * worth : 1;
  std::vector<CellsOfKinds> found(static_cast<std::size_t>(parts));
#pragma omp parallel for schedule(dynamic) num_threads(worth)
  for (int part = 0; part < parts; ++part)
  {
    const auto number = static_cast<std::size_t>(part);
    const auto all = static_cast<std::size_t>(parts);
    for (std::size_t leaf = leaves * number / all; leaf < leaves * (number + 1) / all; ++leaf)
    {
      CellsOfLeaf tetrahedra;
      CellsOfLeaf others;
      maker.FindPassedCells(leaf, tetrahedra, others);
      found[number].Append(maker.GetCells(), tetrahedra, others);
    }
  }
  CellsOfKinds all;
  for (const CellsOfKinds& part : found)
  {
    all.Tetrahedra.insert(all.Tetrahedra.end(), part.Tetrahedra.begin(), part.Tetrahedra.end());
    all.Others.insert(all.Others.end(), part.Others.begin(), part.Others.end());
  }
  return all;
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
    constexpr std::size_t leastOfTask = 4096;
#pragma omp task if (count > leastOfTask)
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
  const Kernels& kernels, int threads)
{
#pragma omp parallel num_threads(GetThreadsOfLoop(cells.size(), 100.0, threads))
#pragma omp single
  SortCells(cells.data(), cells.size());
  this->Cells.resize(cells.size());
  std::transform(cells.begin(), cells.end(), this->Cells.begin(),
    [](const PassedCell& cell) { return cell.Number; });
  this->BuildLevels(this->PackSets(maker, areTetrahedra, kernels, threads));
}

//------------------------------------------------------------------------------
std::vector<PieceTreeNode> PieceTree::PackSets(
  const PieceMaker& maker, bool areTetrahedra, const Kernels& kernels, int threads)
{
  const std::size_t count = this->Cells.size();
  this->Boxes.resize((count + SetSize - 1) / SetSize);
  this->Polygons.resize(areTetrahedra ? this->Boxes.size() : 0);
  std::vector<PieceTreeNode> nodes((this->Boxes.size() + Width - 1) / Width);
  const auto sets = static_cast<std::ptrdiff_t>(this->Boxes.size());
#pragma omp parallel for schedule(static)                                                          \
  num_threads(GetThreadsOfLoop(this->Boxes.size(), 1000.0, threads))
  for (std::ptrdiff_t i = 0; i < sets; ++i)
  {
    const auto number = static_cast<std::size_t>(i);
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
PieceTrees::PieceTrees(const PieceMaker& maker, const Kernels& kernels, int threads)
{
  CellsOfKinds cells = FindCells(maker, threads);
  for (std::vector<PassedCell>* some : { &cells.Tetrahedra, &cells.Others })
  {
    if (!some->empty())
    {
      this->Trees.emplace_back(maker, *some, some == &cells.Tetrahedra, kernels, threads);
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

}
