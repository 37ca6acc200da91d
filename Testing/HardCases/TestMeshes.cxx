// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Meshes against the oracle, which looks at every cell by itself.

#include "ExactMesh.h"
#include "Mesh/MeshField.h"
#include "Picture/CastRays.h"
#include "Tally.h"
#include "TestMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace HardCases;
using vtkIsosurfaceRayTracing::AllCuttings;
using vtkIsosurfaceRayTracing::CellShape;
using vtkIsosurfaceRayTracing::Cutting;
using vtkIsosurfaceRayTracing::MakeMesh;
using vtkIsosurfaceRayTracing::MeshField;
using vtkIsosurfaceRayTracing::TestMesh;

namespace
{

/// What rounding may move values by, in units of the largest difference between a corner of the
/// cell and the isovalue; and positions, in sizes of the cell.
constexpr double Band = 1e-12;
constexpr double Accuracy = 1e-9;
/// So transparent that a ray passes any number of surfaces.
constexpr double Glass = 1e-12;

std::vector<Oracle::Cell> ToOracle(const TestMesh& mesh)
{
  std::vector<Oracle::Cell> cells;
  for (std::size_t i = 0; i < mesh.Shapes.size(); ++i)
  {
    Oracle::Cell cell;
    for (std::int64_t k = mesh.Offsets[i]; k < mesh.Offsets[i + 1]; ++k)
    {
      const std::int64_t id = mesh.Connectivity[static_cast<std::size_t>(k)];
      cell.Points.push_back(mesh.GetPoint(id));
      cell.Values.push_back(mesh.Values[static_cast<std::size_t>(id)]);
    }
    cells.push_back(cell);
  }
  return cells;
}

/// Whether a line comes near a cell at all.
bool IsNear(const Oracle::Cell& cell, const Line& line)
{
  using namespace vtkIsosurfaceRayTracing;
  Triple lower = cell.Points[0];
  Triple upper = cell.Points[0];
  for (const Triple& p : cell.Points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = std::min(lower[axis], p[axis]);
      upper[axis] = std::max(upper[axis], p[axis]);
    }
  }
  const Triple middle = (lower + upper) * 0.5;
  const double radius = Oracle::Length(upper - lower) * 0.5001;
  const Triple way = middle - line.Origin;
  const double t = Dot(way, line.Direction) / Dot(line.Direction, line.Direction);
  return Oracle::Length(way - line.Direction * t) <= radius;
}

/// Compares all hits of rays to the oracle's roots.
class MeshTally
{
public:
  explicit MeshTally(const std::string& name, int starts = 4)
    : Table(name)
    , Name(name)
    , Starts(starts)
  {
    this->Table.Expect({ RootSolver::Robust, Band, Accuracy, 0.0 });
    this->Table.CheckNormals(false);
  }

  void Check(const TestMesh& mesh, double isovalue, const std::vector<Line>& lines)
  {
    const std::vector<Oracle::Cell> cells = ToOracle(mesh);
    MeshField field(mesh.View(), 1);
    TraceRequest request;
    request.Surfaces = { { isovalue, Glass } };
    field.Select(request, {});
    std::vector<vtkIsosurfaceRayTracing::CastRay> rays;
    for (const Line& line : lines)
    {
      rays.push_back({ line.Origin, line.Direction, line.Begin, line.End });
    }
    const RayHits hits = CastRays(field, rays, 1);
    for (std::size_t i = 0; i < lines.size(); ++i)
    {
      this->CheckLine(cells, isovalue, lines[i],
        { hits.Hits.begin() + static_cast<std::ptrdiff_t>(hits.First[i]),
          hits.Hits.begin() + static_cast<std::ptrdiff_t>(hits.First[i + 1]) });
    }
  }

