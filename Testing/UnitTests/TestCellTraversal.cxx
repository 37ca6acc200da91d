// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells that a ray visits are compared with those found in two slow ways: by sorting all
// crossings of all lattice planes, and by testing every cell of the volume.

#include "Image/Cells/CellSegment.h"
#include "Image/Traversal/CellTraversal.h"
#include "Math/Arithmetic.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

std::string ToText(const Ray& ray)
{
  std::ostringstream text;
  text.precision(17);
  for (std::size_t i = 0; i < 3; ++i)
  {
    text << ray.Origin[i] << " + t * " << ray.Direction[i] << "; ";
  }
  text << "t from " << ray.Begin << " to " << ray.End;
  return text.str();
}

/// The cells of a ray, from the sorted crossings of all planes.
std::vector<Index3> FindCellsBySorting(const Ray& ray, const Index3& dimensions)
{
  std::vector<std::tuple<double, int>> later;
  Index3 cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int step = ray.Step[axis];
    if (step == 0)
    {
      cell[axis] = std::min(static_cast<int>(std::floor(ray.Origin[axis])), dimensions[axis] - 2);
      continue;
    }
    int crossed = 0;
    for (int k = 0; k < dimensions[axis]; ++k)
    {
      const double t = (k - ray.Origin[axis]) * ray.Inverse[axis];
      crossed += t <= ray.Begin ? 1 : 0;
      if (t > ray.Begin && t < ray.End)
      {
        later.emplace_back(t, static_cast<int>(axis));
      }
    }
    // Before its first plane a ray is outside the volume by a rounding at most, and so behind its
    // last.
    crossed = std::clamp(crossed, 1, dimensions[axis] - 1);
    cell[axis] = step > 0 ? crossed - 1 : dimensions[axis] - 1 - crossed;
  }
  std::sort(later.begin(), later.end());
  std::vector<Index3> cells(1, cell);
  for (const auto& crossing : later)
  {
    const auto axis = static_cast<std::size_t>(std::get<1>(crossing));
    cell[axis] += ray.Step[axis];
    if (cell[axis] < 0 || cell[axis] > dimensions[axis] - 2)
    {
      break;
    }
    cells.push_back(cell);
  }
  return cells;
}

/// The cells of a ray, by testing each of the volume. Along an axis the ray is parallel to, only
/// those at the floor of the origin are tested.
std::set<Index3> FindCellsBySegments(const Ray& ray, const Index3& dimensions)
{
  std::set<Index3> cells;
  ForEachPlace({ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 },
    [&](const Index3& cell)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const int floor =
          std::min(static_cast<int>(std::floor(ray.Origin[axis])), dimensions[axis] - 2);
        if (ray.Step[axis] == 0 && cell[axis] != floor)
        {
          return;
        }
      }
      CellSegment segment;
      if (SegmentInCell(ray, cell, segment))
      {
        cells.insert(cell);
      }
    });
  return cells;
}

ActiveMacrocells MakeActive(const Index3& dimensions, const std::vector<int>& branching,
  const std::function<bool(std::size_t, std::size_t)>& isActive)
{
  ActiveMacrocells active(MacrocellLattice(dimensions, branching));
  for (std::size_t level = 0; level < branching.size(); ++level)
  {
    active.Fill(level, 1, [&](std::size_t i) { return isActive(level, i); });
  }
  return active;
}

ActiveMacrocells MakeAllActive(const Index3& dimensions, const std::vector<int>& branching)
{
  return MakeActive(dimensions, branching, [](std::size_t, std::size_t) { return true; });
}

std::vector<Index3> Traverse(const Ray& ray, const ActiveMacrocells& active)
{
  std::vector<Index3> cells;
  TraverseCells(ray, active,
    [&cells](const Index3& cell)
    {
      cells.push_back(cell);
      return cells.size() > 100000; // an endless traversal stops here, and fails
    });
  return cells;
}

