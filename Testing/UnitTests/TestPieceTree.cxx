// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What single rays find in trees of pieces, against more precise arithmetic, with any instruction
// set: all that is met, and little beside it.

#include "AllKernels.h"
#include "LoneRay.h"
#include "Mesh/MeshField.h"
#include "Mesh/PieceTree.h"
#include "PieceOfTetrahedron.h"
#include "TestMesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr double Isovalue = 0.2;
constexpr std::uint32_t NoCell = std::numeric_limits<std::uint32_t>::max();

/// A mesh with the trees over the pieces of one surface.
struct MeshWithTrees
{
  TestMesh Mesh;
  MeshCells Cells;
  CellTree Tree;
  PieceMaker Maker;
  PieceTrees Pieces;

  MeshWithTrees(const TestMesh& mesh, const Kernels& kernels)
    : Mesh(mesh)
    , Cells(this->Mesh.View())
    , Tree(this->Cells, 1)
    , Maker(this->Cells, this->Tree, Isovalue, 1.0)
    , Pieces(this->Maker, kernels)
  {
  }

  /// The cells of all pieces.
  std::vector<std::uint32_t> GetCells() const
  {
    std::vector<std::uint32_t> cells;
    for (const PieceTree& tree : this->Pieces.Get())
    {
      const PieceTreeLevels levels = tree.GetLevels();
      for (std::size_t set = 0; set < levels.Children[0]; ++set)
      {
        const std::uint32_t* first = levels.Cells + set * PieceBoxes::Capacity;
        cells.insert(cells.end(), first, first + levels.Boxes[set].Count);
      }
    }
    return cells;
  }

  /// Those of which a ray may meet the pieces, but for one that it starts in.
  std::vector<std::uint32_t> FindOnRay(
    const Kernels& kernels, const LoneRay& ray, std::uint32_t startCell) const
  {
    const ScatteredRays rays = ray.Scatter(kernels);
    std::vector<std::uint32_t> found;
    for (const PieceTree& tree : this->Pieces.Get())
    {
      const PieceTreeLevels levels = tree.GetLevels();
      WayThroughTree way;
      way.Begin(levels.Count);
      unsigned int pieces;
      int set;
      while ((set = kernels.FindSetOnRay(levels, rays, 0, startCell, way, pieces)) >= 0)
      {
        for (int piece = 0; piece < PieceBoxes::Capacity; ++piece)
        {
          if ((pieces >> piece & 1U) != 0)
          {
            found.push_back(levels.Cells[set * PieceBoxes::Capacity + piece]);
          }
        }
      }
    }
    return found;
  }
};

/// Waves with noise, scaled and far from the origin by a number of its size.
TestMesh MakeWaves(RandomNumbers& random, Cutting cutting, double scale, double distance)
{
  const Index3 cubes = { random.Integer(1, 16), random.Integer(1, 12), random.Integer(1, 8) };
  TestMesh mesh = MakeMesh(random, cubes, cutting, 0.3,
    [&random](const Index3& p) { return std::sin(1.1 * p[0] + p[1]) + random.Uniform(-1.0, 1.0); });
  for (double& coordinate : mesh.Points)
  {
    coordinate = scale * (coordinate + distance);
  }
  return mesh;
}

class PieceTreeTest : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, PieceTreeTest, AllKernels(), NameOfKernels);

TEST_P(PieceTreeTest, HasEveryPieceOnce)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(1);
    const TestMesh mesh = MakeMesh(random, { 20, 20, 20 }, cutting, 0.2,
      [&random](const Index3&) { return random.Uniform(-1.0, 1.0); });
    const MeshWithTrees all(mesh, this->TheKernels);
    std::vector<std::uint32_t> expected;
    for (std::uint32_t number = 0; number < all.Cells.GetNumberOfCells(); ++number)
    {
      if (all.Cells.FindStraddling(&number, 1, Isovalue) != 0)
      {
        expected.push_back(number);
      }
    }
    std::vector<std::uint32_t> cells = all.GetCells();
    std::sort(cells.begin(), cells.end());
    EXPECT_EQ(cells, expected);
    EXPECT_LT(all.Pieces.GetMemory(), 40 * cells.size());
  }
}

