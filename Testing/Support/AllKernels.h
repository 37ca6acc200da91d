// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef AllKernels_h
#define AllKernels_h

#include "Kernels/InstructionSets.h"
#include "Kernels/Kernels.h"

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

namespace vtkIsosurfaceRayTracing
{

/// A test suite that runs once with the kernels of every instruction set this processor has.
class WithKernels : public testing::TestWithParam<std::size_t>
{
protected:
  const Kernels& TheKernels = *GetKernels()[this->GetParam()];
};

inline auto AllKernels()
{
  return testing::Range<std::size_t>(0, GetKernels().size());
}

inline std::string NameOfKernels(const testing::TestParamInfo<std::size_t>& kernels)
{
  constexpr const char* names[] = { "Baseline", "Avx2", "Avx512" }; // in the order of GetKernels
  return names[kernels.param];
}

}

#endif
