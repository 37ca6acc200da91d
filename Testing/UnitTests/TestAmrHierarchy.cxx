// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Levels of refined grids whose samples disagree: their interpolants must meet all the same, and no
// ray may slip through a surface where they do.

#include "Amr/AmrHierarchy.h"
#include "Field/FieldSet.h"
#include "Image/ImageField.h"
#include "Matrices.h"
#include "Picture/CastRays.h"
#include "RandomNumbers.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

struct Box
{
  int Level;
  Index3 First;
  Index3 Cells;
};

/// Without samples.
AmrPatch MakePatch(const Box& box)
{
  AmrPatch patch{};
  patch.Level = box.Level;
  patch.First = box.First;
  patch.Cells = box.Cells;
  return patch;
}

/// A hierarchy of patches with samples of a ball, each with errors of its own level; and its
/// regions of a size, whose boxes these are then.
class Grids
{
public:
  Grids(std::vector<Index3> ratios, const std::vector<Box>& boxes, bool ofCells, double noise,
    int cellsOfRegion = 1)
    : Ratios(std::move(ratios))
    , NodesOfCell(ofCells ? 2 : 1)
  {
    Vector3 size = { 1.0, 1.0, 1.0 };
    for (std::size_t level = 0; level < this->Ratios.size(); ++level)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        size[axis] /= level > 0 ? this->Ratios[level][axis] : 1;
      }
      this->Sizes.push_back(size);
    }
    std::vector<AmrPatch> patches;
    for (const Box& box : boxes)
    {
      const Vector3& cell = this->Sizes[static_cast<std::size_t>(box.Level)];
      Index3 dimensions = box.Cells;
      for (int& dimension : dimensions)
      {
        dimension += ofCells ? 0 : 1;
      }
      this->Volumes.push_back(TestVolume<float>::Of(dimensions,
        [&](const Vector3& index)
        {
          Vector3 point;
          std::uint64_t hash = 1469598103934665603ULL + static_cast<std::uint64_t>(box.Level);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            const double place = index[axis] + box.First[axis];
            point[axis] = (place + (ofCells ? 0.5 : 0.0)) * cell[axis];
            hash = (hash ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(place) + 1000)) *
              1099511628211ULL;
          }
          hash ^= hash >> 31;
          return 2.7 - Length(point - Vector3{ 4.0, 4.0, 4.0 }) +
            noise * (static_cast<double>(hash % 2001) / 1000.0 - 1.0);
        }));
      patches.push_back(MakePatch(box));
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      patches[i].Samples = this->Volumes[i].View();
    }
    this->Hierarchy = std::make_unique<AmrHierarchy>(this->Ratios, patches, ofCells);
    this->Regions = this->Hierarchy->MakeRegions(cellsOfRegion);
    for (const AmrRegion& region : this->Regions)
    {
      this->Boxes.push_back({ region.Level, region.First, region.Cells });
      this->Nodes.push_back(this->Hierarchy->MakeNodes(region));
    }
  }

  std::size_t GetNumberOfRegions() const { return this->Boxes.size(); }

  /// The place of a point among the nodes of a region.
  Vector3 ToNodes(std::size_t number, const Vector3& point) const
  {
    const Box& box = this->Boxes[number];
    Vector3 place;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      place[axis] = 1.0 +
        this->NodesOfCell *
          (point[axis] / this->Sizes[static_cast<std::size_t>(box.Level)][axis] - box.First[axis]);
    }
    return place;
  }

  Matrix4 GetWorldFromSamples(std::size_t number) const
  {
    const Box& box = this->Boxes[number];
    Matrix4 matrix = Scaling({ 1.0, 1.0, 1.0 });
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double node =
        this->Sizes[static_cast<std::size_t>(box.Level)][axis] / this->NodesOfCell;
      matrix[5 * axis] = node;
      matrix[4 * axis + 3] = node * (this->NodesOfCell * box.First[axis]);
    }
    return matrix;
  }

  /// The region whose cell counts at a point: none outside.
  int FindLeaf(const Vector3& point) const
  {
    int leaf = -1;
    for (std::size_t i = 0; i < this->Boxes.size(); ++i)
    {
      const Vector3 place = this->ToNodes(i, point);
      bool isIn = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn = isIn && place[axis] >= 1.0 &&
          place[axis] < 1.0 + this->NodesOfCell * this->Boxes[i].Cells[axis];
      }
      if (isIn &&
        (leaf < 0 || this->Boxes[i].Level > this->Boxes[static_cast<std::size_t>(leaf)].Level))
      {
        leaf = static_cast<int>(i);
      }
    }
    return leaf;
  }

  /// The interpolant of a region, in a cell of nodes that a point near by is in.
  double Interpolate(std::size_t number, const Vector3& point, const Vector3& inCell) const
  {
    const AmrNodes& nodes = this->Nodes[number];
    const Vector3 place = this->ToNodes(number, point);
    const Vector3 near = this->ToNodes(number, inCell);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      Index3 node;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double first = std::floor(near[axis]);
        const bool isUpper = (corner >> axis & 1) != 0;
        weight *= isUpper ? place[axis] - first : 1.0 - (place[axis] - first);
        node[axis] = static_cast<int>(first) + (isUpper ? 1 : 0);
      }
      sum += weight * nodes.Values[Offset(node, nodes.Dimensions)];
    }
    return sum;
  }

  bool IsHidden(std::size_t number, const Vector3& point) const
  {
    const AmrNodes& nodes = this->Nodes[number];
    const Vector3 place = this->ToNodes(number, point);
    const Index3 cells = { nodes.Dimensions[0] - 2, nodes.Dimensions[1] - 2,
      nodes.Dimensions[2] - 2 };
    return !nodes.HiddenCells.empty() &&
      nodes.HiddenCells[Offset({ static_cast<int>(place[0]) - 1, static_cast<int>(place[1]) - 1,
                                 static_cast<int>(place[2]) - 1 },
        cells)] != 0;
  }

  /// A place of a corner of a cell, an edge or a face of a region, or inside of it.
  Vector3 PickPlace(RandomNumbers& random, int free) const
  {
    const auto number =
      static_cast<std::size_t>(random.Integer(0, static_cast<int>(this->Boxes.size()) - 1));
    const Box& box = this->Boxes[number];
    Vector3 point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double size = this->Sizes[static_cast<std::size_t>(box.Level)][axis];
      double place = random.Integer(0, box.Cells[axis]);
      if (static_cast<int>(axis) < free)
      {
        place = random.Uniform(0.0, box.Cells[axis]);
      }
      else if (random.Integer(0, 1) == 0)
      {
        place = random.Integer(0, 1) * box.Cells[axis];
      }
      point[axis] = (box.First[axis] + place) * size;
    }
    std::rotate(point.begin(), point.begin() + random.Integer(0, 2), point.end());
    return point;
  }

  std::vector<Index3> Ratios;
  std::vector<Box> Boxes;
  int NodesOfCell;
  std::vector<Vector3> Sizes;
  std::vector<TestVolume<float>> Volumes;
  std::unique_ptr<AmrHierarchy> Hierarchy;
  std::vector<AmrRegion> Regions;
  std::vector<AmrNodes> Nodes;
};

