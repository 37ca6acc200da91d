// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What kernels find on a single ray in a mesh, against more precise arithmetic, with any
// instruction set: all that is met, and little beside it.

#include "AllKernels.h"
#include "LoneRay.h"
#include "Math/RoundOutward.h"
#include "Mesh/RayPencil.h"
#include "PieceOfTetrahedron.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
    if (!ray.HasFrame)
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
    float near[CellTreeNode::Width];
    const unsigned int found = this->TheKernels.FindChildrenInPencil(
      node, RayPencil::GetBounds(ray.GetThrough()), ray.End, &isovalue, 1, near);
    ASSERT_NO_FATAL_FAILURE(count.Add(found, expected)) << i;
    for (int child = 0; child < CellTreeNode::Width; ++child)
    {
      const bool isFound = (found >> child & 1U) != 0;
      ASSERT_TRUE(!isFound || (ray.Begin <= near[child] && near[child] <= ray.End));
    }
  }
  EXPECT_GT(count.Met, 10000);
  EXPECT_LT(count.Superfluous, count.Beside / 50);
}

/// Rays that go about the same way, one way along an axis, from about the same place.
struct Group
{
  std::vector<LoneRay> Rays;
  LoneRays Placed;
  float End = -std::numeric_limits<float>::infinity();

  /// The spread is a part of the size of the mesh, and of a direction.
  Group(RandomNumbers& random, const Bounds& mesh, double spread)
  {
    this->Placed.Clear(mesh);
    const double size = Length(mesh.Upper - mesh.Lower);
    const Vector3 place = random.PointInBox(mesh.Lower, mesh.Upper);
    // Some are parallel, along an axis, or in the plane of two.
    Vector3 way = random.Direction();
    for (double& step : way)
    {
      step = random.Integer(0, 3) == 0 ? 0.0 : step;
    }
    const double turn = random.Integer(0, 2) == 0 ? 0.0 : spread;
    const double before = random.Integer(0, 2) == 0 ? random.Uniform(0.0, 100.0) : 0.0;
    const int count = random.Integer(2, 40);
    for (int i = 0; i < count; ++i)
    {
      const Vector3 origin =
        place + random.Direction() * (size * spread * random.Uniform(0.0, 1.0));
      const Vector3 direction =
        (way + random.Direction() * (turn * random.Uniform(0.0, 1.0))) * size;
      const double begin = before + random.Uniform(0.0, 0.2);
      this->Add(LoneRay(
        mesh, origin - direction * before, direction, begin, begin + random.Uniform(0.1, 1.0)));
    }
  }

  void Add(const LoneRay& ray)
  {
    const auto isAlike = [&ray](const LoneRay& other)
    {
      return other.Frame.GetNumbers().Along == ray.Frame.GetNumbers().Along &&
        other.Frame.GetNumbers().Sign == ray.Frame.GetNumbers().Sign;
    };
    if (ray.HasFrame && (this->Rays.empty() || isAlike(this->Rays.front())))
    {
      ray.Put(this->GetSize(), this->Placed);
      this->End = std::max(this->End, ray.End);
      this->Rays.push_back(ray);
    }
  }

  int GetSize() const { return static_cast<int>(this->Rays.size()); }

  const LoneRay& GetAny(RandomNumbers& random) const
  {
    return this->Rays[static_cast<std::size_t>(random.Integer(0, this->GetSize() - 1))];
  }
};

