// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What is found in trilinear cells for certain, against the contraction and bisection that finds
// all solutions; and that what is next to faces and edges is not certain.

#include "Math/TrilinearCell.h"
#include "Mesh/TrilinearSystem.h"
#include "RandomNumbers.h"
#include "Rays/TrilinearSearch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

/// A cell in the frame of a ray.
struct FramedCell
{
  TrilinearSystem System;
  CellCorners Along;

  /// A unit cube in any direction whose corners are moved, with random values at the corners.
  static FramedCell Make(RandomNumbers& random, double jitter)
  {
    FramedCell cell;
    const Vector3 axis = random.Direction();
    const Vector3 other = Normalized(Cross(axis, random.Direction()));
    const Vector3 third = Cross(axis, other);
    for (std::size_t i = 0; i < 8; ++i)
    {
      const Vector3 corner = Vector3{ (i & 1U) * 1.0, (i >> 1 & 1U) * 1.0, (i >> 2) * 1.0 } +
        random.PointInBox({ -jitter, -jitter, -jitter }, { jitter, jitter, jitter });
      cell.System.Functions[0][i] = Dot(corner, axis);
      cell.System.Functions[1][i] = Dot(corner, other);
      cell.System.Functions[2][i] = random.Uniform(-1.0, 1.0);
      cell.Along[i] = Dot(corner, third);
    }
    return cell;
  }

  /// Moves the ray, and the isovalue if asked for, to a point of the cell.
  void MoveTo(const Vector3& point, int functions)
  {
    for (int i = 0; i < functions; ++i)
    {
      const double there = Interpolate(this->System.Functions[i], point);
      for (double& corner : this->System.Functions[i])
      {
        corner -= there;
      }
    }
  }

  bool HasBothSigns() const
  {
    const CellCorners& values = this->System.Functions[2];
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return *low < 0.0 && *high > 0.0;
  }

  void Load(
    const TrilinearPart* part, int /*count*/, bool /*areWhole*/, TrilinearHits<double>& hits) const
  {
    for (std::size_t i = 0; i < 8; ++i)
    {
      hits.SetCorner(static_cast<int>(i),
        { this->System.Functions[0][i], this->System.Functions[1][i], this->Along[i] },
        this->System.Functions[2][i]);
    }
    std::copy_n(part->Middle, 3, hits.Middle);
    std::copy_n(part->Half, 3, hits.Half);
  }

  TrilinearSolutions Solve() const
  {
    TrilinearSolutions solutions;
    TrilinearSearch<double, 1, 1, FramedCell>(*this, &solutions).Solve(1);
    return solutions;
  }
};

Vector3 GetPoint(const TrilinearSolutions& solutions, int i)
{
  const double* p = solutions.Parametric[i];
  return { p[0], p[1], p[2] };
}

double GetDistance(const Vector3& a, const Vector3& b)
{
  return Length(a - b);
}

//------------------------------------------------------------------------------
TEST(TrilinearHits, AreThoseThatBisectionFinds)
{
  RandomNumbers random(30);
  constexpr int cells = 20000;
  int certain = 0;
  int several = 0;
  for (int i = 0; i < cells; ++i)
  {
    FramedCell cell = FramedCell::Make(random, random.Uniform(0.0, 0.4));
    cell.MoveTo(random.PointInBox({ -0.2, -0.2, -0.2 }, { 1.2, 1.2, 1.2 }), 2);
    const TrilinearSolutions found = cell.Solve();
    if (!found.AreComplete)
    {
      continue;
    }
    certain += found.AreCertain ? 1 : 0;
    several += found.Count > 1 ? 1 : 0;
    std::vector<Vector3> expected;
    cell.System.Solve(expected);
    ASSERT_EQ(static_cast<std::size_t>(found.Count), expected.size()) << i;
    for (int k = 0; k < found.Count; ++k)
    {
      const Vector3 point = GetPoint(found, k);
      const auto isThere = [&point](const Vector3& p) { return GetDistance(p, point) < 1e-9; };
      ASSERT_EQ(std::count_if(expected.begin(), expected.end(), isThere), 1) << i;
      ASSERT_NEAR(found.T[k], Interpolate(cell.Along, point), 1e-15) << i;
    }
  }
  std::cout << "[ certain  ] " << certain << ", several hits in " << several << "\n";
  EXPECT_GT(certain, cells * 98 / 100);
  EXPECT_GT(several, cells / 100);
}

