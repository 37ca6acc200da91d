// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells that the kernels find for a ray must include all that it passes, by the traversal from
// cell to cell; and the roots in cells must be those of the robust solver, to the last bit.

#include "AllKernels.h"
#include "CellReference.h"
#include "Image/Macrocells/BlockMask.h"
#include "RandomNumbers.h"
#include "RandomPlanes.h"
#include "Rays/RayPacket.h"
#include "SameBits.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class CellKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, CellKernels, AllKernels(), NameOfKernels);

//------------------------------------------------------------------------------
/// The slices that have any cells.
unsigned int FindSlices(const std::uint64_t cells[8])
{
  unsigned int slices = 0;
  for (int slice = 0; slice < 8; ++slice)
  {
    slices |= (cells[slice] != 0 ? 1U : 0U) << slice;
  }
  return slices;
}

/// Calls visit(passage) for every passage that find(first cell of the block) adds to passages.
template <typename Find, typename Visit>
void ForEachPassage(const Index3& block, Passages& passages, const Find& find, const Visit& visit)
{
  const int first[3] = { 8 * block[0], 8 * block[1], 8 * block[2] };
  // Others exist already, and are kept.
  passages.Count = 1;
  passages.Segments[0].Ray = -1;
  passages.BlockCount = 1;
  passages.HasEnds = false;
  find(first);
  ASSERT_EQ(passages.Segments[0].Ray, -1);
  ASSERT_EQ(passages.BlockCount, passages.Count > 1 ? 2 : 1);
  for (int i = 1; i < passages.Count; ++i)
  {
    ASSERT_NE(passages.Slices[i], 0U);
    ASSERT_EQ(passages.Slices[i] & ~FindSlices(passages.Cells[i]), 0U);
    ASSERT_EQ(passages.Segments[i].Block, 1);
    ASSERT_TRUE(std::equal(first, first + 3, passages.First[1]));
    ASSERT_FALSE(passages.Hits[i]);
    visit(i);
  }
}

/// The cells of a volume in a block, or some of them: many or very few.
BlockMask MakeMask(RandomNumbers& random, const Index3& block, const Index3& dimensions, bool all)
{
  BlockMask mask = {};
  const int oneOf = random.Integer(0, 1) ? 3 : random.Integer(3, 500);
  ForEachPlace({ 8, 8, 8 },
    [&](const Index3& i)
    {
      bool isIn = all || random.Integer(1, oneOf) == 1;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn = isIn && 8 * block[axis] + i[axis] < dimensions[axis] - 1;
      }
      mask.Slices[2][i[2]] |= std::uint64_t{ isIn } << (i[0] + 8 * i[1]);
    });
  mask.CompleteSlices();
  return mask;
}

/// Compares the cells found for a packet in all blocks with those passed, and counts.
class CellChecks
{
public:
  explicit CellChecks(const Kernels& kernels, const UnevenPlanes* planes = nullptr)
    : TheKernels(kernels)
    , Planes(planes)
  {
  }

