// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The simulation of the benchmark, against schedules worked out by hand.

#include "../Benchmarks/TileSchedule.h"

#include <gtest/gtest.h>

using Benchmark::GetEfficiency;

TEST(TileSchedule, OneThreadIsNeverIdle)
{
  EXPECT_DOUBLE_EQ(GetEfficiency({ 3.0, 1.0, 2.0 }, 1), 1.0);
}

TEST(TileSchedule, LongTileFirstLeavesNoThreadIdle)
{
  EXPECT_DOUBLE_EQ(GetEfficiency({ 3.0, 1.0, 1.0, 1.0 }, 2), 1.0);
}

TEST(TileSchedule, LongTileLastLeavesAThreadIdle)
{
  // One thread ends at 2, the other at 4.
  EXPECT_DOUBLE_EQ(GetEfficiency({ 1.0, 1.0, 1.0, 3.0 }, 2), 6.0 / 8.0);
}

TEST(TileSchedule, ThreadsWithoutTilesAreIdle)
{
  EXPECT_DOUBLE_EQ(GetEfficiency({ 1.0, 1.0 }, 8), 0.25);
}
