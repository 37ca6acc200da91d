// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Image/Lattice/CellLattice.h"
#include "RandomNumbers.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{
namespace
{

//------------------------------------------------------------------------------
TEST(CellLattice, DividesByMultiplication)
{
  RandomNumbers random(31);
  constexpr std::uint32_t largest = std::numeric_limits<std::uint32_t>::max();
  for (int run = 0; run < 20000; ++run)
  {
    const int divisor =
      run < 2000 ? run + 1 : static_cast<int>(random.Bits() >> (33 + random.Integer(0, 28))) + 1;
    const auto d = static_cast<std::uint32_t>(divisor);
    const auto any = static_cast<std::uint32_t>(random.Bits());
    // Where quotients change.
    const std::uint32_t multiple = any / d * d;
    for (const std::uint32_t number : { 0U, 1U, any, multiple, multiple - 1U, multiple + 1U,
           multiple + (d - 1U), largest, largest - 1U, largest / d * d, largest / d * d - 1U })
    {
      ASSERT_EQ(Divisor(divisor).Divide(number), number / d) << number << " / " << d;
    }
  }
}

//------------------------------------------------------------------------------
TEST(CellLattice, NumbersCellsAndFindsThemAgain)
{
  RandomNumbers random(32);
  for (int run = 0; run < 20000; ++run)
  {
    // Some have more cells than 32 bits count.
    const int most = run % 3 == 0 ? 2000000 : 300;
    const Index3 dimensions = { random.Integer(2, most), random.Integer(2, most),
      random.Integer(2, 900) };
    const CellLattice lattice(dimensions);
    Index3 cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int last = dimensions[axis] - 2;
      cell[axis] = random.Integer(0, 3) == 0 ? last : random.Integer(0, last);
    }
    const std::int64_t number = lattice.GetNumber(cell);
    ASSERT_EQ(lattice.GetCell(number), cell);
    ASSERT_EQ(number,
      cell[0] +
        static_cast<std::int64_t>(dimensions[0] - 1) *
          (cell[1] + static_cast<std::int64_t>(dimensions[1] - 1) * cell[2]));
  }
}

}
}