  void Check(RandomNumbers& random, const RayPacket& packet, const RaySet& rays, int axis,
    const Index3& dimensions, bool all)
  {
    Frustum frustum;
    ASSERT_TRUE(this->TheKernels.Align(packet, rays, axis, this->Aligned, frustum));
    std::vector<std::set<Index3>> left(RayPacket::Capacity);
    for (int i = 0; i < packet.Count; ++i)
    {
      if (Has(rays, i))
      {
        Ray ray = GetRay(packet, i);
        ray.Planes = this->Planes;
        const std::vector<Index3> passed = CellsOnRay(ray, dimensions);
        left[static_cast<std::size_t>(i)].insert(passed.begin(), passed.end());
        if (!this->Planes)
        {
          ASSERT_NO_FATAL_FAILURE(this->CheckMembers(i, axis, passed));
        }
        this->Passed += all ? passed.size() : 0;
        ++this->Rays;
      }
    }
    const LatticePlanes planes = this->Planes ? this->Planes->GetLatticePlanes() : LatticePlanes();
    ForEachPlace(BlocksCovering({ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }, 8),
      [&](const Index3& block)
      {
        const BlockMask mask = MakeMask(random, block, dimensions, all);
        RaySet found = {};
        Passages passages;
        ForEachPassage(
          block, passages,
          [&](const int first[3])
          {
            this->TheKernels.FindPassages(this->Aligned, rays, axis, first, mask.Slices[axis],
              this->Planes ? &planes : nullptr, passages);
          },
          [&](int i)
          {
            const int ray = passages.Segments[i].Ray;
            ASSERT_TRUE(Has(rays, ray));
            ASSERT_FALSE(Has(found, ray));
            Add(ray, found);
            ASSERT_EQ(passages.Slices[i], FindSlices(passages.Cells[i]));
            if (!this->Planes)
            {
              this->CheckPassage(
                passages, i, axis, block, mask, left[static_cast<std::size_t>(ray)]);
            }
            this->Take(
              passages.Cells[i], axis, block, mask, left[static_cast<std::size_t>(ray)], all);
          });
        // Rays that are left must not have been requested.
        for (const std::set<Index3>& cells : left)
        {
          for (const Index3& cell : cells)
          {
            const bool isHere =
              cell[0] / 8 == block[0] && cell[1] / 8 == block[1] && cell[2] / 8 == block[2];
            ASSERT_FALSE(isHere && mask.Has({ cell[0] % 8, cell[1] % 8, cell[2] % 8 }))
              << "cell " << cell[0] << ", " << cell[1] << ", " << cell[2];
          }
        }
      });
  }

  /// The number of cells found for one that is passed.
  double GetExcess() const
  {
    return static_cast<double>(this->Found) / static_cast<double>(this->Passed);
  }

  std::size_t GetNumberOfRays() const { return this->Rays; }

  /// Those that were checked last.
  const AlignedRays& GetAlignedRays() const { return this->Aligned; }

private:
  /// The passage of the ray alone is the same, but for cells in slices that the ray does not reach.
  void CheckPassage(const Passages& passages, int i, int axis, const Index3& block,
    const BlockMask& mask, const std::set<Index3>& passed)
  {
    const int ray = passages.Segments[i].Ray;
    Passages alone;
    bool isFound = false;
    ForEachPassage(
      block, alone,
      [&](const int first[3])
      { this->TheKernels.FindPassage(this->Aligned, ray, axis, first, mask.Slices[axis], alone); },
      [&](int number)
      {
        isFound = true;
        const Passages::Segment& segment = alone.Segments[number];
        const Passages::Segment& expected = passages.Segments[i];
        ASSERT_EQ(segment.Ray, ray);
        ASSERT_TRUE(std::equal(segment.Line, segment.Line + 4, expected.Line));
        ASSERT_TRUE(passages.HasEnds || !alone.HasEnds);
        for (int end = 0; alone.HasEnds && end < 2; ++end)
        {
          // Those next to the first and the last plane do not count.
          const bool isHere = std::abs(segment.Ends[end]) < 3.9999F;
          ASSERT_TRUE(!isHere || segment.Ends[end] == expected.Ends[end]);
        }
      });
    for (int slice = 0; slice < 8; ++slice)
    {
      const bool isReached = isFound && (alone.Slices[1] >> slice & 1) != 0;
      ASSERT_TRUE(!isReached || alone.Cells[1][slice] == passages.Cells[i][slice]);
      for (const Index3& cell : passed)
      {
        const int place =
          cell[static_cast<std::size_t>(axis)] - 8 * block[static_cast<std::size_t>(axis)];
        ASSERT_FALSE(!isReached && place == slice &&
          (passages.Cells[i][slice] >> GetBit(cell, axis) & 1) != 0 && IsIn(cell, block));
      }
    }
  }

  static bool IsIn(const Index3& cell, const Index3& block)
  {
    return cell[0] / 8 == block[0] && cell[1] / 8 == block[1] && cell[2] / 8 == block[2];
  }

  /// Of a cell in its slice of a block across an axis.
  static int GetBit(const Index3& cell, int axis)
  {
    return cell[static_cast<std::size_t>(BlockMask::U[axis])] % 8 +
      8 * (cell[static_cast<std::size_t>(BlockMask::V[axis])] % 8);
  }

