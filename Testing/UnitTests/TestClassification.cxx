// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The classification, in single precision, may keep a cell that has no root and may miss that a ray
// surely hits; but it must never drop a cell that has a root, nor report a sure hit where there is
// none.

#include "AllKernels.h"
#include "CellReference.h"
#include "Image/Macrocells/BlockMask.h"
#include "RandomNumbers.h"
#include "Rays/RayPacket.h"
#include "TestLines.h"
#include "TestVolume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class Classification : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, Classification, AllKernels(), NameOfKernels);

//------------------------------------------------------------------------------
// Volumes.

enum class FieldKind
{
  Smooth,
  Rough,
  /// Most samples are the isovalue.
  Ties,
  /// Parabolas whose vertex is near the isovalue.
  Tangent,
  /// The surface lies in, or next to, the planes between cells.
  OnPlanes,
  /// Small differences of large values.
  Offset,
  BetweenFloats,
  Large,
  Huge,
  Tiny,
  /// So large or small that values are scaled.
  ScaledUp,
  ScaledDown,
  /// The same, but for few samples in an ordinary volume.
  ScaledForFew
};
constexpr FieldKind AllFieldKinds[] = { FieldKind::Smooth, FieldKind::Rough, FieldKind::Ties,
  FieldKind::Tangent, FieldKind::OnPlanes, FieldKind::Offset, FieldKind::BetweenFloats,
  FieldKind::Large, FieldKind::Huge, FieldKind::Tiny, FieldKind::ScaledUp, FieldKind::ScaledDown,
  FieldKind::ScaledForFew };

template <typename T>
struct Field
{
  TestVolume<T> Volume;
  ScaledIsovalue Isovalue;
};

/// Whether samples of a type have the values of a kind.
template <typename T>
bool Holds(FieldKind kind)
{
  switch (kind)
  {
    case FieldKind::Large:
      return sizeof(T) == 8 || std::is_floating_point_v<T>;
    case FieldKind::Huge:
    case FieldKind::Tiny:
      return std::is_floating_point_v<T>;
    case FieldKind::ScaledUp:
    case FieldKind::ScaledDown:
    case FieldKind::ScaledForFew:
      return std::is_same_v<T, double>;
    case FieldKind::BetweenFloats:
      return std::numeric_limits<T>::digits > 30;
    default:
      return true;
  }
}

/// A value near the end of the type, or 1e6; and a small step there.
template <typename T>
void GetOffset(double& middle, double& step)
{
  using Limits = std::numeric_limits<T>;
  step = std::is_integral_v<T> ? std::max(1.0, std::ldexp(1.0, Limits::digits - 52))
    : sizeof(T) == 4           ? 0x1p-4
                               : 1e-3;
  middle = std::is_integral_v<T> ? std::ldexp(1.0, Limits::digits) - 20.0 * step : 1e6;
}

/// Values as a function of the position.
template <typename T, typename Value>
TestVolume<T> Fill(RandomNumbers& random, const Index3& dimensions, const Value& value)
{
  const double limit = std::is_floating_point_v<T>
    ? static_cast<double>(std::numeric_limits<T>::max())
    : std::ldexp(1.0, std::numeric_limits<T>::digits - 1);
  const double least = std::is_unsigned_v<T> ? 0.0 : -limit;
  const double most = std::is_floating_point_v<T> ? limit : 1.999999 * limit;
  return TestVolume<T>::Of(
    dimensions, [&](const AnalyticFields::Point& p) { return std::clamp(value(p), least, most); },
    random.Integer(1, 3));
}

/// Random, of either sign if the type has one.
template <typename T>
TestVolume<T> FillWide(RandomNumbers& random, const Index3& dimensions, double low, double high)
{
  return Fill<T>(random, dimensions,
    [&](const AnalyticFields::Point&) { return random.WideMagnitude(low, high); });
}

