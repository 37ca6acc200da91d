// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Meshes against the oracle, which looks at every cell by itself.

#include "ExactMesh.h"
#include "Kernels/InstructionSets.h"
#include "Mesh/MeshField.h"
#include "Picture/CastRays.h"
#include "Tally.h"
#include "TestMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <memory>
#include <sstream>
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

/// All hits of rays with an isosurface of a mesh.
RayHits TraceAll(const TestMesh& mesh, double isovalue, const std::vector<Line>& lines)
{
  MeshField field(mesh.View(), 1);
  field.Select(TraceRequest({ { isovalue, Glass } }), {});
  return CastRays(field, ToCastRays(lines), 1);
}

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

/// Whether a line comes near a cell at all, and the cell is finite.
bool IsNear(const Oracle::Cell& cell, const Line& line)
{
  using namespace vtkIsosurfaceRayTracing;
  const auto isFinite = [](const Triple& p) { return std::isfinite(p[0] + p[1] + p[2]); };
  if (!std::all_of(cell.Points.begin(), cell.Points.end(), isFinite) ||
    !std::all_of(cell.Values.begin(), cell.Values.end(), [](double v) { return std::isfinite(v); }))
  {
    return false;
  }
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

/// How far rounding may move positions near a point of a line, in sizes of the cell.
double GetRoundingOfPositions(const Oracle::Cell& cell, const Line& line, double t)
{
  const double reach = std::abs(t) * Oracle::Length(line.Direction);
  return 0x1p-50 * (1.0 + (Oracle::GetLargestCoordinate(cell) + reach) / Oracle::GetSize(cell));
}

/// What rounding may do to a root.
struct Uncertainty
{
  Uncertainty(const Oracle::Cell& cell, const Oracle::CellRoot& root, const Line& line)
    : Size(Oracle::GetSize(cell))
  {
    const double position = GetRoundingOfPositions(cell, line, static_cast<double>(root.T));
    const double error = (Band + root.Steepness * position) / std::abs(root.Slope);
    this->AlongLine = std::max(Accuracy, error) * this->Size;
    this->MayVanish = root.FromFace < std::max(Accuracy, root.Stretch * position) || error > 1e-6;
  }

  double Size;
  double AlongLine;
  /// So near to a face that rounding decides in which cell it is, or so nearly tangent.
  bool MayVanish;
};

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
    const RayHits hits = TraceAll(mesh, isovalue, lines);
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
    if (this->IllConditioned > 0.0)
    {
      std::ostringstream note;
      note << "errors up to " << std::setprecision(2) << this->IllConditioned
           << " where positions are rounded so";
      this->Table.Note(note.str());
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

    std::size_t missed = 0;
    bool isInBand = false;
    const double length = Oracle::Length(line.Direction);
    for (const Oracle::CellRoot& root : roots)
    {
      const Uncertainty uncertainty(cells[static_cast<std::size_t>(root.Cell)], root, line);
      const double size = uncertainty.Size;
      const double slack = uncertainty.AlongLine;
      const auto error = [&](const Hit& hit)
      { return std::abs(static_cast<double>(hit.T - root.T)) * length; };
      const auto best = std::min_element(hits.begin(), hits.end(),
        [&error](const Hit& a, const Hit& b) { return error(a) < error(b); });
      const bool isFound = best != hits.end() && error(*best) <= slack;
      const bool isUncertain = uncertainty.MayVanish;
      isInBand = isInBand || isUncertain;
      if (!isFound && !isUncertain)
      {
        ++missed;
        this->Print("miss", isovalue, line, static_cast<double>(root.T));
      }
      if (isFound && !isUncertain && slack <= Accuracy * size)
      {
        this->Table.AddError(error(*best) / size);
      }
      else if (isFound && !isUncertain)
      {
        this->IllConditioned = std::max(this->IllConditioned, error(*best) / size);
      }
    }
    std::size_t invented = 0;
    for (const Hit& hit : hits)
    {
      const Oracle::Residual residual = GetResidual(
        cells[static_cast<std::size_t>(hit.Cell)], isovalue, line, hit.T, hit.Parametric);
      const double beside = std::max(
        Accuracy, GetRoundingOfPositions(cells[static_cast<std::size_t>(hit.Cell)], line, hit.T));
      const bool isGood = std::abs(residual.Value) <= 1e-9 && std::abs(residual.Beside) <= beside;
      const auto near = std::count_if(roots.begin(), roots.end(),
        [&](const Oracle::CellRoot& root)
        {
          const Uncertainty uncertainty(cells[static_cast<std::size_t>(root.Cell)], root, line);
          return std::abs(static_cast<double>(hit.T - root.T)) * length <= uncertainty.AlongLine;
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
  /// The largest error of a hit that rounding of positions alone moves by more than the accuracy.
  double IllConditioned = 0.0;
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

constexpr int EdgeOfClosed = 5;

/// A mesh of random values, outside of the surface at its border.
TestMesh MakeClosed(RandomNumbers& random, Cutting cutting, double jitter, bool hasWholeValues)
{
  TestMesh mesh = MakeMesh(random, { EdgeOfClosed, EdgeOfClosed, EdgeOfClosed }, cutting, jitter,
    [&random, hasWholeValues](const vtkIsosurfaceRayTracing::Index3& p)
    {
      const bool isBorder = std::any_of(
        p.begin(), p.end(), [](int coordinate) { return coordinate % EdgeOfClosed == 0; });
      const double value = hasWholeValues ? random.Integer(-1, 1) + 0.0 : random.Uniform(-1.0, 1.0);
      return isBorder ? -1.0 : value;
    });
  RoundPoints(mesh);
  return mesh;
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
    const TestMesh mesh = MakeClosed(random, cutting, jitter, hasWholeValues);
    std::vector<Line> lines;
    for (int ray = 0; ray < 500; ++ray)
    {
      lines.push_back(AimAt(random, mesh));
    }
    this->Count(TraceAll(mesh, 0.0, lines));
  }

  void Count(const RayHits& hits)
  {
    const std::size_t rays = hits.First.size() - 1;
    for (std::size_t ray = 0; ray < rays; ++ray)
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
    this->Rays += rays;
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
        EXPECT_LT(count.Disorder * 100, count.Rays);
      }
      tally.Report();
    }
  }
}

namespace
{

/// Rays from a point with few bits before a closed mesh through its points, its edges and its
/// faces, exactly, traced in beams.
class AimedBeams
{
public:
  AimedBeams(RandomNumbers& random, const TestMesh& mesh)
    : Random(random)
    , Mesh(mesh)
    , Field(mesh.View(), 1)
    , FieldOfRays(mesh.View(), 1)
  {
    this->Field.Select(
      TraceRequest({ { 0.0, Glass } }), { 1, &vtkIsosurfaceRayTracing::GetBestKernels() });
    this->Beam = this->Field.MakeBeam();
    this->FieldOfRays.Select(TraceRequest({ { 0.0, Glass } }), {});
  }

  /// Begins with rays from another point.
  void Move()
  {
    using namespace vtkIsosurfaceRayTracing;
    this->Along = static_cast<std::size_t>(this->Random.Integer(0, 2));
    for (double& coordinate : this->Origin)
    {
      coordinate = this->Random.Integer(-8, 8 * (EdgeOfClosed + 1)) / 8.0;
    }
    const bool isUp = this->Random.Integer(0, 1) == 0;
    const double far = this->Random.Integer(2, 40);
    this->Origin[this->Along] = isUp ? -far : EdgeOfClosed + far;
    // Before the mesh all rays are in the rectangle around the origin and the nearest face.
    this->Packet.Clear();
    for (const int corner : { 0, 1, 2, 3 })
    {
      Triple direction = this->Origin * -1.0;
      direction[this->Along] += isUp ? -0.5 : EdgeOfClosed + 0.5;
      for (const std::size_t k : { 0U, 1U })
      {
        direction[(this->Along + 1 + k) % 3] += (corner >> k & 1) == 0 ? -1.5 : EdgeOfClosed + 1.5;
      }
      this->AddLine(direction);
    }
    this->Field.Begin(this->Packet, this->Beam.get());
  }

  /// Traces a packet.
  const RayHits& Trace()
  {
    using namespace vtkIsosurfaceRayTracing;
    this->Packet.Clear();
    for (int ray = 0; ray < RayPacket::Capacity; ++ray)
    {
      this->Field.AddRay(this->Origin, this->FindTarget() - this->Origin, 0.0,
        std::numeric_limits<double>::infinity(), this->Packet);
    }
    this->Field.Trace(this->Packet, this->Hits, this->Beam.get());
    return this->Hits;
  }

  /// Whether the rays of the packet have the hits that they have by themselves.
  bool AreAsAlone()
  {
    RayHits alone;
    this->FieldOfRays.Trace(this->Packet, alone);
    return IsSame(alone, this->Hits);
  }

private:
  void AddLine(const Triple& direction)
  {
    const int line = this->Packet.Count++;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->Packet.Origin[axis][line] = this->Origin[axis];
      this->Packet.Direction[axis][line] = direction[axis];
    }
  }

  /// A corner of a cell, or a point with the same number of bits on an edge or a face.
  Triple FindTarget()
  {
    using namespace vtkIsosurfaceRayTracing;
    const auto cell = static_cast<std::size_t>(
      this->Random.Integer(0, static_cast<int>(this->Mesh.Shapes.size()) - 1));
    const auto corners = static_cast<int>(this->Mesh.Offsets[cell + 1] - this->Mesh.Offsets[cell]);
    const auto corner = [&]
    {
      const std::int64_t at = this->Mesh.Offsets[cell] + this->Random.Integer(0, corners - 1);
      return this->Mesh.GetPoint(this->Mesh.Connectivity[static_cast<std::size_t>(at)]);
    };
    const Triple first = corner();
    switch (this->Random.Integer(0, 3))
    {
      case 0:
        return (first + corner()) * 0.5;
      case 1:
        return first * 0.5 + (corner() + corner()) * 0.25;
      default:
        return first;
    }
  }

  RandomNumbers& Random;
  const TestMesh& Mesh;
  MeshField Field;
  std::unique_ptr<MeshField::Beam> Beam;
  /// The same, without beams.
  MeshField FieldOfRays;
  std::size_t Along = 0;
  Triple Origin = {};
  vtkIsosurfaceRayTracing::RayPacket Packet;
  RayHits Hits;
};

}

// ATTACK_RAYS says how many rays there are for each kind of cells (100 000), ATTACK_SEED with which
// seed they are drawn.
TEST(TestMeshes, BeamsThroughPointsEdgesAndFaces)
{
  const std::uint64_t rays = GetNumber("ATTACK_RAYS", 100000);
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(GetNumber("ATTACK_SEED", 202));
    ParityCount count;
    while (count.Rays < rays)
    {
      const TestMesh mesh =
        MakeClosed(random, cutting, 0.05 * random.Integer(0, 4), random.Integer(0, 1) == 0);
      AimedBeams beams(random, mesh);
      for (int i = 0; i < 200 && count.Rays < rays; ++i)
      {
        if (i % 20 == 0)
        {
          beams.Move();
        }
        count.Count(beams.Trace());
        EXPECT_TRUE(i % 20 != 0 || beams.AreAsAlone());
      }
    }
    Tally tally(std::string("mesh of ") + NameOf(cutting) + ", beams through points, edges and " +
      "faces, parity");
    tally.Count(
      count.Rays, count.Hits, count.Cracks, cutting == Cutting::Tetrahedra ? count.Disorder : 0);
    tally.Report();
  }
}