  /// In blocks of blocks, a ray comes to all that have a cell that it passes.
  void CheckMembers(int ray, int axis, const std::vector<Index3>& passed)
  {
    constexpr std::uint64_t all[8] = { ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL };
    for (const int edge : { 8, 64 })
    {
      for (const Index3& cell : passed)
      {
        int first[3];
        Index3 member;
        for (std::size_t i = 0; i < 3; ++i)
        {
          first[i] = cell[i] / (8 * edge) * (8 * edge);
          member[i] = (cell[i] - first[i]) / edge;
        }
        std::uint64_t members[8];
        const unsigned int slices =
          this->TheKernels.FindMembersOfRay(this->Aligned, ray, axis, first, edge, all, members);
        const int slice = member[static_cast<std::size_t>(axis)];
        ASSERT_NE(slices >> slice & 1, 0U);
        ASSERT_NE(members[slice] >> GetBit(member, axis) & 1, 0U);
        ASSERT_LE(CountBits(members[slice]), 9);
      }
    }
  }

  void Take(const std::uint64_t cells[8], int axis, const Index3& block, const BlockMask& mask,
    std::set<Index3>& left, bool all)
  {
    for (int slice = 0; slice < 8; ++slice)
    {
      ASSERT_EQ(cells[slice] & ~mask.Slices[axis][slice], 0U);
      for (int bit = 0; bit < 64; ++bit)
      {
        if (cells[slice] >> bit & 1)
        {
          Index3 cell = { 8 * block[0], 8 * block[1], 8 * block[2] };
          cell[static_cast<std::size_t>(axis)] += slice;
          cell[static_cast<std::size_t>(BlockMask::U[axis])] += bit % 8;
          cell[static_cast<std::size_t>(BlockMask::V[axis])] += bit / 8;
          left.erase(cell);
          this->Found += all ? 1 : 0;
        }
      }
    }
  }

  const Kernels& TheKernels;
  const UnevenPlanes* Planes;
  AlignedRays Aligned;
  std::size_t Rays = 0;
  std::size_t Passed = 0;
  std::size_t Found = 0;
};

//------------------------------------------------------------------------------
TEST_P(CellKernels, FindTheCellsThatRaysPass)
{
  RandomNumbers random(841);
  for (const LineKind kind : AllLineKinds)
  {
    CellChecks checks(this->TheKernels);
    for (int i = 0; i < 150; ++i)
    {
      const int longest = i % 10 == 0 ? 200 : 26;
      Index3 dimensions = { random.Integer(2, 26), random.Integer(2, 26), random.Integer(2, 26) };
      const int axis = random.Integer(0, 2);
      dimensions[static_cast<std::size_t>(axis)] = random.Integer(2, longest);
      const double sign = random.Integer(0, 1) ? 1.0 : -1.0;
      RayPacket packet = EmptyPacket();
      RaySet rays = {};
      const int count = random.Integer(1, i % 3 == 0 ? 128 : 20);
      for (int k = 0; k < count; ++k)
      {
        // Besides the rays of the frustum there may be any others in the packet.
        const bool isInFrustum = random.Integer(0, 4) != 0;
        const Line line = isInFrustum
          ? LineAlong(random, kind, static_cast<std::size_t>(axis), sign, dimensions)
          : LatticeLine(random, dimensions);
        const double end = random.Integer(0, 4) ? Infinity : random.Uniform(0.0, 40.0);
        const auto ray = ClipToVolume(line.Origin, line.Direction, 0.0, end, dimensions);
        AppendRay(ray, packet);
        if (ray && isInFrustum)
        {
          Add(k, rays);
        }
      }
      if (!IsEmpty(rays))
      {
        ASSERT_NO_FATAL_FAILURE(
          checks.Check(random, packet, rays, axis, dimensions, random.Integer(0, 3) != 0));
      }
    }
    std::cout << "[ tried    ] kind " << static_cast<int>(kind) << ": " << checks.GetNumberOfRays()
              << " rays, " << checks.GetExcess() << " cells found for one that is passed\n";
    EXPECT_GT(checks.GetNumberOfRays(), 500U);
    // Through vertices and in faces, the cells on all sides are equally near.
    const bool isOnLattice = kind == LineKind::BesidePlane || kind == LineKind::InFace ||
      kind == LineKind::ThroughVertices || kind == LineKind::Diagonal;
    EXPECT_LT(checks.GetExcess(), isOnLattice ? 4.0 : 1.5);
  }
}