  void Report()
  {
    if (this->InBand > 0)
    {
      this->Table.Note(std::to_string(this->InBand) + " rays in the band");
    }
    this->Table.Report();
  }

private:
  void CheckLine(const std::vector<Oracle::Cell>& cells, double isovalue, const Line& line,
    const std::vector<Hit>& hits)
  {
    std::vector<Oracle::CellRoot> roots;
    for (std::size_t i = 0; i < cells.size(); ++i)
    {
      if (IsNear(cells[i], line))
      {
        const auto some =
          FindRoots(cells[i], static_cast<std::int64_t>(i), isovalue, line, this->Starts);
        roots.insert(roots.end(), some.begin(), some.end());
      }
    }
    std::sort(roots.begin(), roots.end(),
      [](const Oracle::CellRoot& a, const Oracle::CellRoot& b) { return a.T < b.T; });

    // Roots so near to a face that rounding decides in which cell they are, or so nearly tangent
    // that they may vanish.
    std::size_t certain = 0;
    std::size_t missed = 0;
    bool isInBand = false;
    const double length = Oracle::Length(line.Direction);
    for (const Oracle::CellRoot& root : roots)
    {
      const double size = Oracle::GetSize(cells[static_cast<std::size_t>(root.Cell)]);
      const double slack = std::max(Accuracy, Band / std::abs(root.Slope)) * size;
      const auto error = [&](const Hit& hit)
      { return std::abs(static_cast<double>(hit.T - root.T)) * length; };
      const auto best = std::min_element(hits.begin(), hits.end(),
        [&error](const Hit& a, const Hit& b) { return error(a) < error(b); });
      const bool isFound = best != hits.end() && error(*best) <= slack;
      const bool isUncertain = root.FromFace < Accuracy || std::abs(root.Slope) < 1e-6;
      isInBand = isInBand || isUncertain;
      certain += isUncertain ? 0 : 1;
      if (!isFound && !isUncertain)
      {
        ++missed;
        this->Print("miss", isovalue, line, static_cast<double>(root.T));
      }
      if (isFound && !isUncertain)
      {
        this->Table.AddError(error(*best) / size);
      }
    }
    std::size_t invented = 0;
    for (const Hit& hit : hits)
    {
      const Oracle::Residual residual = GetResidual(
        cells[static_cast<std::size_t>(hit.Cell)], isovalue, line, hit.T, hit.Parametric);
      const bool isGood = std::abs(residual.Value) <= 1e-9 && std::abs(residual.Beside) <= Accuracy;
      const auto near = std::count_if(roots.begin(), roots.end(),
        [&](const Oracle::CellRoot& root)
        {
          const double size = Oracle::GetSize(cells[static_cast<std::size_t>(root.Cell)]);
          const double slack = std::max(Accuracy, Band / std::abs(root.Slope)) * size;
          return std::abs(static_cast<double>(hit.T - root.T)) * length <= slack;
        });
      if (!isGood || (near == 0 && !isInBand))
      {
        ++invented;
        this->Print(isGood ? "invented" : "off the surface", isovalue, line, hit.T);
      }
    }
    if (!isInBand && missed == 0 && invented == 0 && hits.size() != roots.size())
    {
      ++invented;
      this->Print("number", isovalue, line, hits.empty() ? 0.0 : hits[0].T);
    }
    this->InBand += isInBand ? 1 : 0;
    this->Table.Count(1, hits.size(), missed, invented);
  }

  void Print(const char* what, double isovalue, const Line& line, double t)
  {
    if (++this->Printed <= 3)
    {
      std::printf("%s: %s: isovalue %a, origin %a %a %a, direction %a %a %a, near t %.17g\n",
        this->Name.c_str(), what, isovalue, line.Origin[0], line.Origin[1], line.Origin[2],
        line.Direction[0], line.Direction[1], line.Direction[2], t);
    }
  }

  Tally Table;
  std::string Name;
  int Starts;
  int Printed = 0;
  std::size_t InBand = 0;
};

const char* NameOf(Cutting cutting)
{
  constexpr const char* names[] = { "tetrahedra", "hexahedra", "wedges", "pyramids",
    "hexahedra and pyramids" };
  return names[static_cast<int>(cutting)];
}

}

TEST(TestMeshes, RandomValues)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(200);
    MeshTally tally(std::string("mesh of ") + NameOf(cutting) + ", random values");
    for (int i = 0; i < 5; ++i)
    {
      const TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      tally.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 5, 4, 4 }, 40));
    }
    tally.Report();
  }
}

