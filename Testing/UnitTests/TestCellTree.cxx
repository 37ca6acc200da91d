// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The tree over the cells of a mesh must hold each cell once, in boxes and ranges of values around
// it, and have compact blocks, whatever the order of the cells.

#include "Math/Arithmetic.h"
#include "Mesh/CellTree.h"
#include "Mesh/MeshCells.h"
#include "RandomNumbers.h"
#include "TestMesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// Tetrahedra of about the size of 1 in a box, each with points of its own. Consecutive ones are in
/// the same cube, or anywhere.
void AddTetrahedra(
  RandomNumbers& random, int count, const Bounds& box, bool areScattered, TestMesh& mesh)
{
  constexpr int ofCube = 64;
  Vector3 cube = {};
  for (int i = 0; i < count; ++i)
  {
    if (areScattered || i % ofCube == 0)
    {
      cube = random.PointInBox(box.Lower, box.Upper);
    }
    std::array<std::int64_t, 4> ids = {};
    for (std::int64_t& id : ids)
    {
      id = mesh.AddPoint(
        cube + random.PointInBox({ 0.0, 0.0, 0.0 }, { 1.0, 1.0, 1.0 }), random.Uniform(0.0, 1.0));
    }
    mesh.AddCell(CellShape::Tetrahedron, { ids[0], ids[1], ids[2], ids[3] });
  }
}

/// A box and a range of values: x, y, z and value.
struct Extent
{
  std::array<double, 4> Lower = { Infinity, Infinity, Infinity, Infinity };
  std::array<double, 4> Upper = { -Infinity, -Infinity, -Infinity, -Infinity };

  void Include(const Extent& other)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->Lower[i] = std::min(this->Lower[i], other.Lower[i]);
      this->Upper[i] = std::max(this->Upper[i], other.Upper[i]);
    }
  }
  bool Holds(const Extent& other) const
  {
    bool holds = true;
    for (std::size_t i = 0; i < 4; ++i)
    {
      holds = holds && this->Lower[i] <= other.Lower[i] && other.Upper[i] <= this->Upper[i];
    }
    return holds;
  }
  double GetVolume() const
  {
    return (this->Upper[0] - this->Lower[0]) * (this->Upper[1] - this->Lower[1]) *
      (this->Upper[2] - this->Lower[2]);
  }
};

Extent GetExtent(const TestMesh& mesh, std::uint32_t cell)
{
  Extent extent;
  for (std::size_t i = 4 * std::size_t{ cell }; i < 4 * (std::size_t{ cell } + 1); ++i)
  {
    const std::int64_t id = mesh.Connectivity[i];
    const Vector3 point = mesh.GetPoint(id);
    const std::array<double, 4> numbers = { point[0], point[1], point[2],
      mesh.Values[static_cast<std::size_t>(id)] };
    extent.Include({ numbers, numbers });
  }
  return extent;
}

Extent GetExtent(const CellTree& tree, int level, std::size_t child)
{
  const CellTreeNode& node = tree.GetNode(level, child / CellTree::Width);
  const std::size_t i = child % CellTree::Width;
  Extent extent;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    extent.Lower[axis] = static_cast<double>(node.Lower[axis][i]);
    extent.Upper[axis] = static_cast<double>(node.Upper[axis][i]);
  }
  extent.Lower[3] = static_cast<double>(node.Low[i]);
  extent.Upper[3] = static_cast<double>(node.High[i]);
  return extent;
}

/// Checks that each finite cell is in one block, and each child in its parent. Returns the mean
/// volume of the boxes of blocks.
double CheckTree(const TestMesh& mesh, const CellTree& tree)
{
  std::vector<int> found(mesh.Shapes.size(), 0);
  double volume = 0.0;
  for (std::size_t block = 0; block < tree.GetNumberOfBlocks(); ++block)
  {
    const Extent extent = GetExtent(tree, CellTree::LowestLevel, block);
    volume += extent.GetVolume();
    std::uint32_t numbers[CellTree::Width];
    const int count = tree.GetCells(block, numbers);
    for (int i = 0; i < count; ++i)
    {
      const Extent cell = GetExtent(mesh, numbers[i]);
      EXPECT_TRUE(extent.Holds(cell)) << numbers[i];
      ++found[numbers[i]];
    }
  }
  EXPECT_EQ(std::count(found.begin(), found.end(), 1), static_cast<std::ptrdiff_t>(found.size()));
  std::size_t children = (tree.GetNumberOfBlocks() + CellTree::Width - 1) / CellTree::Width;
  for (int level = 1; level < tree.GetNumberOfLevels(); ++level)
  {
    for (std::size_t child = 0; child < children; ++child)
    {
      const Extent extent = GetExtent(tree, level, child);
      for (std::size_t i = 0; i < CellTree::Width; ++i)
      {
        const Extent inside = GetExtent(tree, level - 1, child * CellTree::Width + i);
        EXPECT_TRUE(inside.Lower[3] > inside.Upper[3] || extent.Holds(inside)) << level;
      }
    }
    children = (children + CellTree::Width - 1) / CellTree::Width;
  }
  return volume / static_cast<double>(tree.GetNumberOfBlocks());
}

/// Enough cells for a tree that looks at a sample of them.
constexpr int Many = 100000;

TEST(CellTree, OfCellsInAnyOrder)
{
  const Bounds box = { { 0.0, 0.0, 0.0 }, { 20.0, 20.0, 20.0 } };
  for (const bool areScattered : { false, true })
  {
    for (const int count : { 1, 16, 17, 3000, Many })
    {
      SCOPED_TRACE(std::to_string(count) + (areScattered ? ", scattered" : ""));
      RandomNumbers random(static_cast<std::uint64_t>(count));
      TestMesh mesh;
      AddTetrahedra(random, count, box, areScattered, mesh);
      const MeshCells cells(mesh.View(), 2);
      const CellTree tree(cells, 2);
      const double volume = CheckTree(mesh, tree);
      // Sixteen of them anywhere in the box have one of 5000.
      EXPECT_LT(volume, count == Many ? 15.0 : 5000.0);
      EXPECT_TRUE(tree.AreAllFinite());
    }
  }
}

TEST(CellTree, OfScatteredCellsOfWhichFewAreFarAway)
{
  // The far ones are behind the last cells of any sample, and 30 times as many as there are in a
  // block.
  RandomNumbers random(7);
  TestMesh mesh;
  AddTetrahedra(random, Many, { { 0.0, 0.0, 0.0 }, { 20.0, 20.0, 20.0 } }, true, mesh);
  AddTetrahedra(random, 500, { { 500.0, 0.0, 0.0 }, { 520.0, 20.0, 20.0 } }, true, mesh);
  const MeshCells cells(mesh.View(), 2);
  const CellTree tree(cells, 2);
  // Blocks of both near and far ones would be large.
  EXPECT_LT(CheckTree(mesh, tree), 20.0);
  EXPECT_GT(tree.GetBounds().Upper[0], 500.0);
}

}
}