namespace
{

/// Moves all points of a mesh.
template <typename Function>
TestMesh Map(TestMesh mesh, const Function& function)
{
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    const Triple moved = function(Triple{ mesh.Points[i], mesh.Points[i + 1], mesh.Points[i + 2] });
    std::copy(moved.begin(), moved.end(), &mesh.Points[i]);
  }
  return mesh;
}

/// Lines through the images of two points of a box, from outside of it.
template <typename Function>
std::vector<Line> MapLines(
  RandomNumbers& random, const Triple& upper, std::size_t count, const Function& function)
{
  using namespace vtkIsosurfaceRayTracing;
  std::vector<Line> lines;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Triple a = function(random.PointInBox({ 0.0, 0.0, 0.0 }, upper));
    const Triple b = function(random.PointInBox({ 0.0, 0.0, 0.0 }, upper));
    lines.push_back({ a - (b - a) * 3.0, b - a });
  }
  return lines;
}

/// Meshes of every kind of cells with random values, whose points are moved by a function.
template <typename Function>
void CheckMapped(const std::string& name, std::uint64_t seed, const Function& function,
  double jitter = 0.2, int meshes = 2, int lines = 20)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(seed);
    MeshTally tally(std::string("mesh of ") + NameOf(cutting) + ", " + name);
    for (int i = 0; i < meshes; ++i)
    {
      const TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, jitter,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      tally.Check(Map(mesh, function), random.Uniform(-0.3, 0.3),
        MapLines(random, { 4.0, 3.0, 3.0 }, lines, function));
    }
    tally.Report();
  }
}

}

