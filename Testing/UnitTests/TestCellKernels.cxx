// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The cells that the kernels find for a ray must hold all it passes, as the walk from cell to cell
// knows them; and the roots in cells must be those of the robust solver, to the last bit.

#include "AllKernels.h"
#include "BlockMask.h"
#include "CellSegment.h"
#include "CellTraversal.h"
#include "RandomNumbers.h"
#include "RayGroup.h"
#include "RobustSolver.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
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

constexpr double Infinity = std::numeric_limits<double>::infinity();

class CellKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, CellKernels, AllKernels(), NameOfKernels);

std::vector<Index3> PassedCells(const Ray& ray, const Index3& dimensions)
{
  std::vector<Index3> cells;
  TraverseCells(ray, ActiveMacrocells(MacrocellLattice(dimensions, {})),
    [&cells](const Index3& cell)
    {
      cells.push_back(cell);
      return false;
    });
  return cells;
}

RayGroup EmptyGroup()
{
  RayGroup group;
  group.Count = 0;
  group.Exists = {};
  return group;
}

//------------------------------------------------------------------------------
enum class LineKind
{
  Any,
  AlongAxis,
  BesidePlane,
  InFace,
  ThroughVertices,
  Diagonal,
  FromAfar
};
constexpr LineKind AllLineKinds[] = { LineKind::Any, LineKind::AlongAxis, LineKind::BesidePlane,
  LineKind::InFace, LineKind::ThroughVertices, LineKind::Diagonal, LineKind::FromAfar };

/// A line that goes up or down an axis, and not steeply away from it.
Line LineAlong(RandomNumbers& random, LineKind kind, std::size_t axis, double sign, const Index3& n)
{
  Line line;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const bool isWhole = kind == LineKind::BesidePlane || kind == LineKind::ThroughVertices ||
      kind == LineKind::Diagonal || (kind == LineKind::InFace && i != axis);
    line.Origin[i] = isWhole ? random.Integer(0, n[i] - 1) : random.Uniform(0.0, n[i] - 1.0);
    line.Direction[i] = random.Uniform(-1.9, 1.9);
  }
  const std::size_t u = (axis + 1) % 3;
  const std::size_t v = (axis + 2) % 3;
  line.Direction[axis] = 1.0;
  const double tiny[] = { 1e-3, -1e-3, 1e-9, -1e-9, 1e-15, 0.0 };
  switch (kind)
  {
    case LineKind::AlongAxis:
      line.Direction[u] = line.Direction[v] = 0.0;
      break;
    case LineKind::BesidePlane:
      line.Direction[u] = line.Direction[v] = 0.0;
      line.Direction[random.Integer(0, 1) ? u : v] = tiny[random.Integer(0, 5)];
      line.Origin[u] += tiny[random.Integer(0, 5)];
      line.Origin[v] += tiny[random.Integer(0, 5)];
      break;
    case LineKind::InFace:
      line.Direction[random.Integer(0, 1) ? u : v] = 0.0;
      break;
    case LineKind::ThroughVertices:
      line.Direction[u] = 0.5 * random.Integer(-3, 3);
      line.Direction[v] = 0.25 * random.Integer(-7, 7);
      break;
    case LineKind::Diagonal:
      line.Direction[u] = random.Integer(0, 1) ? 1.0 : -1.0;
      line.Direction[v] = random.Integer(0, 1) ? 1.0 : -1.0;
      break;
    default:
      break;
  }
  line.Direction = line.Direction * (sign * random.Uniform(0.5, 2.0));
  line.Origin = line.Origin - line.Direction * (kind == LineKind::FromAfar ? 1e6 : 5.0);
  return line;
}

/// What a kernel found for the rays in a block, slice by slice.
struct FoundCells
{
  int Ray;
  std::uint64_t Slices[8];
};

std::vector<FoundCells> FindCells(const Kernels& kernels, const RayGroup& group, const RaySet& rays,
  int axis, const Index3& block, const BlockMask& mask)
{
  const int first[3] = { 8 * block[0], 8 * block[1], 8 * block[2] };
  BlockCells cells;
  kernels.FindCells(group, rays, axis, first, mask.Slices[axis], cells);
  std::vector<FoundCells> found;
  for (int i = 0; i < cells.Count; ++i)
  {
    unsigned int slices = 0;
    FoundCells ofRay = { cells.Ray[i], {} };
    for (int slice = 0; slice < 8; ++slice)
    {
      ofRay.Slices[slice] = cells.Cells[i][slice];
      slices |= (ofRay.Slices[slice] != 0 ? 1U : 0U) << slice;
    }
    EXPECT_EQ(cells.Slices[i], slices);
    EXPECT_NE(slices, 0U);
    found.push_back(ofRay);
  }
  return found;
}