//------------------------------------------------------------------------------
// Packets of rays.

/// From an eye through the pixels of a small picture, in its rows, or along one direction: up or
/// down an axis and through the volume.
void AddRaysOfPixels(RandomNumbers& random, std::size_t axis, const Index3& n, RayPacket& packet,
  const UnevenPlanes* planes = nullptr)
{
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  const bool isParallel = random.Integer(0, 2) == 0;
  const double sign = random.Integer(0, 1) ? 1.0 : -1.0;
  const Vector3 through = random.PointInBox({}, { n[0] - 1.0, n[1] - 1.0, n[2] - 1.0 });
  Vector3 middle = {};
  middle[axis] = sign;
  middle[u] = random.Uniform(-1.0, 1.0);
  middle[v] = random.Integer(0, 2) ? random.Uniform(-1.0, 1.0) : 0.0;
  // The eye may be within the volume: rays also begin there.
  const Vector3 eye = through - middle * random.Uniform(0.0, 200.0);
  const int columns = random.Integer(1, 16);
  const int count = random.Integer(1, RayPacket::Capacity);
  const double size = random.Uniform(1e-4, 0.9 / std::max(columns, count / columns));
  for (int i = 0; i < count; ++i)
  {
    Vector3 off = {};
    off[u] = size * (i % columns - 0.5 * columns);
    off[v] = size * std::floor(i / columns); // NOLINT(bugprone-integer-division): a row
    const Line line = isParallel ? Line{ eye + off * 200.0, middle } : Line{ eye, middle + off };
    const double end = random.Integer(0, 9) ? Infinity : random.Uniform(0.0, 200.0);
    AppendRay(ClipToVolume(line.Origin, line.Direction, 0.0, end, n, planes), packet);
  }
}

/// Some of the rays that exist, down to very few.
RaySet SomeRays(RandomNumbers& random, const RayPacket& packet)
{
  const int oneOf = random.Integer(0, 1) ? 1 : random.Integer(1, 60);
  RaySet rays = {};
  for (int i = 0; i < packet.Count; ++i)
  {
    if (Has(packet.Exists, i) && random.Integer(1, oneOf) == 1)
    {
      Add(i, rays);
    }
  }
  return rays;
}

/// The bounds of a subpacket must contain its rays over their whole length, and be tight at the
/// ends.
void CheckBunches(const AlignedRays& aligned, const RaySet& rays)
{
  for (int subpacket = 0; subpacket < AlignedRays::Subpackets; ++subpacket)
  {
    for (std::size_t j = 0; j < 2; ++j)
    {
      for (const double share : { 0.0, 0.3, 0.5, 0.9, 1.0 })
      {
        const double plane = aligned.SweptLow + share * (aligned.SweptHigh - aligned.SweptLow);
        double least = Infinity;
        double most = -Infinity;
        for (int i = subpacket * AlignedRays::SubpacketSize;
             i < (subpacket + 1) * AlignedRays::SubpacketSize; ++i)
        {
          if (Has(rays, i))
          {
            const double coordinate = aligned.Offset[j][i] + plane * aligned.Slope[j][i];
            least = std::min(least, coordinate);
            most = std::max(most, coordinate);
          }
        }
        const double foundLeast =
          aligned.LeastOffset[j][subpacket] + plane * aligned.LeastSlope[j][subpacket];
        const double foundMost =
          aligned.MostOffset[j][subpacket] + plane * aligned.MostSlope[j][subpacket];
        const double tiny = 1e-9;
        ASSERT_LE(foundLeast, least + tiny);
        ASSERT_GE(foundMost, most - tiny);
        if (share == 0.0 || share == 1.0 || least > most)
        {
          ASSERT_GE(foundLeast, least - tiny);
          ASSERT_LE(foundMost, most + tiny);
        }
      }
    }
  }
}