TEST(TestMeshes, StretchedCells)
{
  for (const double stretch : { 1e3, 1e6 })
  {
    const std::string name = "stretched " + std::to_string(static_cast<int>(stretch)) + " : 1";
    CheckMapped(name + " along an axis", 202,
      [stretch](const Triple& p) {
        return Triple{ p[0], p[1], p[2] / stretch };
      });
    CheckMapped(name + " aslant", 203,
      [stretch](const Triple& p)
      {
        const double along = p[0] + p[1] + p[2];
        return Triple{ p[0] / stretch + 0.3 * along, p[1] / stretch + 0.5 * along,
          p[2] / stretch + 0.7 * along };
      });
  }
}

TEST(TestMeshes, CellsOfManySizes)
{
  // Along each axis cells of 1e-6 are beside cells of 1.
  const auto shrink = [](double x) { return x < 2.0 ? 1e-6 * x : 2e-6 + (x - 2.0); };
  const auto function = [&shrink](const Triple& p) {
    return Triple{ shrink(p[0]), shrink(p[1]), shrink(p[2]) };
  };
  CheckMapped("sizes 1e6 : 1", 204, function);
}

TEST(TestMeshes, FarAndSmall)
{
  CheckMapped("at 1e7", 205,
    [](const Triple& p) {
      return Triple{ p[0] + 1e7, p[1] - 1e7, p[2] + 3e7 };
    });
  CheckMapped("1e-7 large", 206,
    [](const Triple& p) {
      return Triple{ p[0] * 1e-7, p[1] * 1e-7, p[2] * 1e-7 };
    });
  CheckMapped("1e7 large", 207,
    [](const Triple& p) {
      return Triple{ p[0] * 1e7, p[1] * 1e7, p[2] * 1e7 };
    });
}