template <typename T>
Field<T> NewField(RandomNumbers& random, FieldKind kind, const Index3& dimensions)
{
  const AnalyticFields::Gyroid gyroid = { random.Uniform(5.0, 20.0) };
  const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
  const double sign = std::is_signed_v<T> && random.Integer(0, 1) ? -1.0 : 1.0;
  double middle = 60.0;
  double step = 1.0;
  switch (kind)
  {
    case FieldKind::Smooth:
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point& p) { return middle + 40.0 * gyroid(p); }),
        { random.Uniform(40.0, 80.0), 1.0 } };
    case FieldKind::Rough:
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point&) { return random.Integer(0, 100) + 0.0; }),
        { random.Integer(0, 1) ? 50.0 : random.Uniform(1.0, 99.0), 1.0 } };
    case FieldKind::Ties:
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point&)
                 { return middle + (random.Integer(0, 2) ? 0 : random.Integer(-1, 1)); }),
        { middle, 1.0 } };
    case FieldKind::Tangent:
    {
      const Vector3 normal = random.Direction();
      const double offset =
        Dot(normal, random.PointInBox({}, { dimensions[0] - 1.0, dimensions[1] - 1.0, 5.0 }));
      const double above[] = { 0.0, 1e-7, 1e-5, 1e-3, 0.1, 1.0 };
      const double scale = random.Uniform(0.1, 4.0);
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point& p)
                 {
                   const double off = Dot(normal, p) - offset;
                   return std::min(20.0 + scale * off * off, 120.0);
                 }),
        { 20.0 + above[random.Integer(0, 5)], 1.0 } };
    }
    case FieldKind::OnPlanes:
    {
      const int plane = random.Integer(0, dimensions[axis] - 1);
      const double off[] = { 0.0, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2 };
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point& p)
                 { return middle + sign * std::clamp(p[axis] - plane, -6.0, 6.0) * 10.0; }),
        { middle + off[random.Integer(0, 7)] * (random.Integer(0, 1) ? 1.0 : -1.0), 1.0 } };
    }
    case FieldKind::Offset:
    {
      GetOffset<T>(middle, step);
      const double isovalue = middle + step * 0.25 * random.Integer(-8, 8);
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point& p)
                 { return sign * (middle + step * std::round(4.0 * gyroid(p))); }),
        { sign * isovalue, 1.0 } };
    }
    case FieldKind::BetweenFloats:
    {
      // Those below are rounded to the same as the isovalue, those above are not.
      step = std::is_integral_v<T> ? 128.0 : 0.125;
      middle = step * ((1 << 23) + 1.5);
      const double tiny = std::is_integral_v<T> ? 1.0 : 1e-6;
      const int oneOf = random.Integer(2, 6);
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point&) {
                   return sign * (middle + (random.Integer(1, oneOf) == 1 ? -0.99 * step : tiny));
                 }),
        { sign * (middle - 0.5 * tiny), 1.0 } };
    }
    case FieldKind::Large:
      return { FillWide<T>(random, dimensions, 14.0, std::is_integral_v<T> ? 19.0 : 26.0),
        { random.Integer(0, 1) ? 1.0 : random.Uniform(1e14, 1e17), 1.0 } };
    case FieldKind::Huge:
      return { FillWide<T>(random, dimensions, 28.0, sizeof(T) == 4 ? 38.6 : 45.0),
        { random.Integer(0, 1) ? 0.0 : random.WideMagnitude(28.0, 39.0), 1.0 } };
    case FieldKind::Tiny:
      return { FillWide<T>(
                 random, dimensions, sizeof(T) == 4 ? -46.0 : -60.0, random.Uniform(-42.0, -22.0)),
        { random.Integer(0, 1) ? 0.0 : random.WideMagnitude(-46.0, -24.0), 1.0 } };
    case FieldKind::ScaledUp:
      return { FillWide<T>(random, dimensions, -324.0, -290.0),
        { random.Integer(0, 1) ? 0.0 : random.WideMagnitude(-300.0, -290.0), 0x1p970 } };
    case FieldKind::ScaledDown:
      return { FillWide<T>(random, dimensions, 290.0, 308.0),
        { random.Integer(0, 1) ? 0.0 : random.WideMagnitude(295.0, 308.0), 0x1p-998 } };
    case FieldKind::ScaledForFew:
      return { Fill<T>(random, dimensions,
                 [&](const AnalyticFields::Point&)
                 { return random.Integer(0, 40) ? random.Uniform(0.0, 100.0) : 1e300; }),
        { 50.0, 0x1p-998 } };
  }
  throw std::logic_error("unknown kind of field");
}