TEST_P(CellKernels, FindTheCellsThatPacketsPass)
{
  RandomNumbers random(843);
  CellChecks checks(this->TheKernels);
  for (int i = 0; i < 1000; ++i)
  {
    Index3 dimensions = { random.Integer(2, 40), random.Integer(2, 40), random.Integer(2, 40) };
    const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
    dimensions[axis] = random.Integer(2, 200);
    RayPacket packet = EmptyPacket();
    AddRaysOfPixels(random, axis, dimensions, packet);
    const RaySet rays = SomeRays(random, packet);
    if (IsEmpty(rays))
    {
      continue;
    }
    ASSERT_NO_FATAL_FAILURE(checks.Check(
      random, packet, rays, static_cast<int>(axis), dimensions, random.Integer(0, 3) == 0));
    ASSERT_NO_FATAL_FAILURE(CheckBunches(checks.GetAlignedRays(), rays));
  }
  std::cout << "[ tried    ] " << checks.GetNumberOfRays() << " rays, " << checks.GetExcess()
            << " cells found for one that is passed\n";
  EXPECT_GT(checks.GetNumberOfRays(), 10000U);
  EXPECT_LT(checks.GetExcess(), 1.5);
}

//------------------------------------------------------------------------------
TEST_P(CellKernels, FindTheCellsThatPacketsPassBetweenUnevenPlanes)
{
  RandomNumbers random(844);
  for (const Unevenness& unevenness :
    { Unevenness{ 0.5, false }, { 2.0, true }, { 10.0, false }, { 30.0, true } })
  {
    std::size_t rayCount = 0;
    for (int i = 0; i < 300; ++i)
    {
      Index3 dimensions = { random.Integer(2, 40), random.Integer(2, 40), random.Integer(2, 40) };
      const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
      dimensions[axis] = random.Integer(2, 200);
      const UnevenPlanes planes = RandomPlanes(random, dimensions, unevenness);
      CellChecks checks(this->TheKernels, &planes);
      RayPacket packet = EmptyPacket();
      AddRaysOfPixels(random, axis, dimensions, packet, &planes);
      const RaySet rays = SomeRays(random, packet);
      if (IsEmpty(rays))
      {
        continue;
      }
      ASSERT_NO_FATAL_FAILURE(checks.Check(
        random, packet, rays, static_cast<int>(axis), dimensions, unevenness.Octaves < 1.0));
      rayCount += checks.GetNumberOfRays();
      // One packet may consist of rays in planes, which have cells on both sides.
      EXPECT_TRUE(unevenness.Octaves > 1.0 || checks.GetExcess() < 4.0) << checks.GetExcess();
    }
    EXPECT_GT(rayCount, 3000U);
  }
}

//------------------------------------------------------------------------------
/// A ray of a packet, a cell that it passes or comes near to, and the values at its corners.
struct Query
{
  int Ray;
  Index3 Cell;
  CellCorners Corners;
};

const Index3 Dimensions = { 9, 10, 8 };

std::optional<Ray> RandomRay(RandomNumbers& random)
{
  Line line =
    random.Integer(0, 2) ? RandomLine(random, Dimensions) : LatticeLine(random, Dimensions);
  // With such a direction, planes of several axes are crossed at one t, but not at whole numbers.
  line.Direction = line.Direction * (random.Integer(0, 1) ? random.Uniform(0.5, 2.0) : 1.0);
  if (random.Integer(0, 9) == 0)
  {
    line.Origin = line.Origin - line.Direction * 1e9;
  }
  const double begin = random.Integer(0, 3) ? 0.0 : random.Uniform(0.0, 10.0);
  const double end = random.Integer(0, 3) ? Infinity : begin + random.Uniform(0.0, 10.0);
  return ClipToVolume(line.Origin, line.Direction, begin, end, Dimensions);
}

