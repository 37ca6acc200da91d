// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What kernels find on a single ray in a mesh, against more precise arithmetic, with any
// instruction set: all that is met, and little beside it.

#include "AllKernels.h"
#include "LoneRay.h"
#include "Math/RoundOutward.h"
#include "PieceOfTetrahedron.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class PiecesOnRay : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, PiecesOnRay, AllKernels(), NameOfKernels);

/// What a ray meets of some things.
struct Expected
{
  std::vector<bool> IsMet;
  std::vector<bool> IsNearlyMet;

  void Add(bool isMet, bool isNearlyMet)
  {
    this->IsMet.push_back(isMet);
    this->IsNearlyMet.push_back(isNearlyMet);
  }
};

/// What is found must be all that is met, and not much of what is not.
struct Count
{
  int Met = 0;
  int Beside = 0;
  int Superfluous = 0;

  void Add(unsigned int found, const Expected& expected)
  {
    const std::size_t number = expected.IsMet.size();
    ASSERT_EQ(static_cast<std::uint64_t>(found) >> number, 0U);
    for (std::size_t i = 0; i < number; ++i)
    {
      const bool isFound = (found >> i & 1U) != 0;
      ASSERT_TRUE(isFound || !expected.IsMet[i]) << i;
      this->Met += expected.IsMet[i] ? 1 : 0;
      this->Beside += expected.IsNearlyMet[i] ? 0 : 1;
      this->Superfluous += !expected.IsNearlyMet[i] && isFound ? 1 : 0;
    }
  }
};

/// A mesh of any size and place: up to a hundred times as far from the origin as it is large. Some
/// are long or flat.
Bounds MakeMesh(RandomNumbers& random)
{
  const double size = std::pow(10.0, random.Uniform(-6.0, 6.0));
  const double distance = size * std::pow(10.0, random.Uniform(-2.0, 2.0));
  const double flattest = random.Integer(0, 2) == 0 ? -5.0 : -0.5;
  Bounds mesh;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    mesh.Lower[axis] = distance * random.Uniform(-1.0, 1.0);
    mesh.Upper[axis] = mesh.Lower[axis] + size * std::pow(10.0, random.Uniform(flattest, 0.0));
  }
  return mesh;
}

/// A box in a mesh, some of them flat. Half of them have a corner on the ray, but for rounding.
struct FloatBox
{
  std::array<float, 3> Lower;
  std::array<float, 3> Upper;

  FloatBox(RandomNumbers& random, const Bounds& mesh, const LoneRay& ray)
  {
    const bool isOnRay = random.Integer(0, 1) == 0;
    const double t = random.Uniform(ray.Packet.Begin[0], ray.Packet.End[0]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double a = isOnRay ? ray.Packet.Origin[axis][0] + t * ray.Packet.Direction[axis][0]
                               : random.Uniform(mesh.Lower[axis], mesh.Upper[axis]);
      const double extent = random.Integer(0, 5) == 0 ? 0.0 : random.Uniform(-0.3, 0.3);
      const double b = a + extent * (mesh.Upper[axis] - mesh.Lower[axis]);
      this->Lower[axis] = Clamp(std::min(a, b), mesh, axis);
      this->Upper[axis] = Clamp(std::max(a, b), mesh, axis);
    }
  }

  /// Larger on each side by a part of the mesh: more than what rounding takes.
  FloatBox GetWider(const Bounds& mesh) const
  {
    FloatBox wider = *this;
    const auto room = static_cast<float>(1e-3 * Length(mesh.Upper - mesh.Lower));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      wider.Lower[axis] -= room;
      wider.Upper[axis] += room;
    }
    return wider;
  }

  static float Clamp(double coordinate, const Bounds& mesh, std::size_t axis)
  {
    return static_cast<float>(std::clamp(coordinate, mesh.Lower[axis], mesh.Upper[axis]));
  }
};