template <typename T>
CellCorners CornersOf(const TestVolume<T>& volume, const Index3& cell)
{
  CellCorners corners;
  for (int i = 0; i < 8; ++i)
  {
    corners[static_cast<std::size_t>(i)] =
      static_cast<double>(volume.At({ cell[0] + i % 2, cell[1] + i / 2 % 2, cell[2] + i / 4 }));
  }
  return corners;
}

/// The cells of a block: all, or those that the surface passes.
template <typename T>
BlockMask MakeMask(const Field<T>& field, const Index3& block, bool all)
{
  BlockMask mask = {};
  ForEachPlace({ 8, 8, 8 },
    [&](const Index3& i)
    {
      Index3 cell;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        cell[axis] = 8 * block[axis] + i[axis];
        if (cell[axis] >= field.Volume.Dimensions[axis] - 1)
        {
          return;
        }
      }
      const CellCorners corners = CornersOf(field.Volume, cell);
      const auto range = std::minmax_element(corners.begin(), corners.end());
      const bool isPassed =
        *range.first < field.Isovalue.Isovalue && field.Isovalue.Isovalue <= *range.second;
      mask.Slices[2][i[2]] |= std::uint64_t{ all || isPassed } << (i[0] + 8 * i[1]);
    });
  mask.CompleteSlices();
  return mask;
}

//------------------------------------------------------------------------------
// Rays.

/// The t of a point of interest: where a ray hits the surface, or where it crosses a plane.
template <typename T>
std::optional<double> FindPoint(
  RandomNumbers& random, const Ray& ray, std::size_t axis, const Field<T>& field)
{
  std::vector<double> points;
  if (random.Integer(0, 2) == 0)
  {
    const int plane = random.Integer(0, field.Volume.Dimensions[axis] - 1);
    return ray.Base + ray.CrossingT(axis, plane);
  }
  for (const Index3& cell : CellsOnRay(ray, field.Volume.Dimensions))
  {
    const CellCorners differences = Differences(CornersOf(field.Volume, cell), field.Isovalue);
    if (const MaybeRoot root = ExpectRoot(ray, cell, differences))
    {
      points.push_back(root->T);
    }
  }
  return points.empty() ? std::nullopt : std::optional(points[random.Bits() % points.size()]);
}

/// Whole, or beginning or ending somewhere in the volume, often next to a point of interest.
template <typename T>
std::optional<Ray> NewRay(
  RandomNumbers& random, const Line& line, std::size_t axis, const Field<T>& field)
{
  const auto clip = [&](double begin, double end)
  { return ClipToVolume(line.Origin, line.Direction, begin, end, field.Volume.Dimensions); };
  const auto whole = clip(0.0, Infinity);
  const int how = random.Integer(0, 9);
  if (!whole || how < 5)
  {
    return whole;
  }
  const double offs[] = { 0.0, 1e-12, 3e-7, 9e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-2, 0.3 };
  const double off =
    offs[random.Integer(0, 9)] * (random.Integer(0, 1) ? 1.0 : -1.0) / line.Direction[axis];
  const std::optional<double> point = FindPoint(random, *whole, axis, field);
  const double t = point ? *point + off : whole->Base + random.Uniform(whole->Begin, whole->End);
  return how < 7 ? clip(std::max(t, 0.0), Infinity)
    : how < 9    ? clip(0.0, t)
                 : clip(std::max(t, 0.0), t + random.Uniform(0.0, 2.0));
}