/// The cells of a volume in a block, or some of them.
BlockMask MakeMask(RandomNumbers& random, const Index3& block, const Index3& dimensions, bool all)
{
  BlockMask mask = {};
  ForEachPlace({ 8, 8, 8 },
    [&](const Index3& i)
    {
      bool isIn = all || random.Integer(0, 2) == 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn = isIn && 8 * block[axis] + i[axis] < dimensions[axis] - 1;
      }
      mask.Slices[2][i[2]] |= std::uint64_t{ isIn } << (i[0] + 8 * i[1]);
    });
  mask.CompleteSlices();
  return mask;
}

/// Compares the cells found for a group in all blocks with those passed, and counts.
class CellChecks
{
public:
  explicit CellChecks(const Kernels& kernels)
    : TheKernels(kernels)
  {
  }

  void Check(RandomNumbers& random, RayGroup& group, const RaySet& rays, int axis,
    const Index3& dimensions, bool all)
  {
    Beam beam;
    ASSERT_TRUE(this->TheKernels.Align(group, rays, axis, beam));
    std::vector<std::set<Index3>> left(RayGroup::Capacity);
    for (int i = 0; i < group.Count; ++i)
    {
      if (Has(rays, i))
      {
        const std::vector<Index3> passed = PassedCells(GetRay(group, i), dimensions);
        left[static_cast<std::size_t>(i)].insert(passed.begin(), passed.end());
        this->Passed += all ? passed.size() : 0;
        ++this->Rays;
      }
    }
    ForEachPlace(BlocksCovering({ dimensions[0] - 1, dimensions[1] - 1, dimensions[2] - 1 }, 8),
      [&](const Index3& block)
      {
        const BlockMask mask = MakeMask(random, block, dimensions, all);
        RaySet seen = {};
        for (const FoundCells& found : FindCells(this->TheKernels, group, rays, axis, block, mask))
        {
          ASSERT_TRUE(Has(rays, found.Ray));
          ASSERT_FALSE(Has(seen, found.Ray));
          Add(found.Ray, seen);
          this->Take(found, axis, block, mask, left[static_cast<std::size_t>(found.Ray)], all);
        }
        // What is left must not have been asked for.
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

  /// How many cells were found for one that is passed.
  double GetExcess() const
  {
    return static_cast<double>(this->Found) / static_cast<double>(this->Passed);
  }

  std::size_t GetNumberOfRays() const { return this->Rays; }

private:
  void Take(const FoundCells& found, int axis, const Index3& block, const BlockMask& mask,
    std::set<Index3>& left, bool all)
  {
    for (int slice = 0; slice < 8; ++slice)
    {
      ASSERT_EQ(found.Slices[slice] & ~mask.Slices[axis][slice], 0U);
      for (int bit = 0; bit < 64; ++bit)
      {
        if (found.Slices[slice] >> bit & 1)
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
  std::size_t Rays = 0;
  std::size_t Passed = 0;
  std::size_t Found = 0;
};

//------------------------------------------------------------------------------
TEST_P(CellKernels, FindAllCellsThatRaysPassAndNotManyMore)
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
      RayGroup group = EmptyGroup();
      RaySet rays = {};
      const int count = random.Integer(1, i % 3 == 0 ? 128 : 20);
      for (int k = 0; k < count; ++k)
      {
        const Line line = LineAlong(random, kind, static_cast<std::size_t>(axis), sign, dimensions);
        const double end = random.Integer(0, 4) ? Infinity : random.Uniform(0.0, 40.0);
        const auto ray = ClipToVolume(line.Origin, line.Direction, 0.0, end, dimensions);
        AddRay(ray, group);
        if (ray && random.Integer(0, 4))
        {
          Add(k, rays);
        }
      }
      if (!IsEmpty(rays))
      {
        ASSERT_NO_FATAL_FAILURE(
          checks.Check(random, group, rays, axis, dimensions, random.Integer(0, 3) != 0));
      }
    }
    std::cout << "[ tried    ] kind " << static_cast<int>(kind) << ": " << checks.GetNumberOfRays()
              << " rays, " << checks.GetExcess() << " cells found for one that is passed\n";
    EXPECT_GT(checks.GetNumberOfRays(), 500U);
    // Through vertices and in faces, the cells on all sides are as near.
    const bool isOnLattice = kind == LineKind::BesidePlane || kind == LineKind::InFace ||
      kind == LineKind::ThroughVertices || kind == LineKind::Diagonal;
    EXPECT_LT(checks.GetExcess(), isOnLattice ? 4.0 : 1.5);
  }
}

//------------------------------------------------------------------------------
/// A ray and a cell that it passes, or comes near to.
struct RayAndCell
{
  Ray TheRay;
  Index3 Cell;
};

std::optional<RayAndCell> RandomRayAndCell(RandomNumbers& random)
{
  const Index3 dimensions = { 9, 10, 8 };
  Line line =
    random.Integer(0, 2) ? RandomLine(random, dimensions) : LatticeLine(random, dimensions);
  if (random.Integer(0, 9) == 0)
  {
    line.Origin = line.Origin - line.Direction * 1e9;
  }
  const double begin = random.Integer(0, 3) ? 0.0 : random.Uniform(0.0, 10.0);
  const double end = random.Integer(0, 3) ? Infinity : begin + random.Uniform(0.0, 10.0);
  const auto ray = ClipToVolume(line.Origin, line.Direction, begin, end, dimensions);
  if (!ray)
  {
    return std::nullopt;
  }
  const std::vector<Index3> cells = PassedCells(*ray, dimensions);
  Index3 cell = cells[random.Bits() % cells.size()];
  if (random.Integer(0, 4) == 0)
  {
    cell[random.Bits() % 3] += random.Integer(-1, 1);
  }
  return RayAndCell{ *ray, cell };
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
    // A parabola along x + y + z that all but touches zero.
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

struct FirstRoot
{
  bool IsExtreme;
  double Begin;
  int BeginAxis;
  double T;
  Vector3 Parametric;
  bool Rising;
};

using MaybeRoot = std::optional<FirstRoot>;

/// What the reference has to say.
MaybeRoot ExpectRoot(const RayAndCell& pair, const CellCorners& difference)
{
  CellSegment segment;
  if (!SegmentInCell(pair.TheRay, pair.Cell, segment))
  {
    return std::nullopt;
  }
  MaybeRoot root;
  Robust::ForEachRoot(difference, segment,
    [&](double u, bool rising)
    {
      const double t = segment.Begin + (segment.End - segment.Begin) * u;
      root = FirstRoot{ false, segment.Begin, segment.BeginAxis,
        pair.TheRay.Base + std::min(t, segment.End), {}, rising };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        root->Parametric[axis] = Lerp(segment.Entry[axis], segment.Exit[axis], u);
      }
      return true;
    });
  return root;
}

/// The kernels may leave a cell to others only where a coefficient of its cubic is extreme.
bool MayBeExtreme(const RayAndCell& pair, const CellCorners& difference)
{
  CellSegment segment;
  SegmentInCell(pair.TheRay, pair.Cell, segment);
  const BernsteinCubic cubic = CubicAlongSegment(difference, segment.Entry, segment.Exit);
  double size = 0.0;
  for (const double coefficient : cubic)
  {
    size = std::max(size, std::abs(coefficient));
  }
  return !(size >= 1e-100 && size <= 1e100);
}

/// The first root in each of some cells, by a kernel; each cell has a ray of its own.
std::vector<MaybeRoot> FindFirstRoots(const Kernels& kernels, const std::vector<RayAndCell>& pairs,
  const std::vector<CellCorners>& corners, const ScaledIsovalue& isovalue)
{
  RayGroup group = EmptyGroup();
  Candidates candidates = {};
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    AddRay(pairs[i].TheRay, group);
    candidates.Ray[i] = static_cast<int>(i);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      candidates.Cell[axis][i] = pairs[i].Cell[axis];
    }
    for (std::size_t corner = 0; corner < 8; ++corner)
    {
      candidates.Corners[corner][i] = corners[i][corner];
    }
    ++candidates.Count;
  }
  FirstRoots roots;
  kernels.FindFirstRoots(group, candidates, isovalue, roots);
  std::vector<MaybeRoot> result(pairs.size());
  for (int i = 0; i < roots.Count; ++i)
  {
    MaybeRoot& root = result.at(static_cast<std::size_t>(roots.Candidate[i]));
    EXPECT_FALSE(root);
    root = FirstRoot{ false, roots.Begin[i], static_cast<int>(roots.BeginAxis[i]), roots.T[i],
      { roots.Parametric[0][i], roots.Parametric[1][i], roots.Parametric[2][i] }, roots.Rising[i] };
  }
  for (int i = 0; i < roots.ExtremeCount; ++i)
  {
    MaybeRoot& root = result.at(static_cast<std::size_t>(roots.Extreme[i]));
    EXPECT_FALSE(root);
    root = FirstRoot{ true, 0.0, 0, 0.0, {}, false };
  }
  return result;
}

/// Compares roots one by one, and counts.
class RootChecks
{
public:
  ~RootChecks()
  {
    std::cout << "[ tried    ] " << this->Roots << " roots, " << this->None << " cells without, "
              << this->Extremes << " left to others\n";
  }