//------------------------------------------------------------------------------
/// Rays along the edges of boxes, as those to a light in a grid: two of the coordinates are known
/// at once, and the third is still to be found.
TEST(TrilinearHits, AreCertainAlongTheEdgesOfBoxes)
{
  RandomNumbers random(36);
  constexpr int cells = 10000;
  int certain = 0;
  int hits = 0;
  for (int i = 0; i < cells; ++i)
  {
    FramedCell cell;
    const Vector3 edges = random.PointInBox({ 0.1, 0.1, 0.1 }, { 9.0, 9.0, 9.0 });
    for (std::size_t k = 0; k < 8; ++k)
    {
      cell.System.Functions[0][k] = (k & 1U) * edges[0];
      cell.System.Functions[1][k] = (k >> 1 & 1U) * edges[1];
      cell.System.Functions[2][k] = random.Uniform(-1.0, 1.0);
      cell.Along[k] = (k >> 2) * edges[2];
    }
    cell.MoveTo(random.PointInBox({ 0.01, 0.01, 0.01 }, { 0.99, 0.99, 0.99 }), 2);
    const TrilinearSolutions found = cell.Solve();
    std::vector<Vector3> expected;
    cell.System.Solve(expected);
    certain += found.AreCertain ? 1 : 0;
    ASSERT_TRUE(!found.AreCertain || static_cast<std::size_t>(found.Count) == expected.size()) << i;
    for (int k = 0; k < found.Count; ++k)
    {
      ++hits;
      ASSERT_LT(std::abs(Interpolate(cell.System.Functions[2], GetPoint(found, k))), 1e-12) << i;
    }
  }
  EXPECT_GT(certain, cells * 99 / 100);
  EXPECT_GT(hits, cells / 10);
}

//------------------------------------------------------------------------------
TEST(TrilinearHits, EnterWhereValuesRise)
{
  RandomNumbers random(31);
  int tried = 0;
  for (int i = 0; i < 5000; ++i)
  {
    FramedCell cell = FramedCell::Make(random, 0.2);
    cell.MoveTo(random.PointInBox({ 0.1, 0.1, 0.1 }, { 0.9, 0.9, 0.9 }), 3);
    const TrilinearSolutions found = cell.Solve();
    for (double& value : cell.System.Functions[2])
    {
      value -= 1e-7;
    }
    const TrilinearSolutions moved = cell.Solve();
    if (found.AreCertain && moved.AreCertain && found.Count == 1 && moved.Count == 1)
    {
      ++tried;
      ASSERT_EQ(found.Entering[0], moved.T[0] > found.T[0]) << i;
    }
  }
  EXPECT_GT(tried, 3000);
}