/// With it the ray only just hits the surface in a cell, or misses it narrowly: it is next to the
/// value where the ray enters or leaves, or to an extreme one in between.
template <typename T>
double FindHardIsovalue(
  RandomNumbers& random, const TestVolume<T>& volume, const Ray& ray, const Index3& cell)
{
  const CellCorners corners = CornersOf(volume, cell);
  const auto range = std::minmax_element(corners.begin(), corners.end());
  double value = random.Uniform(*range.first, *range.second);
  CellSegment segment;
  if (SegmentInCell(ray, cell, segment))
  {
    const auto cubic = CubicAlongSegment(corners, segment.Entry, segment.Exit);
    TurningPoints<double> turns;
    turns.Find(cubic.data());
    std::vector<double> points = { 0.0, 1.0 };
    for (int i = 0; i < 2; ++i)
    {
      if (turns.Exists[i])
      {
        points.push_back(turns.At[i]);
      }
    }
    const int last = static_cast<int>(points.size()) - 1;
    value = Robust::Evaluate(cubic, points[static_cast<std::size_t>(random.Integer(0, last))]);
  }
  return value + random.WideMagnitude(-9.0, -3.0) * (*range.second - *range.first);
}

//------------------------------------------------------------------------------
/// A cell of a passage.
struct Query
{
  int Passage;
  int Slice;
  int Bit;
};

Index3 GetCell(const Passages& passages, const Query& query, std::size_t axis)
{
  const int* first = passages.First[passages.Segments[query.Passage].Block];
  Index3 cell = { first[0], first[1], first[2] };
  cell[axis] += query.Slice;
  cell[static_cast<std::size_t>(BlockMask::U[axis])] += query.Bit % 8;
  cell[static_cast<std::size_t>(BlockMask::V[axis])] += query.Bit / 8;
  return cell;
}

/// Classifies cells, and compares the results for each with the reference.
class ClassificationChecks
{
public:
  explicit ClassificationChecks(const Kernels& kernels)
    : TheKernels(kernels)
  {
  }

  template <typename T>
  void Check(RandomNumbers& random, const Field<T>& field, LineKind lines)
  {
    const Index3& n = field.Volume.Dimensions;
    const auto axis = static_cast<std::size_t>(random.Integer(0, 2));
    const double sign = random.Integer(0, 1) ? 1.0 : -1.0;
    RayPacket packet = EmptyPacket();
    const int count = random.Integer(0, 1) ? RayPacket::Capacity : random.Integer(1, 20);
    for (int i = 0; i < count; ++i)
    {
      AppendRay(NewRay(random, LineAlong(random, lines, axis, sign, n), axis, field), packet);
    }
    AlignedRays aligned;
    Frustum frustum;
    if (IsEmpty(packet.Exists) ||
      !this->TheKernels.Align(packet, packet.Exists, static_cast<int>(axis), aligned, frustum))
    {
      return;
    }
    const bool all = random.Integer(0, 4) == 0;
    Passages passages;
    const auto clear = [&passages]
    {
      passages.Count = 0;
      passages.BlockCount = 0;
      passages.HasEnds = false;
      passages.AreUneven = false;
    };
    clear();
    ForEachPlace(BlocksCovering({ n[0] - 1, n[1] - 1, n[2] - 1 }, 8),
      [&](const Index3& block)
      {
        const int first[3] = { 8 * block[0], 8 * block[1], 8 * block[2] };
        this->TheKernels.FindPassages(aligned, packet.Exists, static_cast<int>(axis), first,
          MakeMask(field, block, all).Slices[axis], nullptr, passages);
        if (passages.Count >= Passages::Batch)
        {
          ASSERT_NO_FATAL_FAILURE(this->CheckPassages(random, field, packet, axis, all, passages));
          clear();
        }
      });
    ASSERT_NO_FATAL_FAILURE(this->CheckPassages(random, field, packet, axis, all, passages));
  }