  void Check(const MaybeRoot& found, const RayAndCell& pair, const CellCorners& difference)
  {
    const MaybeRoot expected = ExpectRoot(pair, difference);
    if (found && found->IsExtreme)
    {
      ++this->Extremes;
      ASSERT_TRUE(MayBeExtreme(pair, difference));
      return;
    }
    ASSERT_EQ(found.has_value(), expected.has_value());
    if (!found)
    {
      ++this->None;
      return;
    }
    ++this->Roots;
    ASSERT_TRUE(AreSameBits(found->Begin, expected->Begin));
    ASSERT_EQ(found->BeginAxis, expected->BeginAxis);
    ASSERT_TRUE(AreSameBits(found->T, expected->T)) << found->T << " " << expected->T;
    ASSERT_EQ(found->Rising, expected->Rising);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      ASSERT_TRUE(AreSameBits(found->Parametric[axis], expected->Parametric[axis]));
    }
  }

  std::size_t Roots = 0;
  std::size_t None = 0;
  std::size_t Extremes = 0;
};

// Any number of cells, so that all lanes come last.
TEST_P(CellKernels, FindTheFirstRootsOfTheRobustSolver)
{
  RandomNumbers random(842);
  RootChecks checks;
  for (int i = 0; i < 20000; ++i)
  {
    const int count = i % 20 == 0 ? Candidates::Batch : 1 + i % 17;
    std::vector<RayAndCell> pairs;
    std::vector<CellCorners> corners;
    for (int k = 0; k < count; ++k)
    {
      if (const auto pair = RandomRayAndCell(random))
      {
        pairs.push_back(*pair);
        corners.push_back(RandomCorners(random));
      }
    }
    const std::vector<MaybeRoot> roots =
      FindFirstRoots(this->TheKernels, pairs, corners, { 0.0, 1.0 });
    for (std::size_t k = 0; k < pairs.size(); ++k)
    {
      // Smaller differences than this are made larger before; see SmallestDifference.
      CellCorners difference = corners[k];
      for (double& value : difference)
      {
        const bool vanishes = std::abs(value) < SmallestDifference && value != 0.0;
        value = vanishes ? std::copysign(SmallestDifference, value) : value;
      }
      ASSERT_NO_FATAL_FAILURE(checks.Check(roots[k], pairs[k], difference)) << i << ", " << k;
    }
  }
  EXPECT_GT(checks.Roots, 20000U);
  EXPECT_GT(checks.None, 30000U);
  EXPECT_GT(checks.Extremes, 1000U);
}