/// Three levels, by 2 and by 3; patches that touch at faces, edges and corners, some of which fill
/// boxes, and levels that differ by two where they meet.
std::vector<Box> MakeBoxes()
{
  return { { 0, { 0, 0, 0 }, { 8, 8, 4 } }, { 0, { 0, 0, 4 }, { 8, 8, 4 } },
    { 1, { 4, 2, 2 }, { 4, 2, 6 } }, { 1, { 8, 2, 2 }, { 4, 4, 8 } },
    { 1, { 2, 2, 2 }, { 2, 6, 6 } }, { 1, { 8, 8, 8 }, { 6, 4, 4 } },
    { 1, { 4, 10, 2 }, { 4, 4, 2 } }, { 1, { 4, 4, 2 }, { 4, 4, 6 } },
    { 2, { 6, 6, 6 }, { 9, 6, 6 } }, { 2, { 6, 12, 6 }, { 9, 6, 6 } },
    { 2, { 15, 9, 6 }, { 9, 6, 6 } }, { 2, { 30, 24, 24 }, { 12, 6, 12 } } };
}

const std::vector<Index3> TheRatios = { { 1, 1, 1 }, { 2, 2, 2 }, { 3, 3, 3 } };

/// Of cells or of points; and the size of regions.
class AmrSamples : public testing::TestWithParam<std::tuple<bool, int>>
{
protected:
  static Grids MakeGrids(double noise)
  {
    return { TheRatios, MakeBoxes(), std::get<0>(GetParam()), noise, std::get<1>(GetParam()) };
  }
};

//------------------------------------------------------------------------------
TEST_P(AmrSamples, InterpolantsMeet)
{
  const Grids grids = MakeGrids(0.5);
  RandomNumbers random(11);
  int different = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3 point = grids.PickPlace(random, i % 3);
    double first = 0.0;
    int leaves = 0;
    int firstLeaf = -1;
    for (int side = 0; side < 8; ++side)
    {
      constexpr double step = 1e-7;
      Vector3 beside = point;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        beside[axis] += (side >> axis & 1) != 0 ? step : -step;
      }
      const int leaf = grids.FindLeaf(beside);
      if (leaf < 0)
      {
        continue;
      }
      const auto number = static_cast<std::size_t>(leaf);
      EXPECT_FALSE(grids.IsHidden(number, beside));
      const double value = grids.Interpolate(number, point, beside);
      if (leaves++ == 0)
      {
        first = value;
        firstLeaf = leaf;
      }
      different += leaf != firstLeaf ? 1 : 0;
      ASSERT_NEAR(value, first, 1e-13) << point[0] << " " << point[1] << " " << point[2];
    }
  }
  EXPECT_GT(different, 10000);
}