  // Of the cells that the surface passes:
  std::size_t Cells = 0;
  std::size_t Roots = 0;
  std::size_t Kept = 0;
  /// Those that the classification is sure of.
  std::size_t Sure = 0;

private:
  /// Classifies the cells of all passages, but never two of one passage at once: so it is known
  /// which of them is surely hit.
  template <typename T>
  void CheckPassages(RandomNumbers& random, const Field<T>& field, const RayPacket& packet,
    std::size_t axis, bool all, Passages& passages)
  {
    std::vector<std::vector<Query>> rounds;
    for (int passage = 0; passage < passages.Count; ++passage)
    {
      std::size_t number = 0;
      for (int slice = 0; slice < 8; ++slice)
      {
        for (int bit = 0; bit < 64; ++bit)
        {
          if (passages.Cells[passage][slice] >> bit & 1)
          {
            rounds.resize(std::max(rounds.size(), number + 1));
            rounds[number++].push_back({ passage, slice, bit });
          }
        }
      }
    }
    for (const std::vector<Query>& round : rounds)
    {
      for (std::size_t first = 0; first < round.size();)
      {
        // Any number of cells at once, so that every lane is the last one at some time.
        const auto count = std::min<std::size_t>(
          random.Integer(0, 3) ? random.Integer(1, 40) : random.Integer(64, MostAtOnce),
          round.size() - first);
        ASSERT_NO_FATAL_FAILURE(this->CheckSome(
          random, field.Volume, field.Isovalue, packet, axis, all, &round[first], count, passages));
        first += count;
      }
      for (const Query& query : round)
      {
        if (random.Integer(0, 1) && field.Isovalue.Scale == 1.0)
        {
          const ScaledIsovalue hard = { FindHardIsovalue(random, field.Volume,
                                          GetRay(packet, passages.Segments[query.Passage].Ray),
                                          GetCell(passages, query, axis)),
            1.0 };
          ASSERT_NO_FATAL_FAILURE(
            this->CheckSome(random, field.Volume, hard, packet, axis, true, &query, 1, passages));
        }
      }
    }
  }

  template <typename T>
  void CheckSome(RandomNumbers& random, const TestVolume<T>& volume, const ScaledIsovalue& isovalue,
    const RayPacket& packet, std::size_t axis, bool all, const Query* queries, std::size_t count,
    Passages& passages)
  {
    std::vector<Index3> cells;
    PassedCells passed;
    passed.Count = static_cast<int>(count);
    for (std::size_t i = 0; i < count + 16; ++i)
    {
      // Behind the last cell stands the first again.
      const Query& query = queries[i < count ? i : 0];
      const Index3 cell = GetCell(passages, query, axis);
      cells.push_back(cell);
      passed.Codes[i] = static_cast<unsigned int>(query.Passage) |
        static_cast<unsigned int>(query.Slice) << 16 | static_cast<unsigned int>(query.Bit) << 24;
      passed.First[i] = &volume.At(cell);
    }
    // There may be candidates, hits of rays and of other passages already, which are kept.
    Candidates candidates;
    const int before = random.Integer(0, Candidates::Batch - 1);
    candidates.Count = before;
    RaySet hits[2];
    RaySet expectedHits[2];
    for (int side = 0; side < 2; ++side)
    {
      hits[side] = { { random.Bits() & random.Bits(), random.Bits() & random.Bits() } };
      expectedHits[side] = hits[side];
    }
    const auto stride = static_cast<std::ptrdiff_t>(volume.Stride);
    const Index3& n = volume.Dimensions;
    const std::ptrdiff_t strides[3] = { stride, stride * n[0], stride * n[0] * n[1] };
    const auto classify = [&]
    {
      this->TheKernels.ClassifyCells[static_cast<std::size_t>(ScalarTypeOf<T>())](
        passed, static_cast<int>(axis), strides, isovalue, passages, candidates, hits);
    };
    classify();

    int next = before;
    for (std::size_t i = 0; i < count; ++i)
    {
      const int passage = queries[i].Passage;
      const int ray = passages.Segments[passage].Ray;
      const Index3& cell = cells[i];
      const CellCorners corners = CornersOf(volume, cell);
      const MaybeRoot root = ExpectRoot(GetRay(packet, ray), cell, Differences(corners, isovalue));
      const bool isKept = next < candidates.Count && candidates.Ray[next] == ray &&
        candidates.Cell[0][next] == cell[0] && candidates.Cell[1][next] == cell[1] &&
        candidates.Cell[2][next] == cell[2] && candidates.First[next] == passed.First[i];
      next += isKept ? 1 : 0;
      const bool isSure = passages.Hits[passage];
      passages.Hits[passage] = false;
      ASSERT_TRUE(isKept || !root) << "cell " << i << " of " << count << " is lost";
      ASSERT_TRUE(!isSure || root) << "cell " << i << " of " << count << " has no root";
      if (isSure)
      {
        const bool isUp = packet.Direction[axis][ray] > 0.0;
        Add(ray, expectedHits[root->Entering == isUp ? 1 : 0]);
      }
      if (!all)
      {
        this->Cells += 1;
        this->Roots += root ? 1 : 0;
        this->Kept += isKept ? 1 : 0;
        this->Sure += isSure ? 1 : 0;
      }
    }
    ASSERT_EQ(next, candidates.Count) << "there are unrequested candidates";
    for (int side = 0; side < 2; ++side)
    {
      ASSERT_EQ(hits[side].Words[0], expectedHits[side].Words[0]);
      ASSERT_EQ(hits[side].Words[1], expectedHits[side].Words[1]);
    }

    // A sure hit remains, whatever the other cells are.
    std::fill_n(passages.Hits, passages.Count, true);
    candidates.Count = 0;
    classify();
    ASSERT_EQ(candidates.Count, next - before);
    ASSERT_EQ(std::count(passages.Hits, passages.Hits + passages.Count, false), 0);
    for (int side = 0; side < 2; ++side)
    {
      ASSERT_EQ(hits[side].Words[0], expectedHits[side].Words[0]);
      ASSERT_EQ(hits[side].Words[1], expectedHits[side].Words[1]);
    }
    std::fill_n(passages.Hits, passages.Count, false);
  }