/// The rest of the sequence when the cells in inactive macrocells are removed.
std::vector<Index3> Filter(const std::vector<Index3>& cells, const ActiveMacrocells& active)
{
  std::vector<Index3> kept;
  for (const Index3& cell : cells)
  {
    bool keep = true;
    const auto& levels = active.GetLattice().Levels;
    Index3 block = cell;
    for (std::size_t level = 0; level < levels.size(); ++level)
    {
      for (int& coordinate : block)
      {
        coordinate /= levels[level].Branching;
      }
      keep = keep && active.IsActive(level, block);
    }
    if (keep)
    {
      kept.push_back(cell);
    }
  }
  return kept;
}

void ExpectNeighboursShareFaces(const std::vector<Index3>& cells)
{
  for (std::size_t i = 1; i < cells.size(); ++i)
  {
    int distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      distance += std::abs(cells[i][axis] - cells[i - 1][axis]);
    }
    ASSERT_EQ(distance, 1);
  }
}

/// The segments of the cells must make up the whole ray, their ends must lie on it, and the exit of
/// one must be the entry of the next.
void ExpectSegmentsChain(const Ray& ray, const std::vector<Index3>& cells)
{
  double t = ray.Begin;
  Vector3 exit = {};
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    CellSegment segment;
    ASSERT_TRUE(SegmentInCell(ray, cells[i], segment));
    ASSERT_EQ(segment.Begin, t);
    ASSERT_LE(segment.Begin, segment.End);
    t = segment.End;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int k = cells[i][axis];
      const double scale = 1e-14 * (1.0 + std::abs(ray.Origin[axis]) + k);
      ASSERT_NEAR(k + segment.Entry[axis], ray.Coordinate(axis, segment.Begin), scale);
      ASSERT_NEAR(k + segment.Exit[axis], ray.Coordinate(axis, segment.End), scale);
      ASSERT_TRUE(segment.Entry[axis] >= 0.0 && segment.Entry[axis] <= 1.0);
      ASSERT_TRUE(segment.Exit[axis] >= 0.0 && segment.Exit[axis] <= 1.0);
      if (i > 0)
      {
        // The same to the last bit: 1 in one cell is 0 in the next.
        const int step = k - cells[i - 1][axis];
        ASSERT_EQ(segment.Entry[axis], step == 0 ? exit[axis] : exit[axis] - step);
      }
    }
    exit = segment.Exit;
  }
  ASSERT_EQ(t, ray.End);
}

/// Checks for all rays, with counts of what was tried.
class RayChecks
{
public:
  explicit RayChecks(const Index3& dimensions)
    : Dimensions(dimensions)
    , Plain(MakeAllActive(dimensions, {}))
  {
    for (const std::vector<int>& branching :
      { std::vector<int>{ 8, 8 }, { 2, 3, 5 }, { 64 }, { 1 }, { 3, 1, 2 } })
    {
      this->AllActive.push_back(MakeAllActive(dimensions, branching));
      RandomNumbers random(31 + branching.size());
      this->SomeActive.push_back(MakeActive(dimensions, branching,
        [&random](std::size_t level, std::size_t)
        { return random.Integer(0, 3) > (level ? 0 : 1); }));
    }
  }

  ~RayChecks()
  {
    std::cout << "[ tried    ] " << this->Rays << " rays hit, " << this->Missed << " missed, "
              << this->Cells << " cells, " << this->Ties << " cells without length\n";
  }

  RayChecks(const RayChecks&) = delete;
  RayChecks& operator=(const RayChecks&) = delete;

  void Check(
    const Vector3& origin, const Vector3& direction, double tBegin = 0.0, double tEnd = Infinity)
  {
    const auto ray = ClipToVolume(origin, direction, tBegin, tEnd, this->Dimensions);
    if (!ray)
    {
      ++this->Missed;
      return;
    }
    ++this->Rays;
    this->CheckRay(*ray);
    if (testing::Test::HasFailure())
    {
      FAIL() << ToText(*ray);
    }
  }