//------------------------------------------------------------------------------
/// The values of the interpolant in a region are in the range that is known before.
TEST_P(AmrSamples, RangesHoldAllValues)
{
  const Grids grids = MakeGrids(0.5);
  double widest = 0.0;
  for (std::size_t i = 0; i < grids.GetNumberOfRegions(); ++i)
  {
    const AmrRange range = grids.Hierarchy->FindRange(grids.Regions[i]);
    const AmrNodes& nodes = grids.Nodes[i];
    AmrRange actual;
    Index3 node;
    for (node[2] = 1; node[2] < nodes.Dimensions[2]; ++node[2])
    {
      for (node[1] = 1; node[1] < nodes.Dimensions[1]; ++node[1])
      {
        for (node[0] = 1; node[0] < nodes.Dimensions[0]; ++node[0])
        {
          // With the layer behind the region, but not what continues the data there.
          const std::size_t place = Offset(node, nodes.Dimensions);
          if (std::find(nodes.Continued.begin(), nodes.Continued.end(), place) !=
            nodes.Continued.end())
          {
            continue;
          }
          const double value = nodes.Values[place];
          actual.Min = std::min(actual.Min, value);
          actual.Max = std::max(actual.Max, value);
        }
      }
    }
    EXPECT_LE(range.Min, actual.Min);
    EXPECT_GE(range.Max, actual.Max);
    // Cells beside the region are a small part of the data.
    EXPECT_LT(range.Max - range.Min, 12.0);
    widest = std::max(widest, (range.Max - range.Min) / (actual.Max - actual.Min));
  }
  EXPECT_LT(widest, 5.0);
}

//------------------------------------------------------------------------------
TEST_P(AmrSamples, FinerCellsCount)
{
  const Grids grids = MakeGrids(0.0);
  RandomNumbers random(12);
  for (int i = 0; i < 5000; ++i)
  {
    const Vector3 point = { random.Uniform(0.0, 8.0), random.Uniform(0.0, 8.0),
      random.Uniform(0.0, 8.0) };
    const int leaf = grids.FindLeaf(point);
    for (std::size_t number = 0; number < grids.GetNumberOfRegions(); ++number)
    {
      const Box& box = grids.Boxes[number];
      const Vector3 place = grids.ToNodes(number, point);
      bool isIn = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        isIn =
          isIn && place[axis] >= 1.0 && place[axis] < 1.0 + grids.NodesOfCell * box.Cells[axis];
      }
      if (isIn)
      {
        EXPECT_EQ(grids.IsHidden(number, point), static_cast<int>(number) != leaf);
      }
    }
  }
}

//------------------------------------------------------------------------------
/// A region of a level.
class Source final : public FieldSource
{
public:
  Source(const Grids& grids, std::size_t number)
    : Nodes(grids.Nodes[number])
    , Field(ImageField::New(this->Nodes.GetSamples(), {}, 1))
  {
  }

  TracedField& GetField() override { return *this->Field; }
  Visibility FindVisible() const override
  {
    Visibility visible;
    visible.HiddenCells =
      this->Nodes.HiddenCells.empty() ? nullptr : this->Nodes.HiddenCells.data();
    return visible;
  }

private:
  const AmrNodes& Nodes;
  std::unique_ptr<ImageField> Field;
};

struct Traced
{
  explicit Traced(const Grids& grids)
  {
    std::vector<PlacedField> placed;
    for (std::size_t i = 0; i < grids.GetNumberOfRegions(); ++i)
    {
      this->Sources.push_back(std::make_unique<Source>(grids, i));
      PlacedField field{};
      field.Source = this->Sources.back().get();
      field.SetFromOwn = grids.GetWorldFromSamples(i);
      const Index3& nodes = grids.Nodes[i].Dimensions;
      field.Box = TransformBounds(field.SetFromOwn,
        { { 0.0, 0.0, 0.0 }, { nodes[0] - 3.0, nodes[1] - 3.0, nodes[2] - 3.0 } });
      field.IsSeamless = true;
      placed.push_back(field);
    }
    this->Set = std::make_unique<FieldSet>(placed);
  }

  std::vector<std::unique_ptr<Source>> Sources;
  std::unique_ptr<FieldSet> Set;
};