TEST(TestMeshes, TwistedCells)
{
  for (const double jitter : { 0.45, 0.8 })
  {
    for (const Cutting cutting : AllCuttings)
    {
      RandomNumbers random(208);
      std::ostringstream name;
      name << "mesh of " << NameOf(cutting) << ", points moved by " << jitter;
      MeshTally tally(name.str(), 8);
      for (int i = 0; i < 3; ++i)
      {
        const TestMesh mesh = MakeMesh(random, { 3, 3, 2 }, cutting, jitter,
          [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
        tally.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 4, 4, 3 }, 15));
      }
      tally.Report();
    }
  }
}

namespace
{

/// Replaces the corners of a cell by others: corner i by that which was the order's i-th.
void Permute(TestMesh& mesh, std::size_t cell, const std::vector<std::int64_t>& order)
{
  const auto first = mesh.Connectivity.begin() + mesh.Offsets[cell];
  const std::vector<std::int64_t> before(first, mesh.Connectivity.begin() + mesh.Offsets[cell + 1]);
  std::transform(order.begin(), order.end(), first,
    [&before](std::int64_t corner) { return before[static_cast<std::size_t>(corner)]; });
}

}

TEST(TestMeshes, InvertedCells)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(209);
    MeshTally tally(std::string("mesh of ") + NameOf(cutting) + ", half of them inverted");
    for (int i = 0; i < 5; ++i)
    {
      TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      for (std::size_t cell = 0; cell < mesh.Shapes.size(); cell += 2)
      {
        switch (mesh.Offsets[cell + 1] - mesh.Offsets[cell])
        {
          case 4:
            Permute(mesh, cell, { 0, 2, 1, 3 });
            break;
          case 5:
            Permute(mesh, cell, { 0, 3, 2, 1, 4 });
            break;
          case 6:
            Permute(mesh, cell, { 3, 4, 5, 0, 1, 2 });
            break;
          default:
            Permute(mesh, cell, { 4, 5, 6, 7, 0, 1, 2, 3 });
        }
      }
      tally.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 5, 4, 4 }, 40));
    }
    tally.Report();
  }
}