TEST_P(PiecesOnRay, FindsChildren)
{
  RandomNumbers random(1);
  Count count;
  for (int i = 0; i < 20000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    const LoneRay ray(random, mesh);
    if (!ray.Exists())
    {
      continue;
    }
    CellTreeNode node{};
    Expected expected;
    for (int child = 0; child < CellTreeNode::Width; ++child)
    {
      const FloatBox box(random, mesh, ray);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        node.Lower[axis][child] = box.Lower[axis];
        node.Upper[axis][child] = box.Upper[axis];
      }
      node.Low[child] = random.Integer(0, 3) == 0 ? 2.0F : 0.0F;
      node.High[child] = 3.0F;
      const bool isActive = node.Low[child] < 2.0F;
      expected.Add(
        isActive && ray.Meets(box, 0.0L), isActive && ray.Meets(box.GetWider(mesh), 0.0L));
    }
    const IsovalueSpan isovalue = { 0.5F, 1.0F };
    const unsigned int found =
      this->TheKernels.FindChildrenOnRay(node, ray.Scatter(this->TheKernels), 0, &isovalue, 1);
    ASSERT_NO_FATAL_FAILURE(count.Add(found, expected)) << i;
  }
  EXPECT_GT(count.Met, 10000);
  EXPECT_LT(count.Superfluous, count.Beside / 50);
}

/// Those that the places of caps are in: the very ones, for places on borders too.
TEST_P(PiecesOnRay, FindsChildrenAroundPlaces)
{
  RandomNumbers random(3);
  int around = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    const Vector3 point = random.PointInBox(mesh.Lower, mesh.Upper);
    const double leastHigh = random.Uniform(-1.0, 1.0);
    PlaceInBoxes place{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place.Below[axis] = RoundDown(point[axis]);
      place.Above[axis] = RoundUp(point[axis]);
    }
    place.LeastHigh = RoundUp(leastHigh);
    CellTreeNode node{};
    unsigned int expected = 0;
    for (int child = 0; child < CellTreeNode::Width; ++child)
    {
      const bool isAtBorder = random.Integer(0, 1) == 0;
      bool isAround = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double size = mesh.Upper[axis] - mesh.Lower[axis];
        const auto end = [&](double side)
        { return static_cast<float>(point[axis] + (isAtBorder ? 0.0 : side * size)); };
        node.Lower[axis][child] = end(-random.Uniform(-0.1, 1.0));
        node.Upper[axis][child] = end(random.Uniform(-0.1, 1.0));
        isAround = isAround && static_cast<double>(node.Lower[axis][child]) <= point[axis] &&
          point[axis] <= static_cast<double>(node.Upper[axis][child]);
      }
      node.High[child] = static_cast<float>(isAtBorder ? leastHigh : random.Uniform(-1.0, 3.0));
      isAround = isAround && leastHigh <= static_cast<double>(node.High[child]);
      expected |= static_cast<unsigned int>(isAround) << child;
      around += isAround ? 1 : 0;
    }
    ASSERT_EQ(this->TheKernels.FindChildrenAround(node, place), expected) << i;
  }
  EXPECT_GT(around, 20000);
}

/// A box as large as the set.
void MakeOnePiece(PackedPieces& set)
{
  set.Count = 1;
  set.AreInTetrahedra = false;
  set.Polygons[0][0] = 0;
  set.Polygons[1][0] = (1U << 3 * PackedPieces::Bits) - 1U;
}