/// Rays from outside, through places where patches meet, or anywhere.
std::vector<CastRay> MakeRays(const Grids& grids, RandomNumbers& random, int count)
{
  std::vector<CastRay> rays;
  for (int i = 0; i < count; ++i)
  {
    const Vector3 through = grids.PickPlace(random, i % 4);
    Vector3 direction = { random.Uniform(-1.0, 1.0), random.Uniform(-1.0, 1.0),
      random.Uniform(-1.0, 1.0) };
    if (i % 5 == 0)
    {
      // Along an axis or in a plane of the lattices.
      direction[static_cast<std::size_t>(random.Integer(0, 2))] = 0.0;
      direction[static_cast<std::size_t>(random.Integer(0, 2))] = 0.0;
    }
    if (i % 7 == 0)
    {
      // From corner to corner.
      direction = grids.PickPlace(random, 0) - through;
    }
    if (Length(direction) > 1e-3)
    {
      direction = direction * (1.0 / Length(direction));
      rays.push_back({ through - direction * 32.0, direction, 0.0, 64.0 });
    }
  }
  return rays;
}

//------------------------------------------------------------------------------
TEST_P(AmrSamples, NoRaySlipsThroughAClosedSurface)
{
  const char* asked = std::getenv("ATTACK_RAYS");
  const int count = asked ? std::atoi(asked) : 200000;
  for (const double noise : { 0.0, 0.35 })
  {
    const Grids grids = MakeGrids(noise);
    Traced traced(grids);
    TraceRequest request;
    request.Surfaces = { { 0.0, 1e-6 } };
    traced.Set->Select(request, {});
    RandomNumbers random(13);
    std::size_t hitting = 0;
    std::size_t slipped = 0;
    const std::vector<CastRay> rays = MakeRays(grids, random, count);
    const RayHits hits = CastRays(*traced.Set, rays, 2);
    for (std::size_t ray = 0; ray < rays.size(); ++ray)
    {
      bool isInside = false;
      bool isClosed = true;
      for (std::size_t i = hits.First[ray]; i < hits.First[ray + 1]; ++i)
      {
        isClosed = isClosed && hits.Hits[i].Entering != isInside;
        isInside = hits.Hits[i].Entering;
      }
      hitting += hits.First[ray] < hits.First[ray + 1] ? 1 : 0;
      slipped += isClosed && !isInside ? 0 : 1;
    }
    EXPECT_GT(hitting, rays.size() / 3);
    EXPECT_EQ(slipped, 0U) << "of " << hitting << ", noise " << noise;
  }
}

INSTANTIATE_TEST_SUITE_P(All, AmrSamples, testing::Combine(testing::Bool(), testing::Values(1, 32)),
  [](const testing::TestParamInfo<std::tuple<bool, int>>& kind)
  {
    return std::string(std::get<0>(kind.param) ? "OfCells" : "OfPoints") +
      (std::get<1>(kind.param) == 1 ? "" : "InRegions");
  });

