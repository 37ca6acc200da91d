// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The boxes and ranges of values of cells must be those of their corners, whatever the types of
// coordinates and values are, and with any instruction set.

#include "AllKernels.h"
#include "Field/ScalarType.h"
#include "Math/Arithmetic.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class CellExtentKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, CellExtentKernels, AllKernels(), NameOfKernels);

constexpr int Points = 40;

/// Numbers of any size that the type has; of real ones, some are not finite.
template <typename T>
std::vector<T> MakeNumbers(RandomNumbers& random, int count, bool areFinite)
{
  std::vector<T> numbers(static_cast<std::size_t>(count));
  for (T& number : numbers)
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      number = static_cast<T>(random.WideMagnitude(-3.0, 30.0));
      if (!areFinite && random.Integer(0, 40) == 0)
      {
        constexpr T infinity = std::numeric_limits<T>::infinity();
        number = std::array{ infinity, -infinity,
          std::numeric_limits<T>::quiet_NaN() }[static_cast<std::size_t>(random.Integer(0, 2))];
      }
    }
    else
    {
      number = static_cast<T>(random.Uniform(static_cast<double>(std::numeric_limits<T>::min()),
        0.99 * static_cast<double>(std::numeric_limits<T>::max())));
    }
  }
  return numbers;
}

/// Cells with random corners, and what is to be found of them.
template <typename Coordinate, typename Value>
class RandomCells
{
public:
  RandomCells(RandomNumbers& random, int corners, int count, bool areFinite)
    : Coordinates(MakeNumbers<Coordinate>(random, 3 * Points, areFinite))
    , Stride(random.Integer(1, 3))
    , Values(MakeNumbers<Value>(random, (Points - 1) * Stride + 1, areFinite))
    , Corners(corners)
    , Count(count)
  {
    for (int i = 0; i < corners * count; ++i)
    {
      this->Ids.push_back(random.Integer(0, Points - 1));
    }
    this->Ids.back() = Points - 1; // the end of the arrays
  }

  void Check(const Kernels& kernels) const
  {
    const PointArrays arrays = { this->Coordinates.data(), std::is_same_v<Coordinate, float>,
      this->Values.data(), this->Stride };
    CellExtents found;
    kernels.FindExtents[static_cast<int>(ScalarTypeOf<Value>())](
      arrays, this->Ids.data(), this->Corners, this->Count, found);
    std::array<double, 4> lowest = { Infinity, Infinity, Infinity, Infinity };
    std::array<double, 4> highest = { -Infinity, -Infinity, -Infinity, -Infinity };
    double area = 0.0;
    for (int cell = 0; cell < this->Count; ++cell)
    {
      std::array<double, 4> lower = { Infinity, Infinity, Infinity, Infinity };
      std::array<double, 4> upper = { -Infinity, -Infinity, -Infinity, -Infinity };
      bool isFinite = true;
      for (int corner = 0; corner < this->Corners; ++corner)
      {
        const std::array<double, 4> numbers = this->GetNumbers(cell * this->Corners + corner);
        for (std::size_t i = 0; i < 4; ++i)
        {
          lower[i] = std::min(lower[i], numbers[i]);
          upper[i] = std::max(upper[i], numbers[i]);
          isFinite = isFinite && std::isfinite(numbers[i]);
        }
      }
      ASSERT_EQ((found.Finite >> cell & 1U) != 0, isFinite) << cell;
      if (!isFinite)
      {
        continue;
      }
      for (std::size_t i = 0; i < 4; ++i)
      {
        EXPECT_EQ(found.Lower[cell][i], lower[i]);
        EXPECT_EQ(found.Upper[cell][i], upper[i]);
        lowest[i] = std::min(lowest[i], lower[i]);
        highest[i] = std::max(highest[i], upper[i]);
      }
      const double size[3] = { upper[0] - lower[0], upper[1] - lower[1], upper[2] - lower[2] };
      area += size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
    EXPECT_EQ(found.Finite >> this->Count, 0U);
    for (std::size_t i = 0; i < 4; ++i)
    {
      EXPECT_EQ(found.LowerOfAll[i], lowest[i]);
      EXPECT_EQ(found.UpperOfAll[i], highest[i]);
    }
    EXPECT_NEAR(found.Area, area, 1e-12 * area);
  }

private:
  std::array<double, 4> GetNumbers(int corner) const
  {
    const auto id = static_cast<std::size_t>(this->Ids[static_cast<std::size_t>(corner)]);
    return { static_cast<double>(this->Coordinates[3 * id]),
      static_cast<double>(this->Coordinates[3 * id + 1]),
      static_cast<double>(this->Coordinates[3 * id + 2]),
      static_cast<double>(this->Values[id * static_cast<std::size_t>(this->Stride)]) };
  }

  std::vector<Coordinate> Coordinates;
  int Stride;
  std::vector<Value> Values;
  int Corners;
  int Count;
  std::vector<std::int64_t> Ids;
};

//------------------------------------------------------------------------------
TEST_P(CellExtentKernels, FindThoseOfCorners)
{
  RandomNumbers random(1);
  for (int type = 0; type < 10; ++type)
  {
    DispatchScalarType(static_cast<ScalarType>(type),
      [&](auto value)
      {
        using Value = decltype(value);
        for (int i = 0; i < 200; ++i)
        {
          const int corners = i % 2 == 0 ? 4 : 8;
          const int count = random.Integer(1, CellExtents::Capacity);
          const bool areFinite = i % 3 == 0;
          RandomCells<float, Value>(random, corners, count, areFinite).Check(this->TheKernels);
          RandomCells<double, Value>(random, corners, count, areFinite).Check(this->TheKernels);
        }
      });
  }
}

}
}