TEST(TestMeshes, PinchedCells)
{
  // Corners of hexahedra that are one point: edges, faces (a wedge, a pyramid), a diagonal.
  struct Pinch
  {
    const char* Name;
    std::vector<std::int64_t> Corners;
  };
  const Pinch pinches[] = { { "an edge", { 0, 0, 2, 3, 4, 5, 6, 7 } },
    { "two edges of a face", { 0, 1, 1, 0, 4, 5, 6, 7 } },
    { "two edges of opposite faces", { 0, 1, 2, 2, 4, 5, 6, 6 } },
    { "a face", { 0, 1, 2, 3, 4, 4, 4, 4 } }, { "an edge and a face", { 0, 1, 2, 2, 4, 4, 4, 4 } },
    { "a diagonal of a face", { 0, 1, 0, 3, 4, 5, 6, 7 } },
    { "opposite faces", { 0, 1, 2, 3, 0, 1, 2, 3 } },
    { "all corners", { 0, 0, 0, 0, 0, 0, 0, 0 } } };
  for (const Pinch& pinch : pinches)
  {
    RandomNumbers random(210);
    MeshTally tally(std::string("mesh of hexahedra pinched at ") + pinch.Name, 5);
    for (int i = 0; i < 3; ++i)
    {
      TestMesh mesh = MakeMesh(random, { 3, 3, 3 }, Cutting::Hexahedra, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      for (std::size_t cell = 0; cell < mesh.Shapes.size(); ++cell)
      {
        Permute(mesh, cell, pinch.Corners);
      }
      tally.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 4, 4, 4 }, 30));
    }
    tally.Report();
  }
}

TEST(TestMeshes, FlatCells)
{
  // Every third layer of points lies on the one below: cells without a volume between others.
  const auto function = [](const Triple& p) {
    return Triple{ p[0], p[1], p[2] < 1.5 ? std::min(p[2], 1.0) : p[2] - 1.0 };
  };
  CheckMapped("a layer of them flat", 211, function, 0.0, 5, 40);
}

TEST(TestMeshes, NumbersThatAreNotFinite)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(212);
    MeshTally tally(
      std::string("mesh of ") + NameOf(cutting) + ", NaN and infinite values and coordinates");
    for (int i = 0; i < 5; ++i)
    {
      TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      const int last = static_cast<int>(mesh.Values.size()) - 1;
      for (const double bad : { nan, infinity, -infinity })
      {
        mesh.Values[static_cast<std::size_t>(random.Integer(0, last))] = bad;
        mesh.Points[static_cast<std::size_t>(3 * random.Integer(0, last) + random.Integer(0, 2))] =
          bad;
      }
      tally.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 5, 4, 4 }, 40));
    }
    tally.Report();
  }
}

namespace
{

/// Adds the cells of another mesh, with points of their own.
void Append(TestMesh& mesh, const TestMesh& other)
{
  const auto first = static_cast<std::int64_t>(mesh.Values.size());
  mesh.Points.insert(mesh.Points.end(), other.Points.begin(), other.Points.end());
  mesh.Values.insert(mesh.Values.end(), other.Values.begin(), other.Values.end());
  mesh.Shapes.insert(mesh.Shapes.end(), other.Shapes.begin(), other.Shapes.end());
  const std::int64_t offset = mesh.Offsets.back();
  for (std::size_t cell = 1; cell < other.Offsets.size(); ++cell)
  {
    mesh.Offsets.push_back(offset + other.Offsets[cell]);
  }
  for (const std::int64_t id : other.Connectivity)
  {
    mesh.Connectivity.push_back(first + id);
  }
}

}