  static constexpr int MostAtOnce = PassedCells::Capacity - 16;

  const Kernels& TheKernels;
};

//------------------------------------------------------------------------------
TEST_P(Classification, KeepsCellsWithRootsAndConfirmsOnlyThose)
{
  for (const FieldKind kind : AllFieldKinds)
  {
    ClassificationChecks checks(this->TheKernels);
    ForEachType(
      [&](auto zero)
      {
        using T = decltype(zero);
        RandomNumbers random(861 + 100 * static_cast<std::uint64_t>(ScalarTypeOf<T>()));
        for (int i = 0; i < (Holds<T>(kind) ? 20 : 0); ++i)
        {
          const Index3 n = { random.Integer(2, 20), random.Integer(2, 20), random.Integer(2, 20) };
          const Field<T> field = NewField<T>(random, kind, n);
          for (const LineKind lines : AllLineKinds)
          {
            ASSERT_NO_FATAL_FAILURE(checks.Check(random, field, lines))
              << "field " << static_cast<int>(kind) << " of type "
              << static_cast<int>(ScalarTypeOf<T>()) << ", lines " << static_cast<int>(lines);
          }
        }
      });
    const auto share = [](std::size_t part, std::size_t whole)
    { return static_cast<double>(part) / static_cast<double>(whole); };
    std::cout << "[ tried    ] field " << static_cast<int>(kind) << ": " << checks.Cells
              << " cells, " << checks.Roots << " with a root; of those without, "
              << share(checks.Kept - checks.Roots, checks.Cells - checks.Roots)
              << " kept; of those with one, " << share(checks.Sure, checks.Roots) << " sure\n";
    EXPECT_GT(checks.Roots, 5000U);
    if (kind == FieldKind::Smooth || kind == FieldKind::Rough)
    {
      EXPECT_LT(share(checks.Kept - checks.Roots, checks.Cells - checks.Roots), 0.1);
      EXPECT_GT(share(checks.Sure, checks.Roots), 0.5);
    }
  }
}

}
}
