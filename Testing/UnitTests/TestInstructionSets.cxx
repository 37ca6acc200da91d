// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Kernels/InstructionSets.h"

#include "Kernels/Kernels.h"

#include <gtest/gtest.h>

#include <string>

using namespace vtkIsosurfaceRayTracing;

TEST(TestInstructionSets, KernelsAreChosenByName)
{
  const auto kernels = GetKernels();
  const char* names[] = { "Baseline", "AVX2", "AVX512" };
  for (std::size_t i = 0; i < kernels.size(); ++i)
  {
    EXPECT_EQ(&ChooseKernels(names[i]), kernels[i]);
  }
}

TEST(TestInstructionSets, WithoutANameTheKernelsAreTheFastest)
{
  EXPECT_EQ(&ChooseKernels(nullptr), GetKernels().back());
}

TEST(TestInstructionSets, AnUnknownNameIsReportedAndTheKernelsAreTheFastest)
{
  testing::internal::CaptureStderr();
  EXPECT_EQ(&ChooseKernels("MMX"), GetKernels().back());
  const std::string message = testing::internal::GetCapturedStderr();
  EXPECT_NE(message.find("VTK_ISOSURFACE_RAY_TRACING_KERNELS is \"MMX\""), std::string::npos);
  EXPECT_NE(message.find("runs Baseline"), std::string::npos);
}