//------------------------------------------------------------------------------
/// Which patches are traced as one.
std::vector<std::vector<std::size_t>> FindRegions(
  const std::vector<Box>& boxes, int cells, const std::vector<int>& kinds = {})
{
  std::vector<AmrPatch> patches;
  for (const Box& box : boxes)
  {
    AmrPatch patch = MakePatch(box);
    patch.Kind = kinds.empty() ? 0 : kinds[patches.size()];
    patches.push_back(patch);
  }
  const AmrHierarchy hierarchy({ { 1, 1, 1 }, { 2, 2, 2 } }, patches, false);
  std::vector<std::vector<std::size_t>> numbers;
  for (const AmrRegion& region : hierarchy.MakeRegions(cells))
  {
    std::size_t count = 0;
    Index3 cell;
    for (cell[2] = region.First[2]; cell[2] < region.First[2] + region.Cells[2]; ++cell[2])
    {
      for (cell[1] = region.First[1]; cell[1] < region.First[1] + region.Cells[1]; ++cell[1])
      {
        for (cell[0] = region.First[0]; cell[0] < region.First[0] + region.Cells[0]; ++cell[0])
        {
          const std::size_t number = hierarchy.FindPatch(region, cell);
          const Box& box = boxes[number];
          EXPECT_EQ(box.Level, region.Level);
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            EXPECT_GE(cell[axis], box.First[axis]);
            EXPECT_LT(cell[axis], box.First[axis] + box.Cells[axis]);
          }
          EXPECT_EQ(std::count(region.Patches.begin(), region.Patches.end(), number), 1);
          ++count;
        }
      }
    }
    EXPECT_EQ(count, Count(region.Cells));
    numbers.push_back(region.Patches);
    std::sort(numbers.back().begin(), numbers.back().end());
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// The boxes of a lattice of blocks.
std::vector<Box> MakeBlocks(int level, const Index3& first, const Index3& count, int size)
{
  std::vector<Box> boxes;
  for (int i = 0; i < count[0] * count[1] * count[2]; ++i)
  {
    boxes.push_back({ level,
      { first[0] + size * (i % count[0]), first[1] + size * (i / count[0] % count[1]),
        first[2] + size * (i / count[0] / count[1]) },
      { size, size, size } });
  }
  return boxes;
}

using Regions = std::vector<std::vector<std::size_t>>;

//------------------------------------------------------------------------------
TEST(AmrRegions, ArePatchesThatFillABox)
{
  const std::vector<Box> eight = MakeBlocks(0, { 0, 0, 0 }, { 2, 2, 2 }, 8);
  EXPECT_EQ(FindRegions(eight, 16), (Regions{ { 0, 1, 2, 3, 4, 5, 6, 7 } }));
  EXPECT_EQ(FindRegions(eight, 15).size(), 8U);
  EXPECT_EQ(FindRegions(MakeBlocks(0, { -16, -16, -16 }, { 4, 4, 4 }, 8), 16).size(), 8U);
  // Cubes start at the origin.
  EXPECT_EQ(FindRegions(MakeBlocks(0, { 8, 0, 0 }, { 2, 1, 1 }, 8), 16), (Regions{ { 0 }, { 1 } }));
  // One corner is missing.
  const std::vector<Box> seven(eight.begin(), eight.end() - 1);
  EXPECT_EQ(FindRegions(seven, 16), (Regions{ { 0, 2, 4, 6 }, { 1, 5 }, { 3 } }));
  // No plane parts four around a hole.
  const std::vector<Box> wheel = { { 0, { 0, 0, 0 }, { 4, 2, 1 } }, { 0, { 4, 0, 0 }, { 2, 4, 1 } },
    { 0, { 2, 4, 0 }, { 4, 2, 1 } }, { 0, { 0, 2, 0 }, { 2, 4, 1 } } };
  EXPECT_EQ(FindRegions(wheel, 8).size(), 4U);
  std::vector<Box> filled = wheel;
  filled.push_back({ 0, { 2, 2, 0 }, { 2, 2, 1 } });
  EXPECT_EQ(FindRegions(filled, 8), (Regions{ { 0, 1, 2, 3, 4 } }));
}

//------------------------------------------------------------------------------
TEST(AmrRegions, AreOfOneLevelAndOneKind)
{
  std::vector<Box> boxes = MakeBlocks(0, { 0, 0, 0 }, { 2, 1, 1 }, 4);
  const std::vector<Box> finer = MakeBlocks(1, { 4, 0, 0 }, { 2, 1, 1 }, 4);
  boxes.insert(boxes.end(), finer.begin(), finer.end());
  EXPECT_EQ(FindRegions(boxes, 16), (Regions{ { 0, 1 }, { 2, 3 } }));
  EXPECT_EQ(FindRegions(boxes, 16, { 0, 1, 1, 1 }), (Regions{ { 0 }, { 1 }, { 2, 3 } }));
}

//------------------------------------------------------------------------------
TEST(AmrRegions, HaveNoOverlaps)
{
  std::vector<Box> boxes = MakeBlocks(0, { 0, 0, 0 }, { 2, 2, 1 }, 4);
  boxes.push_back({ 0, { 2, 2, 0 }, { 4, 4, 4 } });
  EXPECT_EQ(FindRegions(boxes, 16).size(), 5U);
  // As many cells as their box has.
  EXPECT_EQ(FindRegions({ { 0, { 0, 0, 0 }, { 3, 1, 1 } }, { 0, { 1, 0, 0 }, { 3, 1, 1 } },
                          { 0, { 6, 0, 0 }, { 2, 1, 1 } } },
              16),
    (Regions{ { 0 }, { 1 }, { 2 } }));
}

//------------------------------------------------------------------------------
/// A hidden block among others, and a ghost of which another region has the cells.
TEST(AmrRegions, HideTheCellsOfTheirPatches)
{
  std::vector<AmrPatch> patches;
  std::vector<TestVolume<float>> volumes;
  const std::vector<Box> boxes = MakeBlocks(0, { 0, 0, 0 }, { 2, 2, 1 }, 4);
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    volumes.push_back(TestVolume<float>::Of(
      { 5, 5, 5 }, [i](const Vector3& index) { return index[0] + 10.0 * static_cast<double>(i); }));
  }
  std::vector<unsigned char> flags(64, 0);
  flags[Offset({ 1, 2, 3 }, { 4, 4, 4 })] = 1;
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    AmrPatch patch{};
    patch.First = boxes[i].First;
    patch.Cells = boxes[i].Cells;
    patch.Samples = volumes[i].View();
    patch.HiddenCells = i == 1 ? flags.data() : nullptr;
    patch.GhostCells = i == 2 ? flags.data() : nullptr;
    patches.push_back(patch);
  }
  const AmrHierarchy hierarchy({ { 1, 1, 1 } }, patches, false);
  const std::vector<AmrRegion> regions = hierarchy.MakeRegions(8);
  ASSERT_EQ(regions.size(), 1U);
  const AmrNodes nodes = hierarchy.MakeNodes(regions.front());
  const Index3 cells = { nodes.Dimensions[0] - 2, nodes.Dimensions[1] - 2,
    nodes.Dimensions[2] - 2 };
  ASSERT_EQ(nodes.HiddenCells.size(), Count(cells));
  // Behind both there is nothing but the layer.
  EXPECT_EQ(std::count(nodes.HiddenCells.begin(), nodes.HiddenCells.end(), 0),
    static_cast<std::ptrdiff_t>(Count(cells)) - 4);
  for (const int z : { 3, 4 })
  {
    EXPECT_EQ(nodes.HiddenCells[Offset({ 5, 2, z }, cells)], 1);
    EXPECT_EQ(nodes.HiddenCells[Offset({ 1, 6, z }, cells)], 1);
  }
  // Of nodes that patches share the first has the sample, unless all of its cells there are ghosts.
  const auto at = [&nodes](const Index3& node) {
    return nodes.Values[Offset({ node[0] + 1, node[1] + 1, node[2] + 1 }, nodes.Dimensions)];
  };
  EXPECT_EQ(at({ 4, 4, 2 }), 4.0);
  EXPECT_EQ(at({ 5, 4, 2 }), 11.0);
  EXPECT_EQ(at({ 3, 5, 2 }), 23.0);
  EXPECT_EQ(at({ 6, 6, 2 }), 32.0);
}