//------------------------------------------------------------------------------
TEST(TrilinearHits, AreNotCertainNextToFaces)
{
  RandomNumbers random(32);
  int clear = 0;
  for (int i = 0; i < 5000; ++i)
  {
    FramedCell cell = FramedCell::Make(random, 0.2);
    for (const double distance : { -1e-8, 0.0, 1e-8, 1e-3 })
    {
      Vector3 point = random.PointInBox({ 0.2, 0.2, 0.2 }, { 0.8, 0.8, 0.8 });
      point[static_cast<std::size_t>(random.Integer(0, 2))] = distance;
      cell.MoveTo(point, 3);
      const TrilinearSolutions found = cell.Solve();
      const bool isClear = distance > 1e-6;
      EXPECT_TRUE(isClear || !found.AreCertain || !cell.HasBothSigns()) << i << " " << distance;
      bool isFound = false;
      for (int k = 0; k < found.Count; ++k)
      {
        isFound = isFound || GetDistance(GetPoint(found, k), point) < 1e-9;
      }
      clear += isClear && found.AreCertain && isFound ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 4000);
}

//------------------------------------------------------------------------------
/// They need not be looked for again: as many pixels may show a face as a label has.
TEST(TrilinearHits, AreCompleteNextToFacesAndEdges)
{
  RandomNumbers random(34);
  constexpr int cells = 5000;
  constexpr double distances[] = { -1e-8, 0.0, 1e-8 };
  int complete = 0;
  int found[3] = {};
  for (int i = 0; i < cells; ++i)
  {
    FramedCell cell = FramedCell::Make(random, 0.2);
    for (std::size_t k = 0; k < 3; ++k)
    {
      Vector3 point = random.PointInBox({ 0.2, 0.2, 0.2 }, { 0.8, 0.8, 0.8 });
      const int axis = random.Integer(0, 2);
      point[static_cast<std::size_t>(axis)] = distances[k];
      if (i % 2 == 0)
      {
        point[static_cast<std::size_t>((axis + 1) % 3)] = 0.0;
      }
      cell.MoveTo(point, 3);
      const TrilinearSolutions solutions = cell.Solve();
      complete += solutions.AreComplete ? 1 : 0;
      for (int n = 0; n < solutions.Count && solutions.AreComplete; ++n)
      {
        found[k] += GetDistance(GetPoint(solutions, n), point) < 1e-9 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(complete, 3 * cells * 9 / 10);
  EXPECT_EQ(found[0], 0);
  EXPECT_GT(found[1], cells * 9 / 10);
  EXPECT_GT(found[2], cells * 9 / 10);
}

//------------------------------------------------------------------------------
/// Faces are curved: next to an edge rounding may decide about points of the face far away.
TEST(TrilinearHits, AreNotCertainNextToEdges)
{
  RandomNumbers random(33);
  int tried = 0;
  for (int i = 0; i < 20000; ++i)
  {
    FramedCell cell = FramedCell::Make(random, 0.2);
    Vector3 point = { random.Integer(0, 1) * 1.0, random.Integer(0, 1) * 1.0,
      random.Integer(0, 1) * 1.0 };
    point[static_cast<std::size_t>(random.Integer(0, 2))] =
      i % 2 == 0 ? random.Uniform(0.0, 1.0) : 0.0;
    cell.MoveTo(point, 2);
    if (cell.HasBothSigns())
    {
      ++tried;
      ASSERT_FALSE(cell.Solve().AreCertain) << i;
    }
  }
  EXPECT_GT(tried, 15000);
}

//------------------------------------------------------------------------------
/// The only solution is 1.3e-7 beyond a face. The inverse of the Jacobian is large: what is left of
/// the functions is little long before the solution is reached.
TEST(TrilinearHits, AreNotBeyondAFaceIfTheyAreCertain)
{
  FramedCell cell;
  cell.System.Functions[0] = { -0x1.001a8d18f3217p+1, 0x1.9154347c0618ap+0, -0x1.baacabbf8add5p-2,
    -0x1.add62feb97a44p-11, -0x1.00944f16008f3p+1, 0x1.9247b87620f42p+0, -0x1.b6e3a077d8ef7p-2,
    -0x1.27fd97e9ee6b8p-8 };
  cell.System.Functions[1] = { -0x1.fa33172a5c4f3p+0, -0x1.cbbbd6e14fb55p+0, 0x1.75424959bc72cp-3,
    0x1.ebcd5006a9a02p-11, -0x1.ffc4bc9bdc663p+0, -0x1.d155808eeb365p+0, 0x1.a232fb246c306p-3,
    0x1.72aca3f19d62p-6 };
  cell.System.Functions[2] = { -0x1.a330778fa2dfp-13, 0x1.c9ba62de87a1fp-3, 0x1.c9b6539860ae5p-3,
    -0x1.f9b469e30616p-13, 0x1.00536f98bf7edp+1, 0x1.1c400ecf1fp+1, 0x1.1c404fc3816f4p+1,
    0x1.0054c9a888cc5p+1 };
  for (std::size_t k = 0; k < 8; ++k)
  {
    cell.Along[k] = (k & 1U) + 2.0 * (k >> 1 & 1U) + 0.5 * (k >> 2);
  }
  const TrilinearSolutions found = cell.Solve();
  EXPECT_TRUE(!found.AreCertain || found.Count == 0);
}

//------------------------------------------------------------------------------
/// In a flat cell the value rises along the ray, and the surface is nearly along it: the side that
/// it is met from depends on the last step to the solution.
TEST(TrilinearHits, EnterFlatCellsWhereValuesRise)
{
  FramedCell cell;
  cell.System.Functions[0] = { -0x1.e745c21d4e248p-5, -0x1.00be6264077c2p+0, -0x1.b79d024ffbf76p-2,
    -0x1.9515e32ba3bb1p-1, 0x1.258df85324601p-1, 0x1.930551b737ddcp-2, 0x1.abad44ed722d9p-1,
    0x1.e478dcf205767p-3 };
  cell.System.Functions[1] = { -0x1.d0fe9217870ccp-3, -0x1.5edf57207f608p-4, -0x1.5ae4e5089911dp-1,
    0x1.68b0bbd50a75p-2, -0x1.302be2bc621ddp-2, 0x1.0d899982fb122p-1, -0x1.bb7e544d04106p-2,
    0x1.46747b1d99ebp-1 };
  cell.System.Functions[2] = { 0x1.60971698e6cf4p-2, 0x1.1e4ebbd9ec458p-1, 0x1.0186ff30f23d4p-1,
    -0x1.b48d60801df56p-1, -0x1.1320d4f8ba4f8p-3, -0x1.1abce01149d4p-5, -0x1.ce5e14aa6fb6cp-2,
    -0x1.fc41b458d5df4p-2 };
  cell.Along = { 0x1.68b7bbf9665cdp-2, 0x1.59ac3cc5cbf28p-2, -0x1.1ef1ee086a937p-3,
    0x1.95ce60e4f41e4p-1, 0x1.8b47c1ec4d41ap-2, 0x1.263e20ef5d884p+0, 0x1.301d96b4393fap-2,
    0x1.3b322f6d5107cp+0 };
  const TrilinearSolutions found = cell.Solve();
  for (int i = 0; i < found.Count && found.AreCertain; ++i)
  {
    const bool isFar = GetDistance(GetPoint(found, i), { 0.52046, 0.32400, 0.53669 }) > 1e-3;
    EXPECT_TRUE(isFar || !found.Entering[i]);
  }
}

}
}