  std::size_t GetNumberOfHits() const { return this->Rays; }
  std::size_t GetNumberOfMisses() const { return this->Missed; }

private:
  void CheckRay(const Ray& ray)
  {
    const std::vector<Index3> cells = FindCellsBySorting(ray, this->Dimensions);
    this->Cells += cells.size();
    ASSERT_EQ(Traverse(ray, this->Plain), cells);
    for (const ActiveMacrocells& active : this->AllActive)
    {
      ASSERT_EQ(Traverse(ray, active), cells);
    }
    for (const ActiveMacrocells& active : this->SomeActive)
    {
      ASSERT_EQ(Traverse(ray, active), Filter(cells, active));
    }
    ASSERT_NO_FATAL_FAILURE(ExpectNeighboursShareFaces(cells));
    if (ray.Begin < ray.End)
    {
      ASSERT_NO_FATAL_FAILURE(ExpectSegmentsChain(ray, cells));
      const std::set<Index3> visited(cells.begin(), cells.end());
      ASSERT_EQ(visited.size(), cells.size());
      ASSERT_EQ(FindCellsBySegments(ray, this->Dimensions), visited);
    }
    this->CountTies(ray, cells);
  }

  void CountTies(const Ray& ray, const std::vector<Index3>& cells)
  {
    for (const Index3& cell : cells)
    {
      CellSegment segment;
      this->Ties += SegmentInCell(ray, cell, segment) && segment.Begin == segment.End ? 1 : 0;
    }
  }

  Index3 Dimensions;
  ActiveMacrocells Plain;
  std::vector<ActiveMacrocells> AllActive;
  std::vector<ActiveMacrocells> SomeActive;
  std::size_t Rays = 0;
  std::size_t Missed = 0;
  std::size_t Cells = 0;
  std::size_t Ties = 0;
};

const std::vector<Index3> Sizes = { { 2, 2, 2 }, { 3, 2, 5 }, { 7, 8, 9 }, { 17, 4, 10 },
  { 2, 33, 17 } };

Vector3 ToVector(const Index3& i)
{
  return { static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2]) };
}

/// The 26 directions to the neighbours of a lattice point.
std::vector<Vector3> NeighbourDirections()
{
  std::vector<Vector3> directions;
  ForEachPlace({ 3, 3, 3 },
    [&directions](const Index3& i)
    {
      if (i != Index3{ 1, 1, 1 })
      {
        directions.push_back(ToVector(i) - Vector3{ 1.0, 1.0, 1.0 });
      }
    });
  return directions;
}

//------------------------------------------------------------------------------
TEST(CellTraversal, VisitsTheCellsOfRandomRays)
{
  RandomNumbers random(101);
  for (const Index3& size : Sizes)
  {
    RayChecks checks(size);
    for (int i = 0; i < 1000; ++i)
    {
      const Vector3 target =
        random.PointInBox({ 0.0, 0.0, 0.0 }, ToVector(size) - Vector3{ 1.0, 1.0, 1.0 });
      const Vector3 direction = random.Direction();
      const double back = random.Integer(0, 2) * random.Uniform(0.0, 50.0);
      ASSERT_NO_FATAL_FAILURE(checks.Check(target - direction * back, direction));
    }
    EXPECT_GT(checks.GetNumberOfHits(), 600U);
  }
}

//------------------------------------------------------------------------------
TEST(CellTraversal, VisitsTheCellsOfRaysThroughVerticesAndEdges)
{
  for (const Index3& size : { Index3{ 2, 2, 2 }, Index3{ 3, 2, 5 }, Index3{ 7, 8, 9 } })
  {
    RayChecks checks(size);
    for (const Vector3& direction : NeighbourDirections())
    {
      ForEachPlace(size,
        [&](const Index3& vertex)
        {
          for (const double scale : { 1.0, 0.3, 1e-3, 1e7 })
          {
            const Vector3 through = ToVector(vertex);
            checks.Check(through, direction * scale);
            checks.Check(through - direction * 16.0, direction * scale);
            checks.Check(through - direction * 0.7, direction * scale);
          }
        });
      ASSERT_FALSE(HasFailure());
    }
  }
}