//------------------------------------------------------------------------------
/// Samples of blocks that disagree where they touch.
TEST(AmrRegions, HaveTheSampleOfTheFirstPatch)
{
  std::vector<AmrPatch> patches;
  std::vector<TestVolume<float>> volumes;
  const std::vector<Box> boxes = MakeBlocks(0, { 0, 0, 0 }, { 2, 1, 1 }, 4);
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    volumes.push_back(TestVolume<float>::Of(
      { 5, 5, 5 }, [i](const Vector3& /*index*/) { return static_cast<double>(i); }));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    AmrPatch patch{};
    patch.First = boxes[i].First;
    patch.Cells = boxes[i].Cells;
    patch.Samples = volumes[i].View();
    patches.push_back(patch);
  }
  const AmrHierarchy hierarchy({ { 1, 1, 1 } }, patches, false);
  for (const int cells : { 1, 8 })
  {
    const std::vector<AmrRegion> regions = hierarchy.MakeRegions(cells);
    ASSERT_EQ(regions.size(), cells == 1 ? 2U : 1U);
    const AmrNodes nodes = hierarchy.MakeNodes(regions.front());
    for (int y = 1; y < 6; ++y)
    {
      EXPECT_EQ(nodes.Values[Offset({ 5, y, 3 }, nodes.Dimensions)], 0.0);
      EXPECT_EQ(nodes.Values[Offset({ 6, y, 3 }, nodes.Dimensions)], 1.0);
    }
  }
}

//------------------------------------------------------------------------------
/// Means are those of the other cells.
TEST(AmrRegions, LeaveGhostsOutOfMeans)
{
  const TestVolume<float> ones = TestVolume<float>::Of({ 4, 4, 4 },
    [](const Vector3& index) {
      return index == Vector3{ 2.0, 1.0, 1.0 } ? 1000.0 : 1.0;
    });
  std::vector<unsigned char> ghosts(64, 0);
  ghosts[Offset({ 2, 1, 1 }, { 4, 4, 4 })] = 1;
  AmrPatch patch{};
  patch.Cells = { 4, 4, 4 };
  patch.Samples = ones.View();
  patch.GhostCells = ghosts.data();
  const AmrHierarchy hierarchy({ { 1, 1, 1 } }, { patch }, true);
  const AmrNodes nodes = hierarchy.MakeNodes(hierarchy.MakeRegions(32).front());
  const Index3 corner = { 1 + 2 * 2, 1 + 2 * 1, 1 + 2 * 1 };
  EXPECT_EQ(nodes.Values[Offset(corner, nodes.Dimensions)], 1.0);
}

