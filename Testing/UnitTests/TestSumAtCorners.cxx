// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Points and gradients of hits must be sums over the corners of their cells, in the order of these,
// with any instruction set.

#include "AllKernels.h"
#include "RandomNumbers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

class SumAtCornersKernels : public WithKernels
{
};
INSTANTIATE_TEST_SUITE_P(All, SumAtCornersKernels, AllKernels(), NameOfKernels);

constexpr int Vectors = 50;

WeightedCorners MakeCorners(RandomNumbers& random)
{
  WeightedCorners corners;
  corners.Count = random.Integer(1, WeightedCorners::Capacity);
  for (int i = 0; i < corners.Count; ++i)
  {
    corners.Corners[i] = std::array{ 4, 5, 6, 8 }[static_cast<std::size_t>(random.Integer(0, 3))];
    for (int corner = 0; corner < corners.Corners[i]; ++corner)
    {
      corners.Ids[i][corner] = random.Integer(0, Vectors - 1);
      corners.Weights[i][corner] = random.Uniform(-0.1, 1.1);
    }
  }
  return corners;
}

template <typename Number>
void Check(const Kernels& kernels, RandomNumbers& random)
{
  // Exactly as long as needed: a sanitizer sees a read beyond the last.
  std::vector<Number> vectors(std::size_t{ 3 } * Vectors);
  for (Number& number : vectors)
  {
    number = static_cast<Number>(random.WideMagnitude(-3.0, 30.0));
  }
  const WeightedCorners corners = MakeCorners(random);
  const int first = random.Integer(0, RayPacket::Capacity - corners.Count);
  double sums[3][RayPacket::Capacity] = {};
  kernels.SumAtCorners(vectors.data(), sizeof(Number) == sizeof(float), corners, first, sums);
  for (int i = 0; i < RayPacket::Capacity; ++i)
  {
    const int number = i - first;
    for (int axis = 0; axis < 3; ++axis)
    {
      double expected = 0.0;
      for (int corner = 0;
           number >= 0 && number < corners.Count && corner < corners.Corners[number]; ++corner)
      {
        const auto place = static_cast<std::size_t>(3 * corners.Ids[number][corner] + axis);
        expected += static_cast<double>(vectors[place]) * corners.Weights[number][corner];
      }
      ASSERT_EQ(sums[axis][i], expected) << i;
    }
  }
}

TEST_P(SumAtCornersKernels, AreThoseOfTheirOrder)
{
  RandomNumbers random(3);
  for (int i = 0; i < 200; ++i)
  {
    Check<float>(TheKernels, random);
    Check<double>(TheKernels, random);
  }
}

}
}