namespace
{

/// Coordinates with few bits, so that lines can be aimed at points exactly.
void RoundPoints(TestMesh& mesh)
{
  for (double& coordinate : mesh.Points)
  {
    coordinate = std::ldexp(std::nearbyint(std::ldexp(coordinate, 8)), -8);
  }
}

/// A line that passes exactly through a point, an edge or a face of a cell.
Line AimAt(RandomNumbers& random, const TestMesh& mesh)
{
  const auto cell =
    static_cast<std::size_t>(random.Integer(0, static_cast<int>(mesh.Shapes.size()) - 1));
  const auto corners = static_cast<int>(mesh.Offsets[cell + 1] - mesh.Offsets[cell]);
  const auto corner = [&]
  {
    const std::int64_t at = mesh.Offsets[cell] + random.Integer(0, corners - 1);
    return mesh.GetPoint(mesh.Connectivity[static_cast<std::size_t>(at)]);
  };
  using namespace vtkIsosurfaceRayTracing;
  Vector3 target = corner();
  if (random.Integer(0, 1) == 0)
  {
    target = (target + corner()) * 0.5;
  }
  Vector3 direction = {};
  while (Dot(direction, direction) == 0.0)
  {
    direction = random.Integer(0, 2) == 0
      ? corner() - target
      : Vector3{ random.Integer(-8, 8) / 8.0, random.Integer(-8, 8) / 8.0,
          random.Integer(-8, 8) / 8.0 };
  }
  return { target - direction * 64.0, direction };
}

/// Counts rays whose hits are not even in number, and rays that do not enter and leave in turn.
struct ParityCount
{
  std::size_t Rays = 0;
  std::size_t Hits = 0;
  std::size_t Cracks = 0;
  std::size_t Disorder = 0;

  void Check(RandomNumbers& random, Cutting cutting, double jitter, bool hasWholeValues)
  {
    constexpr int size = 5;
    TestMesh mesh = MakeMesh(random, { size, size, size }, cutting, jitter,
      [&random, hasWholeValues](const vtkIsosurfaceRayTracing::Index3& p)
      {
        const bool isBorder =
          std::any_of(p.begin(), p.end(), [](int coordinate) { return coordinate % size == 0; });
        const double value =
          hasWholeValues ? random.Integer(-1, 1) + 0.0 : random.Uniform(-1.0, 1.0);
        return isBorder ? -1.0 : value;
      });
    RoundPoints(mesh);
    MeshField field(mesh.View(), 1);
    TraceRequest request;
    request.Surfaces = { { 0.0, Glass } };
    field.Select(request, {});
    std::vector<vtkIsosurfaceRayTracing::CastRay> rays;
    for (int ray = 0; ray < 500; ++ray)
    {
      const Line line = AimAt(random, mesh);
      rays.push_back({ line.Origin, line.Direction, line.Begin, line.End });
    }
    const RayHits hits = CastRays(field, rays, 1);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      bool isInside = false;
      bool isOrdered = true;
      for (std::size_t k = hits.First[ray]; k < hits.First[ray + 1]; ++k)
      {
        isOrdered = isOrdered && hits.Hits[k].Entering != isInside;
        isInside = hits.Hits[k].Entering;
      }
      this->Cracks += (hits.First[ray + 1] - hits.First[ray]) % 2;
      this->Disorder += isOrdered ? 0 : 1;
    }
    this->Rays += rays.size();
    this->Hits += hits.Hits.size();
  }
};

}

TEST(TestMeshes, RaysThroughPointsEdgesAndFaces)
{
  // Inside in the middle, outside at the border: a ray has an even number of hits, and enters
  // first. Where faces are twisted, a ray along an edge may be in two cells at once, and enter
  // twice.
  for (const double jitter : { 0.0, 0.2 })
  {
    for (const Cutting cutting : AllCuttings)
    {
      RandomNumbers random(201);
      ParityCount count;
      for (int i = 0; i < 40; ++i)
      {
        count.Check(random, cutting, jitter, i % 2 == 0);
      }
      const bool isTwisted = jitter > 0.0 && cutting != Cutting::Tetrahedra;
      Tally tally(std::string("mesh of ") + NameOf(cutting) + (isTwisted ? ", twisted" : "") +
        ", rays through points, edges and faces, parity");
      tally.Count(count.Rays, count.Hits, count.Cracks, isTwisted ? 0 : count.Disorder);
      if (isTwisted)
      {
        tally.Note(std::to_string(count.Disorder) + " rays enter twice along an edge");
        EXPECT_LT(count.Disorder * 200, count.Rays);
      }
      tally.Report();
    }
  }
}