//------------------------------------------------------------------------------
TEST(CellTraversal, VisitsTheCellsOfLatticeLines)
{
  RandomNumbers random(102);
  for (const Index3& size : Sizes)
  {
    RayChecks checks(size);
    for (int i = 0; i < 1000; ++i)
    {
      Index3 from;
      Index3 to;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        from[axis] = random.Integer(-3, size[axis] + 2);
        to[axis] = random.Integer(0, size[axis] - 1);
      }
      const double scale = i % 2 == 0 ? 1.0 : random.Uniform(0.1, 3.0);
      ASSERT_NO_FATAL_FAILURE(
        checks.Check(ToVector(from), (ToVector(to) - ToVector(from)) * scale));
    }
    EXPECT_GT(checks.GetNumberOfHits(), 300U);
  }
}

//------------------------------------------------------------------------------
TEST(CellTraversal, VisitsTheCellsOfRaysParallelToAxes)
{
  const Index3 size = { 5, 4, 7 };
  RayChecks checks(size);
  const double denormal = std::numeric_limits<double>::denorm_min();
  const double least = std::numeric_limits<double>::min();
  for (std::size_t along = 0; along < 3; ++along)
  {
    for (const double across : { 0.0, -0.0, denormal, -denormal, least, -least, 1e-300, -1e-20 })
    {
      for (const double u : { 0.0, -0.0, 0.5, 1.0, 2.25, 3.0, 4.0, 6.0 })
      {
        for (const double v : { 0.0, 0.75, 2.0, 3.0, 3.5, 4.0, 6.0 })
        {
          for (const double sign : { -1.0, 1.0 })
          {
            Vector3 origin = { u, u, u };
            Vector3 direction = { across, across, across };
            origin[(along + 1) % 3] = v;
            origin[along] = sign > 0.0 ? -2.0 : 9.0;
            direction[along] = sign;
            ASSERT_NO_FATAL_FAILURE(checks.Check(origin, direction));
            origin[along] = 2.0;
            ASSERT_NO_FATAL_FAILURE(checks.Check(origin, direction));
          }
        }
      }
    }
  }
  EXPECT_GT(checks.GetNumberOfHits(), 1000U);
  EXPECT_GT(checks.GetNumberOfMisses(), 1000U);
}

//------------------------------------------------------------------------------
TEST(CellTraversal, KeepsRaysInTheLastFaceInTheLastCells)
{
  const Index3 size = { 4, 5, 6 };
  const auto ray = ClipToVolume({ -1.0, 4.0, 5.0 }, { 1.0, 0.0, 0.0 }, 0.0, Infinity, size);
  ASSERT_TRUE(ray);
  const std::vector<Index3> expected = { { 0, 3, 4 }, { 1, 3, 4 }, { 2, 3, 4 } };
  EXPECT_EQ(Traverse(*ray, MakeAllActive(size, { 2, 2 })), expected);
  EXPECT_FALSE(ClipToVolume({ -1.0, 4.0 + 1e-9, 5.0 }, { 1.0, 0.0, 0.0 }, 0.0, Infinity, size));
  EXPECT_FALSE(ClipToVolume({ -1.0, 4.0, -1e-9 }, { 1.0, 0.0, 0.0 }, 0.0, Infinity, size));
}