//------------------------------------------------------------------------------
TEST_P(CellKernels, TakeOffTheIsovalueAndScale)
{
  RandomNumbers random(843);
  RootChecks checks;
  for (const ScaledIsovalue& isovalue : { ScaledIsovalue{ 100.25, 1.0 }, { -3.0, 1.0 },
         { 1e-300, 0x1p900 }, { 3e300, 0x1p-998 }, { 0x1p-905, 1.0 } })
  {
    for (int i = 0; i < 3000; ++i)
    {
      std::vector<RayAndCell> pairs;
      std::vector<CellCorners> corners;
      while (pairs.size() < 9)
      {
        if (const auto pair = RandomRayAndCell(random))
        {
          pairs.push_back(*pair);
          corners.emplace_back();
          for (double& value : corners.back())
          {
            value = random.Integer(0, 5) ? isovalue.Isovalue * random.Uniform(-1.0, 3.0)
                                         : isovalue.Isovalue;
          }
        }
      }
      const std::vector<MaybeRoot> roots =
        FindFirstRoots(this->TheKernels, pairs, corners, isovalue);
      for (std::size_t k = 0; k < pairs.size(); ++k)
      {
        CellCorners difference;
        for (std::size_t corner = 0; corner < 8; ++corner)
        {
          const double value = corners[k][corner];
          const double plain = value * isovalue.Scale - isovalue.Isovalue * isovalue.Scale;
          const double sign = (value > isovalue.Isovalue) - (value < isovalue.Isovalue);
          difference[corner] =
            std::abs(plain) < SmallestDifference ? sign * SmallestDifference : plain;
        }
        ASSERT_NO_FATAL_FAILURE(checks.Check(roots[k], pairs[k], difference));
      }
    }
  }
  EXPECT_GT(checks.Roots, 20000U);
}

}
}