/// Values of all kinds: smooth, rough, with ties and zeros, tangent, of any magnitude.
CellCorners RandomCorners(RandomNumbers& random)
{
  CellCorners corners;
  const int kind = random.Integer(0, 8);
  const double limits[][2] = { { -3.0, 3.0 }, { -320.0, 308.0 }, { -101.0, -99.0 }, { 99.0, 101.0 },
    { -290.0, -260.0 } };
  const auto& limit = limits[random.Integer(0, 4)];
  const double middle = random.Uniform(0.0, 1.0);
  for (std::size_t i = 0; i < 8; ++i)
  {
    // A parabola along x + y + z that is nearly tangent to zero.
    const double off = static_cast<double>((i & 1) + (i >> 1 & 1) + (i >> 2)) / 3.0 - middle;
    const double values[] = { random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0),
      random.Uniform(-100.0, 3000.0), random.Integer(-1, 1) + 0.0, random.Integer(-3, 3) * 0.5,
      off * off + random.Uniform(-1e-9, 1e-9), off + random.Uniform(-1e-6, 1e-6),
      random.WideMagnitude(limit[0], limit[1]),
      random.Integer(0, 3) ? -0.0 : random.Uniform(-1.0, 1.0) };
    corners[i] = values[kind];
  }
  return corners;
}

/// Some equal to the isovalue, the others on both sides of it.
CellCorners CornersAround(RandomNumbers& random, double isovalue)
{
  CellCorners corners;
  for (double& value : corners)
  {
    value = random.Integer(0, 5) ? isovalue * random.Uniform(-1.0, 3.0) : isovalue;
  }
  return corners;
}

/// The kernels may leave a cell to others only where a coefficient of its cubic is extreme.
bool MayBeExtreme(const Ray& ray, const Index3& cell, const CellCorners& differences)
{
  CellSegment segment;
  SegmentInCell(ray, cell, segment);
  double size = 0.0;
  for (const double coefficient : CubicAlongSegment(differences, segment.Entry, segment.Exit))
  {
    size = std::max(size, std::abs(coefficient));
  }
  return !(size >= 1e-100 && size <= 1e100);
}

/// Calls a kernel for cells, and compares its results for each.
class HitChecks
{
public:
  HitChecks(const Kernels& kernels, const ScaledIsovalue& isovalue)
    : TheKernels(kernels)
    , Isovalue(isovalue)
  {
  }

  ~HitChecks()
  {
    std::cout << "[ tried    ] isovalue " << this->Isovalue.Isovalue << ": " << this->Roots
              << " cells with a root, " << this->None << " without, " << this->Extremes
              << " left to others\n";
  }

  HitChecks(const HitChecks&) = delete;
  HitChecks& operator=(const HitChecks&) = delete;

  void Check(RandomNumbers& random, const RayPacket& packet, const std::vector<Query>& queries)
  {
    for (std::size_t first = 0; first < queries.size();)
    {
      // Any number of cells at once, so that every lane is the last one at some time.
      const auto count = std::min<std::size_t>(
        random.Integer(0, 3) ? random.Integer(1, 20) : random.Integer(64, Candidates::Batch + 16),
        queries.size() - first);
      ASSERT_NO_FATAL_FAILURE(this->CheckSome(packet, &queries[first], count));
      first += count;
    }
  }