TEST(TestMeshes, OverlapsAndHangingNodes)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(213);
    const auto value = [&random](const Index&) { return random.Uniform(-1.0, 1.0); };
    MeshTally overlaps(std::string("mesh of ") + NameOf(cutting) + ", overlapping another");
    MeshTally nodes(std::string("mesh of ") + NameOf(cutting) + ", beside one half as fine");
    for (int i = 0; i < 3; ++i)
    {
      const TestMesh fine = Map(MakeMesh(random, { 4, 4, 4 }, cutting, 0.1, value),
        [](const Triple& p) {
          return Triple{ 0.5 * p[0], 0.5 * p[1], 0.5 * p[2] };
        });
      TestMesh mesh = MakeMesh(random, { 3, 3, 3 }, cutting, 0.1, value);
      Append(mesh, fine);
      overlaps.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 4, 4, 4 }, 30));
      mesh = MakeMesh(random, { 2, 2, 2 }, cutting, 0.0, value);
      Append(mesh, Map(fine, [](const Triple& p) { return Triple{ p[0] + 2.0, p[1], p[2] }; }));
      nodes.Check(mesh, random.Uniform(-0.3, 0.3), RandomLines(random, { 5, 3, 3 }, 30));
    }
    overlaps.Report();
    nodes.Report();
  }
}

TEST(TestMeshes, RaysFromInside)
{
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(214);
    MeshTally tally(std::string("mesh of ") + NameOf(cutting) + ", rays that begin and end inside");
    for (int i = 0; i < 5; ++i)
    {
      const TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      std::vector<Line> lines;
      for (int k = 0; k < 60; ++k)
      {
        const double begin = random.Uniform(-2.0, 2.0);
        lines.push_back({ random.PointInBox({ 0.0, 0.0, 0.0 }, { 4.0, 3.0, 3.0 }),
          random.Direction(), begin, begin + random.Uniform(0.0, 3.0) });
      }
      tally.Check(mesh, random.Uniform(-0.3, 0.3), lines);
    }
    tally.Report();
  }
}

TEST(TestMeshes, LargeAndSmallValues)
{
  struct Case
  {
    const char* Name;
    double Offset;
    double Factor;
  };
  for (const Case& values : { Case{ "values 1e15 + eighths", 1e15, 1.0 },
         Case{ "values about 1e-300", 0.0, 1e-300 }, Case{ "values about 1e300", 0.0, 1e300 },
         Case{ "values of either sign about 1e307", 0.0, 4e307 } })
  {
    for (const Cutting cutting : AllCuttings)
    {
      RandomNumbers random(215);
      MeshTally tally(std::string("mesh of ") + NameOf(cutting) + ", " + values.Name);
      for (int i = 0; i < 3; ++i)
      {
        const TestMesh mesh = MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
          [&](const Index&)
          { return values.Offset + random.Integer(-8, 8) / 8.0 * values.Factor; });
        tally.Check(
          mesh, values.Offset + 0.1875 * values.Factor, RandomLines(random, { 5, 4, 4 }, 30));
      }
      tally.Report();
    }
  }
}

TEST(TestMeshes, AnyScale)
{
  // Space multiplied by a power of two changes no bit of the hits.
  for (const int exponent : { -700, -300, 300, 660, 1000 })
  {
    for (const Cutting cutting : AllCuttings)
    {
      RandomNumbers random(216);
      const auto scale = [exponent](const Triple& p)
      {
        return Triple{ std::ldexp(p[0], exponent), std::ldexp(p[1], exponent),
          std::ldexp(p[2], exponent) };
      };
      // Around the origin: boxes may be too large for single precision on both sides.
      const auto move = [](const Triple& p) {
        return Triple{ p[0] - 2.5, p[1] - 2.0, p[2] - 2.0 };
      };
      const TestMesh mesh = Map(MakeMesh(random, { 4, 3, 3 }, cutting, 0.2,
                                  [&random](const Index&) { return random.Uniform(-1.0, 1.0); }),
        move);
      std::vector<Line> lines = RandomLines(random, { 5, 4, 4 }, 200);
      for (Line& line : lines)
      {
        line.Origin = move(line.Origin);
      }
      std::vector<Line> scaled = lines;
      for (Line& line : scaled)
      {
        line = { scale(line.Origin), scale(line.Direction) };
      }
      const RayHits expected = TraceAll(mesh, 0.1, lines);
      const RayHits found = TraceAll(Map(mesh, scale), 0.1, scaled);
      EXPECT_GT(expected.Hits.size(), 100U);
      EXPECT_TRUE(IsSame(expected, found)) << NameOf(cutting) << " 2^" << exponent;
    }
  }
}

