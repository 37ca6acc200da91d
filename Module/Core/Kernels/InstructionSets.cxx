// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Kernels/InstructionSets.h"

#include "Kernels/Kernels.h"
#include "Math/Compiler.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>

namespace vtkIsosurfaceRayTracing
{

std::vector<const Kernels*> GetKernels()
{
  std::vector<const Kernels*> kernels = { &BaselineKernels };
#if defined(__x86_64__)
  if (HasAvx2())
  {
    kernels.push_back(&Avx2Kernels);
  }
  if (HasAvx512())
  {
    kernels.push_back(&Avx512Kernels);
  }
#endif
  return kernels;
}

const Kernels& ChooseKernels(const char* name)
{
  const std::vector<const Kernels*> kernels = GetKernels();
  if (name == nullptr)
  {
    return *kernels.back();
  }
  const std::vector<std::string> names = { "Baseline", "AVX2", "AVX512" }; // as in GetKernels
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::size_t>(found - names.begin());
  if (index >= kernels.size())
  {
    std::cerr << "vtkIsosurfaceRayTracing: VTK_ISOSURFACE_RAY_TRACING_KERNELS is \"" << name
              << "\"; this processor runs";
    for (std::size_t i = 0; i < kernels.size(); ++i)
    {
      std::cerr << ' ' << names[i];
    }
    std::cerr << ", and the last of these is taken.\n";
    return *kernels.back();
  }
  return *kernels[index];
}

const Kernels& GetBestKernels()
{
  static const Kernels& best = ChooseKernels(std::getenv("VTK_ISOSURFACE_RAY_TRACING_KERNELS"));
  return best;
}

}