//------------------------------------------------------------------------------
/// Pieces of a volume round otherwise, but a ray in the plane between them is in one cell for both.
TEST(CellTraversal, PutsRaysIntoPlanesThatTheyAreInButForRounding)
{
  const Index3 size = { 6, 7, 8 };
  const UnevenPlanes planes({ { { 0.0, 0.7, 1.9, 3.1, 4.3, 5.0 },
    { 0.0, 0.9, 2.2, 3.0, 4.1, 5.5, 6.0 }, { 0.0, 0.4, 2.0, 3.3, 4.0, 5.1, 6.6, 7.0 } } });
  RandomNumbers random(106);
  for (int i = 0; i < 2000; ++i)
  {
    const bool isEven = i % 2 == 0;
    const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
    const int plane = random.Integer(0, size[axis] - 1);
    const double coordinate = isEven ? plane : planes.Get(axis, plane);
    Vector3 direction = random.Direction();
    Vector3 origin = random.PointInBox({ 0.5, 0.5, 0.5 }, { 4.5, 5.5, 6.5 }) - direction * 20.0;
    direction[axis] = random.Uniform(-1e-16, 1e-16);
    // In the faces of the volume rays without planes of their own that are uneven may miss it.
    const bool isInside = plane > 0 && plane < size[axis] - 1;
    origin[axis] = coordinate + (isEven || isInside ? random.Uniform(-1e-14, 1e-14) : 0.0);
    direction[axis] = isEven || isInside ? direction[axis] : 0.0;
    const auto ray =
      ClipToVolume(origin, direction, 0.0, Infinity, size, isEven ? nullptr : &planes);
    if (ray)
    {
      EXPECT_EQ(ray->Step[axis], 0);
      EXPECT_EQ(ray->Origin[axis], coordinate);
      EXPECT_EQ(ray->Direction[axis], 0.0);
      EXPECT_EQ(ray->Inverse[axis], std::min(plane, size[axis] - 2));
    }
  }
  // Those that are farther away, or go on to other planes, are left as they are.
  const auto off = ClipToVolume({ -1.0, 2.0 + 1e-9, 3.0 }, { 1.0, 0.0, 0.0 }, 0.0, Infinity, size);
  ASSERT_TRUE(off);
  EXPECT_EQ(off->Origin[1], 2.0 + 1e-9);
  const auto across = ClipToVolume({ -1.0, 2.0, 3.0 }, { 1.0, 1e-10, 0.0 }, 0.0, Infinity, size);
  ASSERT_TRUE(across);
  EXPECT_EQ(across->Step[1], 1);
}

//------------------------------------------------------------------------------
TEST(CellTraversal, VisitsTheCellsOfRaysFromFarAway)
{
  RandomNumbers random(103);
  const Index3 size = { 7, 8, 9 };
  RayChecks checks(size);
  for (int i = 0; i < 3000; ++i)
  {
    const Vector3 target = random.PointInBox({ 0.0, 0.0, 0.0 }, { 6.0, 7.0, 8.0 });
    const double distance = std::pow(10.0, random.Uniform(3.0, i % 2 == 0 ? 9.0 : 15.0));
    const Vector3 direction = random.Direction() * random.Uniform(1e-3, 1e3);
    ASSERT_NO_FATAL_FAILURE(checks.Check(target - direction * distance, direction));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 1500U);
}

//------------------------------------------------------------------------------
TEST(CellTraversal, StopsAtTheEndOfTheRay)
{
  RandomNumbers random(104);
  const Index3 size = { 9, 8, 7 };
  RayChecks checks(size);
  for (int i = 0; i < 3000; ++i)
  {
    const bool onLattice = i % 2 == 0;
    Vector3 origin = random.PointInBox({ -2.0, -2.0, -2.0 }, { 8.0, 7.0, 6.0 });
    Vector3 direction = random.Direction();
    double from = random.Uniform(-3.0, 4.0);
    double to = from + random.Uniform(0.0, 6.0);
    if (onLattice)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        origin[axis] = std::floor(origin[axis]);
        direction[axis] = random.Integer(-1, 1);
      }
      from = std::floor(from);
      to = std::floor(to);
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(origin, direction, from, to));
  }
  EXPECT_GT(checks.GetNumberOfHits(), 1000U);
}

