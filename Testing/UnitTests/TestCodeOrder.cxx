// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Mesh/CodeOrder.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

TEST(CodeOrder, IsThatOfAStableSort)
{
  RandomNumbers random(1);
  for (const std::uint32_t count : { 0U, 1U, 2U, 3000U, 20000U })
  {
    // Some have the same code, and some have none.
    std::vector<std::uint32_t> codes(count);
    std::vector<std::uint32_t> expected;
    const int different = random.Integer(1, 4) * 1000;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      codes[i] = static_cast<std::uint32_t>(random.Integer(0, different)) * 1000003U;
      if (random.Integer(0, 5) != 0)
      {
        expected.push_back(i);
      }
    }
    const std::vector<std::uint32_t> coded = expected;
    std::stable_sort(expected.begin(), expected.end(),
      [&codes](std::uint32_t a, std::uint32_t b) { return codes[a] < codes[b]; });
    for (const int threads : { 1, 2, 7 })
    {
      CodeOrder order(count);
      for (std::uint32_t i = 0; i < count; ++i)
      {
        order.LeaveOut(i);
      }
      for (const std::uint32_t i : coded)
      {
        order.SetCode(i, codes[i]);
      }
      EXPECT_EQ(order.Find(threads), expected) << count << " numbers, " << threads << " threads";
    }
  }
}

}
}