/// The children that any ray of a pencil meets, at depths not behind its own; few beside, if the
/// pencil is narrow.
TEST_P(PiecesOnRay, FindsChildrenInPencils)
{
  RandomNumbers random(4);
  Count ofAll;
  Count ofNarrow;
  for (int i = 0; i < 5000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    const double spread = std::pow(10.0, random.Uniform(-6.0, 0.0));
    const Group group(random, mesh, spread);
    if (group.Rays.empty())
    {
      continue;
    }
    CellTreeNode node{};
    Expected expected;
    std::vector<float> nearest;
    for (int child = 0; child < CellTreeNode::Width; ++child)
    {
      const FloatBox box(random, mesh, group.GetAny(random));
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        node.Lower[axis][child] = box.Lower[axis];
        node.Upper[axis][child] = box.Upper[axis];
      }
      node.High[child] = 1.0F;
      bool isMet = false;
      bool isNearlyMet = false;
      long double depth = std::numeric_limits<long double>::infinity();
      for (const LoneRay& ray : group.Rays)
      {
        const BeamNumbers& frame = ray.Frame.GetNumbers();
        const long double t = ray.FindEntry(box, 0.0L);
        isMet = isMet || ray.Meets(box, 0.0L);
        isNearlyMet = isNearlyMet || ray.Meets(box.GetWider(mesh), 0.0L);
        if (std::isfinite(t))
        {
          const long double coordinate =
            ray.Packet.Origin[frame.Along][0] + t * ray.Packet.Direction[frame.Along][0];
          depth = std::min(depth, (coordinate - frame.Plane) * frame.Sign);
        }
      }
      expected.Add(isMet, isNearlyMet);
      nearest.push_back(static_cast<float>(depth));
    }
    const IsovalueSpan isovalue = { 0.5F, 1.0F };
    float near[CellTreeNode::Width];
    const RayPencil pencil(group.Placed, 0, group.GetSize(), mesh);
    const unsigned int found = this->TheKernels.FindChildrenInPencil(
      node, pencil.GetBounds(), group.End, &isovalue, 1, near);
    ASSERT_NO_FATAL_FAILURE((spread < 1e-4 ? ofNarrow : ofAll).Add(found, expected)) << i;
    for (int child = 0; child < CellTreeNode::Width; ++child)
    {
      const auto number = static_cast<std::size_t>(child);
      ASSERT_TRUE(!expected.IsMet[number] || near[child] <= nearest[number]) << i;
    }
  }
  EXPECT_GT(ofAll.Met, 1000);
  EXPECT_GT(ofNarrow.Met, 1000);
  EXPECT_LT(ofNarrow.Superfluous, ofNarrow.Beside / 50);
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
    if (!ray.HasFrame)
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
    LoneRays alone;
    alone.Clear(mesh);
    ray.Put(0, alone);
    const PencilThroughBoxes pencil = RayPencil::GetBounds(alone.Through[0]);
    unsigned int found = 0;
    for (int next = 0; next < number;)
    {
      MetPieces met;
      const int first = next;
      next = this->TheKernels.FindPiecesOnRays(
        sets, first, number, alone, { pencil, 0, 1, ray.End }, met);
      ASSERT_LT(first, next);
      ASSERT_TRUE(met.Count == 1 || next == number);
      found |= static_cast<unsigned int>(met.Count) << (next - 1);
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
    if (!ray.HasFrame)
    {
      continue;
    }
    const PassedTetrahedra cells(random, mesh, ray, this->TheKernels);
    const unsigned int found = ray.FindPieces(this->TheKernels, cells.Set);
    Expected expected;
    for (int cell = 0; cell < cells.Count; ++cell)
    {
      const PieceOfTetrahedron piece(cells.Corners[cell]);
      const bool isMet = piece.IsMetBy(ray.Packet);
      expected.Add(isMet, isMet || ray.Meets(piece, 0.05L));
    }
    ASSERT_NO_FATAL_FAILURE(count.Add(found, expected)) << i;
  }
  EXPECT_GT(count.Met, 1000);
  EXPECT_LT(count.Superfluous, count.Beside / 50) << count.Met << " " << count.Beside;
}

/// What many rays meet of several sets is what each of them meets by itself.
TEST_P(PiecesOnRay, FindsPiecesOnManyRays)
{
  RandomNumbers random(5);
  int met = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Bounds mesh = MakeMesh(random);
    Group group(random, mesh, 0.1);
    // Some fill all places.
    while (i % 4 == 0 && !group.Rays.empty() && group.GetSize() < RayPacket::Capacity)
    {
      group.Add(LoneRay(group.GetAny(random)));
    }
    if (group.Rays.empty())
    {
      continue;
    }
    RayPencil::BoundGroups(group.Placed, 0, group.GetSize(), mesh);
    constexpr int number = 5;
    PackedPieces sets[number] = {};
    for (PackedPieces& set : sets)
    {
      set = PassedTetrahedra(random, mesh, group.GetAny(random), this->TheKernels).Set;
    }
    const int first = random.Integer(0, group.GetSize() - 1);
    const int count = random.Integer(1, group.GetSize() - first);
    const PencilThroughBoxes pencil = RayPencil(group.Placed, first, count, mesh).GetBounds();
    int last = 0;
    for (int next = 0; next < number; last = next)
    {
      MetPieces found;
      next = this->TheKernels.FindPiecesOnRays(
        sets, last, number, group.Placed, { pencil, first, count, group.End }, found);
      for (int set = last; set < next; ++set)
      {
        int entry = 0;
        for (int place = first; place < first + count; ++place)
        {
          const unsigned int alone =
            group.Rays[static_cast<std::size_t>(place)].FindPieces(this->TheKernels, sets[set]);
          const bool isFound =
            set == next - 1 && entry < found.Count && found.Place[entry] == place;
          ASSERT_EQ(isFound ? found.Pieces[entry] : 0U, alone) << i;
          entry += isFound ? 1 : 0;
          met += isFound ? 1 : 0;
        }
        ASSERT_TRUE(set < next - 1 || entry == found.Count);
      }
    }
  }
  EXPECT_GT(met, 1000);
}

}
}