TEST_P(PiecesOnRay, FindsSets)
{
  RandomNumbers random(2);
  Count count;
  for (int i = 0; i < 20000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    const LoneRay ray(random, mesh);
    if (!ray.Exists())
    {
      continue;
    }
    constexpr int most = 32;
    PackedPieces sets[most] = {};
    Expected expected;
    const int number = random.Integer(1, most);
    for (int set = 0; set < number; ++set)
    {
      const FloatBox box(random, mesh, ray);
      std::copy(box.Lower.begin(), box.Lower.end(), sets[set].Lower);
      std::copy(box.Upper.begin(), box.Upper.end(), sets[set].Upper);
      MakeOnePiece(sets[set]);
      expected.Add(ray.Meets(box, 0.0L), ray.Meets(box.GetWider(mesh), 0.0L));
    }
    const ScatteredRays rays = ray.Scatter(this->TheKernels);
    unsigned int found = 0;
    unsigned int pieces;
    for (int next = 0;
         (next = this->TheKernels.FindPiecesOnRay(sets, next, number, rays, 0, pieces)) < number;
         ++next)
    {
      ASSERT_EQ(pieces, 1U);
      found |= 1U << next;
    }
    ASSERT_NO_FATAL_FAILURE(count.Add(found, expected)) << i;
  }
  EXPECT_GT(count.Met, 10000);
  EXPECT_LT(count.Superfluous, count.Beside / 50);
}

//------------------------------------------------------------------------------
/// Tetrahedra that a surface passes. The piece in the first has a corner on the ray, but for
/// rounding.
struct PassedTetrahedra
{
  int Count;
  double Corners[PackedPieces::Capacity][4][4];
  PackedPieces Set{};

  PassedTetrahedra(
    RandomNumbers& random, const Bounds& mesh, const LoneRay& ray, const Kernels& kernels)
    : Count(random.Integer(1, PackedPieces::Capacity))
  {
    const double t = random.Uniform(ray.Packet.Begin[0], ray.Packet.End[0]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double lower = mesh.Lower[axis];
      const double upper = mesh.Upper[axis];
      const double place =
        std::clamp(ray.Packet.Origin[axis][0] + t * ray.Packet.Direction[axis][0], lower, upper);
      const double edge = 0.1 * (upper - lower);
      for (int cell = 0; cell < this->Count; ++cell)
      {
        const double shift = cell == 0 ? 0.0 : random.Uniform(-edge, edge);
        for (auto& corner : this->Corners[cell])
        {
          corner[axis] = std::clamp(place + shift + random.Uniform(-edge, edge), lower, upper);
        }
      }
      const double room = std::min({ edge, place - lower, upper - place });
      const double step = random.Uniform(-room, room);
      this->Corners[0][0][axis] = place - step;
      this->Corners[0][3][axis] = place + step;
    }
    for (int cell = 0; cell < this->Count; ++cell)
    {
      const double values[] = { -0.5, random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0), 0.5 };
      for (int corner = 0; corner < 4; ++corner)
      {
        this->Corners[cell][corner][3] = values[corner];
      }
    }
    this->Set.Count = static_cast<std::uint8_t>(this->Count);
    this->Set.AreInTetrahedra = true;
    kernels.PackPolygons(this->Corners, this->Set);
  }
};

TEST_P(PiecesOnRay, FindsPolygons)
{
  RandomNumbers random(3);
  Count count;
  for (int i = 0; i < 20000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    const LoneRay ray(random, mesh);
    if (!ray.Exists())
    {
      continue;
    }
    const PassedTetrahedra cells(random, mesh, ray, this->TheKernels);
    const unsigned int found = ray.FindPieces(this->TheKernels, cells.Set);
    // Polygons do not tell where on its line the ray is.
    LoneRay line = ray;
    line.Packet.Begin[0] = -HUGE_VAL;
    line.Packet.End[0] = HUGE_VAL;
    Expected expected;
    for (int cell = 0; cell < cells.Count; ++cell)
    {
      const PieceOfTetrahedron piece(cells.Corners[cell]);
      const bool isMet = piece.IsMetBy(ray.Packet);
      expected.Add(isMet, isMet || line.Meets(piece, 0.05L));
    }
    ASSERT_NO_FATAL_FAILURE(count.Add(found, expected)) << i;
  }
  EXPECT_GT(count.Met, 1000);
  EXPECT_LT(count.Superfluous, count.Beside / 50) << count.Met << " " << count.Beside;
}

}
}
