// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Meshes whose cells are split into tetrahedra. How a cell is split is tested by CellSubdivision.

#include "Mesh/CellSubdivision.h"
#include "Mesh/MeshCells.h"
#include "Mesh/Tetrahedralization.h"
#include "RandomNumbers.h"
#include "TestMesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

constexpr Index3 Cubes = { 17, 16, 18 }; // more cells than one thread splits at once

TestMesh MakeTestMesh(Cutting cutting)
{
  RandomNumbers random(1);
  return MakeMesh(
    random, Cubes, cutting, 0.2, [&](const Index3&) { return random.Uniform(-1.0, 1.0); });
}

/// Whether the tetrahedra are those of one cell after the other.
void ExpectTetrahedraOfCells(
  const MeshCells& cells, const Tetrahedralization& split, const MeshView& view)
{
  const MeshCells tetrahedra(view);
  ASSERT_TRUE(tetrahedra.AreTetrahedra());
  ASSERT_EQ(tetrahedra.GetNumberOfCells(), split.GetNumberOfTetrahedra());
  std::int64_t number = 0;
  for (std::int64_t i = 0; i < cells.GetNumberOfCells(); ++i)
  {
    MeshCell cell;
    if (!cells.Load(i, cell))
    {
      continue;
    }
    int corners[MaximumTetrahedra][4] = { { 0, 1, 2, 3 } };
    const int count = cell.Count == 4 ? 1 : SubdivideCell(cell, corners);
    ASSERT_EQ(count, CountTetrahedra(cell.Shape));
    for (int k = 0; k < count; ++k, ++number)
    {
      ASSERT_LT(number, split.GetNumberOfTetrahedra());
      ASSERT_EQ(split.GetCell(number), i);
      MeshCell tetrahedron;
      ASSERT_TRUE(tetrahedra.Load(number, tetrahedron));
      for (int corner = 0; corner < 4; ++corner)
      {
        const int of = corners[k][corner];
        ASSERT_EQ(tetrahedron.Ids[corner], cell.Ids[of]);
        ASSERT_EQ(tetrahedron.Points[corner], cell.Points[of]);
        ASSERT_EQ(tetrahedron.Values[corner], cell.Values[of]);
      }
    }
  }
  EXPECT_EQ(number, split.GetNumberOfTetrahedra());
}

//------------------------------------------------------------------------------
TEST(Tetrahedralization, ListsTheTetrahedraOfAllCells)
{
  for (const Cutting cutting : AllCuttings)
  {
    const TestMesh mesh = MakeTestMesh(cutting);
    const MeshCells cells(mesh.View());
    EXPECT_EQ(AreAllTetrahedra(cells), cutting == Cutting::Tetrahedra);
    for (const int threads : { 1, 3 })
    {
      const Tetrahedralization split(cells, threads);
      EXPECT_EQ(split.GetNumberOfTetrahedra(), CountTetrahedra(cells, threads));
      ExpectTetrahedraOfCells(cells, split, split.MakeView(mesh.View()));
    }
  }
}

//------------------------------------------------------------------------------
TEST(Tetrahedralization, PassesOverOtherShapes)
{
  TestMesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.AddPoint({ i & 1 ? 1.0 : 0.0, i & 2 ? 1.0 : 0.0, i & 4 ? 1.0 : 0.0 }, i);
  }
  constexpr auto triangle = static_cast<CellShape>(5);
  mesh.AddCell(triangle, { 0, 1, 2 });
  mesh.AddCell(CellShape::Tetrahedron, { 3, 0, 1, 4 });
  mesh.AddCell(triangle, { 1, 2, 3 });
  const MeshCells flat(mesh.View());
  EXPECT_TRUE(AreAllTetrahedra(flat));
  EXPECT_EQ(CountTetrahedra(flat), 1);
  mesh.AddCell(CellShape::Voxel, { 0, 1, 2, 3, 4, 5, 6, 7 });
  const MeshCells cells(mesh.View());
  EXPECT_FALSE(AreAllTetrahedra(cells));
  const Tetrahedralization split(cells);
  EXPECT_EQ(split.GetNumberOfTetrahedra(), 7);
  ExpectTetrahedraOfCells(cells, split, split.MakeView(mesh.View()));
}

//------------------------------------------------------------------------------
TEST(Tetrahedralization, SplitsLatticesAndShortIds)
{
  const TestMesh mesh = MakeTestMesh(Cutting::Hexahedra);
  MeshView lattice = mesh.View();
  lattice.Dimensions = { Cubes[0] + 1, Cubes[1] + 1, Cubes[2] + 1 };
  lattice.Shapes = nullptr;
  lattice.Offsets = nullptr;
  lattice.Connectivity = nullptr;
  const std::vector<std::int32_t> offsets(mesh.Offsets.begin(), mesh.Offsets.end());
  const std::vector<std::int32_t> connectivity(mesh.Connectivity.begin(), mesh.Connectivity.end());
  MeshView shorter = mesh.View();
  shorter.IdType = ScalarType::Int32;
  shorter.Offsets = offsets.data();
  shorter.Connectivity = connectivity.data();
  for (const MeshView& view : { lattice, shorter })
  {
    const Tetrahedralization split(MeshCells(view), 2);
    ExpectTetrahedraOfCells(MeshCells(mesh.View()), split, split.MakeView(view));
  }
}

//------------------------------------------------------------------------------
/// More than can be numbered: of a lattice, whose cells are nowhere.
TEST(Tetrahedralization, CountsWithoutPoints)
{
  MeshView lattice;
  lattice.Dimensions = { 901, 901, 901 };
  EXPECT_EQ(CountTetrahedra(MeshCells(lattice), 2), std::int64_t{ 6 } * 900 * 900 * 900);
}

}
}