  std::size_t Roots = 0;
  std::size_t Several = 0;
  std::size_t None = 0;
  std::size_t Extremes = 0;

private:
  void CheckSome(const RayPacket& packet, const Query* queries, std::size_t count)
  {
    Candidates candidates = {};
    candidates.Count = static_cast<int>(count);
    for (std::size_t i = 0; i < count; ++i)
    {
      candidates.Ray[i] = queries[i].Ray;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        candidates.Cell[axis][i] = queries[i].Cell[axis];
      }
      for (std::size_t corner = 0; corner < 8; ++corner)
      {
        candidates.Corners[corner][i] = queries[i].Corners[corner];
      }
    }
    // Elements behind the last candidate must still have a valid ray.
    std::fill_n(candidates.Ray + count, 16, queries[0].Ray);
    Solutions solutions;
    std::memset(&solutions, 0xFF, sizeof(solutions)); // all numbers are none
    this->TheKernels.Solve(packet, candidates, nullptr, this->Isovalue, solutions);
    const auto has = [](const std::uint64_t* words, std::size_t i)
    { return (words[i / 64] >> (i % 64) & 1) != 0; };
    for (std::size_t i = 0; i < count; ++i)
    {
      const Query& query = queries[i];
      const Ray ray = GetRay(packet, query.Ray);
      const CellCorners differences = Differences(query.Corners, this->Isovalue);
      if (has(solutions.Extreme, i))
      {
        ++this->Extremes;
        ASSERT_TRUE(MayBeExtreme(ray, query.Cell, differences));
        ASSERT_FALSE(has(solutions.Found, i));
        continue;
      }
      const MaybeRoot root = ExpectRoot(ray, query.Cell, differences);
      ASSERT_EQ(has(solutions.Found, i), root.has_value());
      (root ? this->Roots : this->None) += 1;
      if (root)
      {
        ASSERT_NO_FATAL_FAILURE(CheckRoot(solutions, i, *root));
        ASSERT_EQ(has(solutions.Entering, i), root->Entering);
        ASSERT_EQ(has(solutions.Further, i), !root->IsOnly);
        this->Several += root->IsOnly ? 0 : 1;
      }
    }
    for (std::size_t i = count; i < 64 * Solutions::Words; ++i)
    {
      ASSERT_FALSE(
        has(solutions.Found, i) || has(solutions.Further, i) || has(solutions.Extreme, i));
    }
  }

  static void CheckRoot(const Solutions& solutions, std::size_t i, const FirstRoot& root)
  {
    ASSERT_TRUE(AreSameBits(solutions.Begin[i], root.Begin.T));
    ASSERT_EQ(solutions.BeginAxis[i], root.Begin.Axis);
    ASSERT_TRUE(AreSameBits(solutions.T[i], root.T)) << root.T;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_TRUE(AreSameBits(solutions.Parametric[axis][i], root.Parametric[axis]));
    }
  }

  const Kernels& TheKernels;
  ScaledIsovalue Isovalue;
};

//------------------------------------------------------------------------------
TEST_P(CellKernels, FirstRootsMatchTheRobustSolver)
{
  RandomNumbers random(842);
  for (const ScaledIsovalue& isovalue : { ScaledIsovalue{ 0.0, 1.0 }, { 100.25, 1.0 },
         { -3.0, 1.0 }, { 1e-300, 0x1p900 }, { 3e300, 0x1p-998 }, { 0x1p-905, 1.0 } })
  {
    const bool isZero = isovalue.Isovalue == 0.0;
    HitChecks checks(this->TheKernels, isovalue);
    for (int i = 0; i < (isZero ? 4000 : 150); ++i)
    {
      RayPacket packet = EmptyPacket();
      std::vector<Query> queries;
      const int rays = random.Integer(1, RayPacket::Capacity);
      const auto cellsOfRay = static_cast<std::size_t>(random.Integer(1, 10));
      for (int k = 0; k < rays; ++k)
      {
        const auto ray = RandomRay(random);
        AppendRay(ray, packet);
        const std::vector<Index3> passed =
          ray ? CellsOnRay(*ray, Dimensions) : std::vector<Index3>();
        const std::size_t first = ray ? random.Bits() % passed.size() : 0;
        for (std::size_t n = first; n < std::min(first + cellsOfRay, passed.size()); ++n)
        {
          Index3 cell = passed[n];
          if (random.Integer(0, 4) == 0)
          {
            cell[random.Bits() % 3] += random.Integer(-1, 1);
          }
          queries.push_back(
            { k, cell, isZero ? RandomCorners(random) : CornersAround(random, isovalue.Isovalue) });
        }
      }
      for (std::size_t k = queries.size(); k > 1; --k)
      {
        std::swap(queries[k - 1], queries[random.Bits() % k]);
      }
      ASSERT_NO_FATAL_FAILURE(checks.Check(random, packet, queries)) << i;
    }
    EXPECT_GT(checks.Roots + checks.Extremes, isZero ? 100000U : 5000U);
    EXPECT_GE(checks.Several, isZero ? 1000U : 0U);
    EXPECT_GT(checks.None, isZero ? 300000U : 10000U);
    EXPECT_TRUE(!isZero || checks.Extremes > 10000U);
  }
}

}
}