//------------------------------------------------------------------------------
TEST(AmrHierarchy, BetweenEqualLevelsTheInterpolantIsThatOfImages)
{
  const Grids grids({ { 1, 1, 1 } },
    { { 0, { 0, 0, 0 }, { 4, 8, 8 } }, { 0, { 4, 0, 0 }, { 4, 8, 8 } } }, true, 0.5);
  // The samples at the centres of the cells of both.
  const auto sample = [&grids](int x, int y, int z) {
    return static_cast<double>(grids.Volumes[x < 4 ? 0 : 1].At({ x < 4 ? x : x - 4, y, z }));
  };
  RandomNumbers random(14);
  for (int i = 0; i < 2000; ++i)
  {
    const Vector3 point = { random.Uniform(0.5, 7.5), random.Uniform(0.5, 7.5),
      random.Uniform(0.5, 7.5) };
    const Index3 first = { std::min(6, static_cast<int>(point[0] - 0.5)),
      std::min(6, static_cast<int>(point[1] - 0.5)),
      std::min(6, static_cast<int>(point[2] - 0.5)) };
    double expected = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      double weight = 1.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double place = point[axis] - 0.5 - first[axis];
        weight *= (corner >> axis & 1) != 0 ? place : 1.0 - place;
      }
      expected += weight *
        sample(first[0] + (corner & 1), first[1] + (corner >> 1 & 1), first[2] + (corner >> 2));
    }
    EXPECT_NEAR(grids.Interpolate(static_cast<std::size_t>(grids.FindLeaf(point)), point, point),
      expected, 1e-12);
  }
}