TEST_P(PieceTreeTest, FindsPiecesOfTetrahedra)
{
  RandomNumbers random(2);
  std::size_t met = 0;
  std::size_t superfluous = 0;
  for (int i = 0; i < 500; ++i)
  {
    const double distance = i % 3 == 0 ? random.Uniform(-1e4, 1e4) : 0.0;
    const MeshWithTrees all(
      MakeWaves(random, Cutting::Tetrahedra, random.WideMagnitude(-9.0, 9.0), distance),
      this->TheKernels);
    const std::vector<std::uint32_t> cells = all.GetCells();
    for (int j = 0; j < 20; ++j)
    {
      const LoneRay ray(random, all.Tree.GetBounds());
      if (!ray.Exists())
      {
        continue;
      }
      std::vector<std::uint32_t> found = all.FindOnRay(this->TheKernels, ray, NoCell);
      std::sort(found.begin(), found.end());
      ASSERT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
      for (const std::uint32_t cell : cells)
      {
        double corners[1][4][4];
        all.Cells.LoadTetrahedra(&cell, 1, corners);
        SubtractIsovalue(Isovalue, 1.0, corners, 1);
        const bool isFound = std::binary_search(found.begin(), found.end(), cell);
        const PieceOfTetrahedron piece(corners[0]);
        const bool isMet = piece.IsMetBy(ray.Packet);
        ASSERT_TRUE(isFound || !isMet) << "mesh " << i << ", ray " << j;
        met += isMet ? 1 : 0;
        superfluous += isFound && !isMet && !ray.Meets(piece, 0.05L) ? 1 : 0;
      }
      if (!found.empty())
      {
        const std::uint32_t start = found[random.Bits() % found.size()];
        std::vector<std::uint32_t> others = all.FindOnRay(this->TheKernels, ray, start);
        others.push_back(start);
        std::sort(others.begin(), others.end());
        ASSERT_EQ(others, found);
      }
    }
  }
  EXPECT_GT(met, 5000U);
  EXPECT_LT(superfluous, met / 20);
}

/// Those in other cells are found where the field is hit.
TEST_P(PieceTreeTest, FindsPiecesOfOtherCells)
{
  RandomNumbers random(3);
  std::size_t met = 0;
  std::size_t all = 0;
  for (int i = 0; i < 100; ++i)
  {
    const Cutting cutting = AllCuttings[static_cast<std::size_t>(i) % std::size(AllCuttings)];
    const MeshWithTrees mesh(
      MakeWaves(random, cutting, random.WideMagnitude(-9.0, 9.0), 0.0), this->TheKernels);
    MeshField field(mesh.Mesh.View(), 1);
    field.Select(TraceRequest({ { Isovalue, 0.5 } }), { 1, nullptr });
    for (int j = 0; j < 40; ++j)
    {
      const LoneRay ray(random, mesh.Tree.GetBounds());
      if (!ray.Exists())
      {
        continue;
      }
      RayPacket packet = ray.Packet;
      RayHits hits;
      field.Trace(packet, hits);
      const std::vector<std::uint32_t> found = mesh.FindOnRay(this->TheKernels, ray, NoCell);
      for (const Hit& hit : hits.Hits)
      {
        ASSERT_NE(std::find(found.begin(), found.end(), hit.Cell), found.end())
          << "mesh " << i << ", ray " << j;
      }
      met += hits.Hits.size();
      all += found.size();
    }
  }
  EXPECT_GT(met, 1000U);
  EXPECT_LT(all, 5 * met);
}

/// They are built after as many rays as are worth it, by one of the threads, and kept with the
/// isovalue.
TEST_P(PieceTreeTest, AreBuiltForManyRays)
{
  RandomNumbers random(4);
  const TestMesh mesh = MakeMesh(random, { 9, 9, 9 }, Cutting::Mixed, 0.3,
    [&random](const Index3&) { return random.Uniform(-1.0, 1.0); });
  const MeshWithTrees all(mesh, this->TheKernels);
  MeshField field(mesh.View(), 1);
  constexpr int packets = 10;
  constexpr int raysOfPacket = 64;
  const auto cells = static_cast<double>(all.Cells.GetNumberOfCells());
  // Returns the memory after the same rays in any order.
  const auto cast = [&](double isovalue, double raysForTrees)
  {
    field.Select(
      TraceRequest({ { isovalue, 1.0 } }), { 1, &this->TheKernels, (raysForTrees - 0.5) / cells });
#pragma omp parallel for num_threads(4)
    for (int i = 0; i < packets; ++i)
    {
      RandomNumbers ofPacket(static_cast<std::uint64_t>(i));
      RayPacket packet;
      packet.Clear();
      for (int ray = 0; ray < raysOfPacket; ++ray)
      {
        field.AddRay({ 4.5, 4.5, 4.5 }, ofPacket.Direction(), 0.01 * ray, Infinity, packet);
      }
      RayHits hits;
      field.Trace(packet, hits);
    }
    return field.GetStatistics().CacheMemory;
  };
  constexpr double worth = 2 * packets * raysOfPacket;
  const std::size_t without = cast(Isovalue, Infinity);
  EXPECT_EQ(cast(Isovalue, worth), without);
  const std::size_t with = without + all.Pieces.GetMemory();
  EXPECT_EQ(cast(Isovalue, worth), with);
  EXPECT_EQ(cast(Isovalue, worth), with);
  EXPECT_LT(cast(Isovalue + 0.01, worth), with);
}

}
}