TEST(TestMeshes, Plateaus)
{
  // Values equal to the isovalue are inside, of whole cells too: hits are those with the values
  // just above it, but for pairs where a ray passes what has no thickness.
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(217);
    std::size_t hits = 0;
    std::size_t wrong = 0;
    for (int i = 0; i < 5; ++i)
    {
      const TestMesh mesh = MakeMesh(random, { 5, 4, 4 }, cutting, 0.2,
        [&random](const Index&) { return std::max(random.Integer(-3, 1), -1) + 0.0; });
      const std::vector<Line> lines = RandomLines(random, { 6, 5, 5 }, 200);
      const RayHits exact = TraceAll(mesh, 0.0, lines);
      const RayHits below = TraceAll(mesh, -1e-9, lines);
      for (std::size_t ray = 0; ray < lines.size(); ++ray)
      {
        std::vector<double> ts[2];
        for (const RayHits* some : { &exact, &below })
        {
          std::vector<double>& t = some == &exact ? ts[0] : ts[1];
          for (std::size_t k = some->First[ray]; k < some->First[ray + 1]; ++k)
          {
            const double next = some->Hits[k].T;
            if (!t.empty() && next - t.back() < 1e-4)
            {
              t.pop_back();
              continue;
            }
            t.push_back(next);
          }
        }
        const bool isSame = std::equal(ts[0].begin(), ts[0].end(), ts[1].begin(), ts[1].end(),
          [](double a, double b) { return std::abs(a - b) < 1e-4; });
        wrong += isSame ? 0 : 1;
      }
      hits += exact.Hits.size();
    }
    Tally tally(std::string("mesh of ") + NameOf(cutting) + ", whole cells at the isovalue");
    tally.Count(1000, hits, 0, wrong);
    tally.Report();
  }
}

TEST(TestMeshes, DuplicatedPoints)
{
  // Each cell has points of its own: what faces share is known by their coordinates alone.
  for (const Cutting cutting : AllCuttings)
  {
    RandomNumbers random(218);
    std::size_t hits = 0;
    std::size_t lost = 0;
    for (int i = 0; i < 10; ++i)
    {
      const TestMesh mesh = MakeMesh(random, { 4, 4, 4 }, cutting, 0.2,
        [&random](const Index&) { return random.Uniform(-1.0, 1.0); });
      TestMesh torn;
      for (std::size_t cell = 0; cell < mesh.Shapes.size(); ++cell)
      {
        torn.Shapes.push_back(mesh.Shapes[cell]);
        for (std::int64_t k = mesh.Offsets[cell]; k < mesh.Offsets[cell + 1]; ++k)
        {
          const std::int64_t id = mesh.Connectivity[static_cast<std::size_t>(k)];
          torn.Connectivity.push_back(
            torn.AddPoint(mesh.GetPoint(id), mesh.Values[static_cast<std::size_t>(id)]));
        }
        torn.Offsets.push_back(static_cast<std::int64_t>(torn.Connectivity.size()));
      }
      const std::vector<Line> lines = RandomLines(random, { 5, 5, 5 }, 1000);
      const RayHits expected = TraceAll(mesh, 0.1, lines);
      const RayHits found = TraceAll(torn, 0.1, lines);
      for (std::size_t ray = 0; ray < lines.size(); ++ray)
      {
        const std::size_t before = expected.First[ray + 1] - expected.First[ray];
        const std::size_t after = found.First[ray + 1] - found.First[ray];
        lost += before == after ? 0 : 1;
      }
      hits += found.Hits.size();
    }
    Tally tally(std::string("mesh of ") + NameOf(cutting) + ", each with points of its own");
    tally.Count(10000, hits, lost, 0);
    tally.Report();
  }
}
