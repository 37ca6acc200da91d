// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Kernels/InstructionSets.h"

#include "Kernels/Kernels.h"

namespace vtkIsosurfaceRayTracing
{

std::vector<const Kernels*> GetKernels()
{
  std::vector<const Kernels*> kernels = { &BaselineKernels };
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
  {
    kernels.push_back(&Avx2Kernels);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
  {
    kernels.push_back(&Avx512Kernels);
  }
#endif
  return kernels;
}

const Kernels& GetBestKernels()
{
  static const Kernels& best = *GetKernels().back();
  return best;
}

}