//------------------------------------------------------------------------------
/// The levels lie side by side, the coarsest one beside cells that are half in each of the others.
/// All means of a linear field are exact but for those in the border of the data.
TEST(AmrHierarchy, MeansTakeFinerCellsWhereALevelHasNone)
{
  const std::vector<Box> boxes = { { 0, { 0, 0, 0 }, { 4, 8, 8 } },
    { 1, { 8, 0, 0 }, { 1, 16, 16 } }, { 2, { 27, 0, 0 }, { 21, 48, 48 } },
    // Of the finer cells in one of the next coarser level, this counts for the coarsest level.
    { 1, { 9, 4, 4 }, { 1, 2, 2 } } };
  const double sizes[3] = { 1.0, 1.0 / 2.0, 1.0 / 6.0 };
  std::vector<TestVolume<double>> volumes;
  std::vector<AmrPatch> patches;
  for (const Box& box : boxes)
  {
    const double size = sizes[box.Level];
    volumes.push_back(TestVolume<double>::Of(box.Cells,
      [&](const Vector3& index)
      {
        return size *
          (index[0] + box.First[0] + 0.5 + 2.0 * (index[1] + box.First[1] + 0.5) -
            4.0 * (index[2] + box.First[2] + 0.5));
      }));
    patches.push_back(MakePatch(box));
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    patches[i].Samples = volumes[i].View();
  }
  const AmrHierarchy hierarchy(TheRatios, patches, true);
  for (const AmrRegion& region : hierarchy.MakeRegions(1))
  {
    const double node = 0.5 * sizes[region.Level];
    const AmrNodes nodes = hierarchy.MakeNodes(region);
    const AmrRange range = hierarchy.FindRange(region);
    Index3 i;
    for (i[2] = 1; i[2] < nodes.Dimensions[2] - 1; ++i[2])
    {
      for (i[1] = 1; i[1] < nodes.Dimensions[1] - 1; ++i[1])
      {
        for (i[0] = 1; i[0] < nodes.Dimensions[0] - 1; ++i[0])
        {
          const double value = nodes.Values[Offset(i, nodes.Dimensions)];
          Vector3 point;
          bool isInside = true;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            point[axis] = node * (2 * region.First[axis] + i[axis] - 1);
            isInside = isInside && point[axis] >= 0.5 && point[axis] <= 7.5;
          }
          ASSERT_GE(value, range.Min);
          ASSERT_LE(value, range.Max);
          if (isInside)
          {
            ASSERT_NEAR(value, point[0] + 2.0 * point[1] - 4.0 * point[2], 1e-12)
              << "level " << region.Level << " at " << point[0] << ' ' << point[1] << ' '
              << point[2];
          }
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
/// What is not the finer patches' own is not in means, and coarser cells that are not there are not
/// taken for there: with ghosts, with patches that overlap, and with both.
TEST(AmrHierarchy, MeansOfFinerCellsLeaveOutGhostsAndOverlaps)
{
  const auto fill = [](const Index3& cells, double low, double high, int first)
  {
    return TestVolume<double>::Of(
      cells, [=](const Vector3& index) { return index[0] < first ? low : high; });
  };
  const auto make = [](int level, int first, const TestVolume<double>& samples)
  {
    AmrPatch patch{};
    patch.Level = level;
    patch.First = { first, 0, 0 };
    patch.Samples = samples.View();
    patch.Cells = patch.Samples.Dimensions;
    return patch;
  };
  const TestVolume<double> coarse = fill({ 4, 2, 2 }, 1.0, 1.0, 0);
  const TestVolume<double> shortOne = fill({ 3, 2, 2 }, 1.0, 1.0, 0);
  // The first has no more than the lower half of its cells, and the second counts only behind them.
  const TestVolume<double> first = fill({ 4, 4, 4 }, 10.0, 1000.0, 2);
  const TestVolume<double> second = fill({ 4, 4, 4 }, 500.0, 10.0, 2);
  std::vector<unsigned char> upperHalves(64);
  for (std::size_t i = 0; i < upperHalves.size(); ++i)
  {
    upperHalves[i] = i % 4 >= 2 ? 1 : 0;
  }
  std::vector<AmrPatch> patches = { make(0, 0, coarse), make(1, 4, first), make(1, 4, second) };
  patches[0].GhostCells = upperHalves.data();
  patches[1].GhostCells = upperHalves.data();
  std::vector<AmrPatch> overlapping = { make(0, 0, shortOne), make(0, 0, shortOne), patches[1],
    patches[2] };
  const std::vector<Index3> ratios = { { 1, 1, 1 }, { 2, 2, 2 } };
  for (const std::vector<AmrPatch>& all : { patches, overlapping })
  {
    const AmrHierarchy hierarchy(ratios, all, true);
    const AmrRegion region = hierarchy.MakeRegions(1).front();
    const AmrNodes nodes = hierarchy.MakeNodes(region);
    // Between the last cell of the level and the finer cells behind it.
    const int border = all.size() == 3 ? 2 : 3;
    EXPECT_EQ(nodes.Values[Offset({ 1 + 2 * border, 2, 2 }, nodes.Dimensions)], 5.5);
    EXPECT_GE(hierarchy.FindRange(region).Max, 5.5);
  }
}

//------------------------------------------------------------------------------
TEST(AmrHierarchy, OfPatchesThatOverlapTheFirstCounts)
{
  const Grids grids({ { 1, 1, 1 } },
    { { 0, { 0, 0, 0 }, { 5, 8, 8 } }, { 0, { 3, 0, 0 }, { 5, 8, 8 } } }, false, 0.5);
  EXPECT_TRUE(grids.Nodes[0].HiddenCells.empty());
  for (int x = 0; x < 5; ++x)
  {
    EXPECT_EQ(grids.IsHidden(1, { 3.5 + x, 2.5, 4.5 }), x < 2);
  }
}

//------------------------------------------------------------------------------
TEST(AmrNodes, AreKeptInSinglePrecisionWhereItHoldsThem)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::vector<double> exact = { 0.1F, -3.0, 1e38F, infinity, -infinity, 0.0, 1e-40F,
    std::numeric_limits<double>::quiet_NaN() };
  for (const double other : { 0.5, 0.1, 1e39, 1e-60, 16777217.0 })
  {
    AmrNodes nodes;
    nodes.Dimensions = { 4, 4, 4 };
    nodes.Values.resize(64, other);
    std::copy(exact.begin(), exact.end(), nodes.Values.begin() + 40);
    const std::vector<double> values = nodes.Values;
    nodes.Shorten();
    const VolumeView view = nodes.GetSamples();
    const bool isShort = view.Type == ScalarType::Float32;
    EXPECT_EQ(isShort, other == 0.5) << other;
    EXPECT_EQ(nodes.GetMemory(), 64 * (isShort ? sizeof(float) : sizeof(double)));
    DispatchScalarType(view,
      [&values](const auto& samples)
      {
        EXPECT_EQ(samples.GetDimensions(), (Index3{ 3, 3, 3 }));
        EXPECT_EQ(samples.GetBefore(), 1);
        for (int i = 0; i < 64; ++i)
        {
          // The node before the samples along each axis has the place -1.
          const auto value =
            static_cast<double>(*samples.At({ i % 4 - 1, i / 4 % 4 - 1, i / 16 - 1 }));
          const double expected = values[static_cast<std::size_t>(i)];
          EXPECT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected))) << i;
        }
      });
  }
}

//------------------------------------------------------------------------------
TEST(AmrNodes, AreRoundedBehindTheData)
{
  AmrNodes nodes;
  nodes.Dimensions = { 4, 1, 1 };
  nodes.Values = { 0.5, 0.1, -3.0, 16777217.0 };
  nodes.Continued = { 1, 3 };
  nodes.Shorten();
  const std::vector<float> expected = { 0.5F, 0.1F, -3.0F, 16777216.0F };
  EXPECT_EQ(nodes.Singles, expected);

  // Some are too large for single precision.
  const std::vector<double> large = { 0.5, 0.1, -3.0, -1e39 };
  nodes.Values = large;
  nodes.Singles = {};
  nodes.Continued = { 1, 3 };
  nodes.Shorten();
  EXPECT_EQ(nodes.Values, large);
}

}
}
