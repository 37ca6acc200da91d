// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// What kernels find in hexahedra, against its definition in more precise arithmetic, with any
// instruction set.

#include "AllKernels.h"
#include "LoneRay.h"
#include "Math/Arithmetic.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class HexahedronKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, HexahedronKernels, AllKernels(), NameOfKernels);

constexpr int Capacity = PackedPieces::Capacity;

/// x, y, z and value of the corners of cubes that are twisted, somewhere.
struct Hexahedra
{
  int Count;
  double Corners[Capacity][8][4];

  explicit Hexahedra(RandomNumbers& random)
    : Count(random.Integer(1, Capacity))
  {
    const double edge = std::pow(10.0, random.Uniform(-6.0, 6.0));
    const Vector3 middle = random.PointInBox({ -50.0, -50.0, -50.0 }, { 50.0, 50.0, 50.0 });
    for (int cell = 0; cell < this->Count; ++cell)
    {
      const Vector3 place = middle + random.PointInBox({ -2.0, -2.0, -2.0 }, { 2.0, 2.0, 2.0 });
      for (int corner = 0; corner < 8; ++corner)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          this->Corners[cell][corner][axis] = edge *
            (place[static_cast<std::size_t>(axis)] + (corner >> axis & 1) +
              random.Uniform(-0.3, 0.3));
        }
        this->Corners[cell][corner][3] =
          random.Integer(0, 8) == 0 ? 0.0 : random.Uniform(-1.0, 1.0);
      }
    }
  }
};

using Precise = std::array<long double, 3>;

Precise Subtract(const double (&a)[4], const double (&b)[4])
{
  Precise difference;
  for (std::size_t i = 0; i < 3; ++i)
  {
    difference[i] = static_cast<long double>(a[i]) - static_cast<long double>(b[i]);
  }
  return difference;
}

Precise Cross(const Precise& a, const Precise& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

long double Dot(const Precise& a, const Precise& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// By the mean of the four edges along each axis.
long double GetVolume(const double (&corners)[8][4])
{
  Precise edges[3] = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int low = 0; low < 8; ++low)
    {
      const int high = low | 1 << axis;
      const Precise edge = Subtract(corners[high], corners[low]);
      for (std::size_t i = 0; i < 3; ++i)
      {
        edges[axis][i] += edge[i] / 4.0L;
      }
    }
  }
  return std::abs(Dot(Cross(edges[0], edges[1]), edges[2]));
}