//------------------------------------------------------------------------------
TEST(CellTraversal, StopsWhenTheVisitorIsSatisfied)
{
  const Index3 size = { 20, 20, 20 };
  const auto ray = ClipToVolume({ -1.0, 3.3, 4.4 }, { 1.0, 0.5, 0.25 }, 0.0, Infinity, size);
  ASSERT_TRUE(ray);
  for (const std::vector<int>& branching : { std::vector<int>{}, { 4 }, { 2, 3, 5 } })
  {
    const ActiveMacrocells active = MakeAllActive(size, branching);
    const std::size_t all = Traverse(*ray, active).size();
    for (std::size_t limit = 1; limit <= all; ++limit)
    {
      std::size_t visited = 0;
      TraverseCells(*ray, active, [&](const Index3&) { return ++visited == limit; });
      ASSERT_EQ(visited, limit);
    }
  }
}

//------------------------------------------------------------------------------
TEST(CellTraversal, RejectsInvalidRays)
{
  const Index3 size = { 4, 4, 4 };
  const Vector3 origin = { 1.0, 1.0, 1.0 };
  const Vector3 along = { 1.0, 0.0, 0.0 };
  EXPECT_TRUE(ClipToVolume(origin, along, 0.0, Infinity, size));
  EXPECT_TRUE(ClipToVolume(origin, along, -Infinity, Infinity, size));
  EXPECT_FALSE(ClipToVolume(origin, { 0.0, -0.0, 0.0 }, 0.0, Infinity, size));
  EXPECT_FALSE(ClipToVolume(origin, along, 1.0, 0.5, size));
  EXPECT_FALSE(ClipToVolume(origin, along, 5.0, 9.0, size));
  EXPECT_FALSE(ClipToVolume(origin, along, -9.0, -5.0, size));
  for (const double bad : { std::nan(""), Infinity, -Infinity })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector3 v = origin;
      v[axis] = bad;
      EXPECT_FALSE(ClipToVolume(v, along, 0.0, Infinity, size));
      v = along;
      v[axis] = bad;
      EXPECT_FALSE(ClipToVolume(origin, v, 0.0, Infinity, size));
    }
  }
  EXPECT_FALSE(ClipToVolume(origin, along, std::nan(""), 1.0, size));
  EXPECT_FALSE(ClipToVolume(origin, along, 0.0, std::nan(""), size));
}

//------------------------------------------------------------------------------
// However large or small the numbers of a ray, the traversal ends, and stays in the volume. Only
// where the entry is not found to within 1e9 cells (the origin is 1e25 cells away) lattice planes
// coincide and cells are left out.
TEST(CellTraversal, TerminatesForRaysOfAnyMagnitude)
{
  RandomNumbers random(105);
  const Index3 size = { 7, 8, 9 };
  const ActiveMacrocells active = MakeAllActive(size, { 2, 3 });
  std::size_t rays = 0;
  std::size_t compared = 0;
  for (int i = 0; i < 200000; ++i)
  {
    Vector3 origin;
    Vector3 direction;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      origin[axis] =
        random.Integer(0, 1) ? random.Uniform(0.0, 6.0) : random.WideMagnitude(-320.0, 308.0);
      direction[axis] = random.Integer(0, 5) ? random.WideMagnitude(-320.0, 308.0) : 0.0;
    }
    if (const auto ray = ClipToVolume(origin, direction, 0.0, Infinity, size))
    {
      ++rays;
      const std::vector<Index3> cells = Traverse(*ray, active);
      ASSERT_TRUE(!cells.empty() && cells.size() < 30U) << ToText(*ray);
      for (const Index3& cell : cells)
      {
        ASSERT_LT(Offset(cell, { 6, 7, 8 }), std::size_t{ 6 * 7 * 8 }) << ToText(*ray);
      }
      if (std::all_of(
            ray->Origin.begin(), ray->Origin.end(), [](double x) { return std::abs(x) < 1e9; }))
      {
        ++compared;
        ASSERT_EQ(cells, FindCellsBySorting(*ray, size)) << ToText(*ray);
      }
    }
  }
  std::cout << "[ tried    ] " << rays << " rays that hit, of 200000; " << compared
            << " compared\n";
  EXPECT_GT(compared, 10000U);
}

}
}