//------------------------------------------------------------------------------
/// A gradient is right if it gives the rises along the three edges of the corner.
TEST_P(HexahedronKernels, FindGradientsThatRiseAsTheEdgesDo)
{
  RandomNumbers random(1);
  for (int i = 0; i < 2000; ++i)
  {
    const Hexahedra cells(random);
    CornerGradients found;
    this->TheKernels.FindCornerGradients(cells.Corners, cells.Count, found);
    for (int cell = 0; cell < cells.Count; ++cell)
    {
      const auto& corners = cells.Corners[cell];
      const auto volume = static_cast<double>(GetVolume(corners));
      ASSERT_NEAR(found.Volume[cell], volume, 1e-11 * volume);
      for (int corner = 0; corner < 8; ++corner)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          const int other = corner ^ 1 << axis;
          const Precise edge = Subtract(corners[other], corners[corner]);
          long double rise = 0.0L;
          for (std::size_t k = 0; k < 3; ++k)
          {
            rise += edge[k] * static_cast<long double>(found.Gradient[corner][k][cell]);
          }
          ASSERT_NEAR(
            static_cast<double>(rise) / volume, corners[other][3] - corners[corner][3], 1e-8)
            << cell << " " << corner << " " << axis;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST_P(HexahedronKernels, TellWhatIsNotFiniteAndWhatIsFlat)
{
  RandomNumbers random(2);
  for (int i = 0; i < 3000; ++i)
  {
    Hexahedra cells(random);
    const int cell = random.Integer(0, cells.Count - 1);
    const int corner = random.Integer(0, 7);
    const bool isFlat = i % 2 == 0;
    if (isFlat)
    {
      // Between the other ends of two edges.
      const int axis = random.Integer(0, 2);
      const double(&a)[4] = cells.Corners[cell][corner ^ 1 << axis];
      const double(&b)[4] = cells.Corners[cell][corner ^ 1 << (axis + 1) % 3];
      for (int k = 0; k < 3; ++k)
      {
        cells.Corners[cell][corner][k] = 0.3 * a[k] + 0.7 * b[k];
      }
    }
    else
    {
      const std::array<double, 3> bad = { Infinity, -Infinity,
        std::numeric_limits<double>::quiet_NaN() };
      cells.Corners[cell][corner][random.Integer(0, 3)] =
        bad[static_cast<std::size_t>(random.Integer(0, 2))];
    }
    CornerGradients found;
    this->TheKernels.FindCornerGradients(cells.Corners, cells.Count, found);
    for (int other = 0; other < cells.Count; ++other)
    {
      ASSERT_EQ(found.Volume[other] < Infinity, isFlat || other != cell);
    }
    const double sum = found.Gradient[corner][0][cell] + found.Gradient[corner][1][cell] +
      found.Gradient[corner][2][cell];
    ASSERT_FALSE(std::isfinite(sum));
  }
}

//------------------------------------------------------------------------------
/// A coordinate of a packed point, and a step.
struct Unpacked
{
  double Coordinate;
  double Step;

  Unpacked(const PackedPieces& set, int corner, int piece, int axis)
  {
    const auto lower = static_cast<double>(set.Lower[axis]);
    this->Step = (static_cast<double>(set.Upper[axis]) - lower) / PackedPieces::Steps;
    const std::uint32_t word = set.Polygons[corner][piece] >> (PackedPieces::Bits * axis);
    this->Coordinate = lower + this->Step * (word & PackedPieces::Steps);
  }
};

/// The box of the points where segments between corners on both sides meet the surface.
struct HullBox
{
  long double Lower[3];
  long double Upper[3];

  explicit HullBox(const double (&corners)[8][4])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lower[axis] = Infinity;
      this->Upper[axis] = -Infinity;
      for (const auto& a : corners)
      {
        for (const auto& b : corners)
        {
          if (a[3] < 0.0 && b[3] >= 0.0)
          {
            const long double fraction = a[3] / (static_cast<long double>(a[3]) - b[3]);
            const long double point =
              a[axis] + fraction * (static_cast<long double>(b[axis]) - a[axis]);
            this->Lower[axis] = std::min(this->Lower[axis], point);
            this->Upper[axis] = std::max(this->Upper[axis], point);
          }
        }
      }
    }
  }
};

/// Cells that all have a corner on each side, and the set of their pieces.
struct PassedHexahedra : Hexahedra
{
  PackedPieces Set{};

  PassedHexahedra(RandomNumbers& random, const Kernels& kernels)
    : Hexahedra(random)
  {
    for (int cell = 0; cell < this->Count; ++cell)
    {
      this->Corners[cell][random.Integer(0, 3)][3] = random.Uniform(-1.0, -0.1);
      this->Corners[cell][random.Integer(4, 7)][3] = random.Integer(0, 1) * 0.5;
    }
    this->Set.Count = static_cast<std::uint8_t>(this->Count);
    kernels.PackBoxes(this->Corners, this->Set);
  }

  Bounds GetBounds() const
  {
    Bounds bounds;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      bounds.Lower[axis] = static_cast<double>(this->Set.Lower[axis]);
      bounds.Upper[axis] = static_cast<double>(this->Set.Upper[axis]);
    }
    return bounds;
  }
};

TEST_P(HexahedronKernels, PackTheBoxesOfHullsToHalfAStep)
{
  RandomNumbers random(3);
  for (int i = 0; i < 2000; ++i)
  {
    const PassedHexahedra cells(random, this->TheKernels);
    for (int cell = 0; cell < cells.Count; ++cell)
    {
      const HullBox box(cells.Corners[cell]);
      for (int axis = 0; axis < 3; ++axis)
      {
        const Unpacked low(cells.Set, 0, cell, axis);
        const Unpacked high(cells.Set, 1, cell, axis);
        ASSERT_NEAR(low.Coordinate, static_cast<double>(box.Lower[axis]), 0.501 * low.Step);
        ASSERT_NEAR(high.Coordinate, static_cast<double>(box.Upper[axis]), 0.501 * high.Step);
        ASSERT_LE(static_cast<double>(cells.Set.Lower[axis]), static_cast<double>(box.Lower[axis]));
        ASSERT_GE(static_cast<double>(cells.Set.Upper[axis]), static_cast<double>(box.Upper[axis]));
      }
    }
  }
}

//------------------------------------------------------------------------------
/// No box that is met is left out; few of those are found that are not met.
TEST_P(HexahedronKernels, FindTheBoxesOnARay)
{
  RandomNumbers random(4);
  int met = 0;
  int beside = 0;
  int found = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const PassedHexahedra cells(random, this->TheKernels);
    const LoneRay ray(random, cells.GetBounds());
    if (!ray.Exists())
    {
      continue;
    }
    const unsigned int pieces = ray.FindPieces(this->TheKernels, cells.Set);
    ASSERT_EQ(pieces >> cells.Count, 0U);
    for (int cell = 0; cell < cells.Count; ++cell)
    {
      const HullBox box(cells.Corners[cell]);
      const bool isFound = (pieces >> cell & 1U) != 0;
      if (ray.Meets(box, 0.0L))
      {
        ++met;
        ASSERT_TRUE(isFound) << i << " " << cell;
      }
      else if (!ray.Meets(box, 0.05L))
      {
        ++beside;
        found += isFound ? 1 : 0;
      }
    }
  }
  EXPECT_GT(met, 1000);
  EXPECT_LT(found, beside / 5) << met << " " << beside;
}

}
}
