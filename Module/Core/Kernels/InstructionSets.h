// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef InstructionSets_h
#define InstructionSets_h

#include <vector>

namespace vtkIsosurfaceRayTracing
{

struct Kernels;

/// The kernels that this processor can run, the fastest last.
std::vector<const Kernels*> GetKernels();

/// The kernels with a name: Baseline, AVX2 or AVX512. If this processor has none of that name
/// (which is reported on the standard error), or for null, the fastest.
const Kernels& ChooseKernels(const char* name);

/// The kernels that the environment variable VTK_ISOSURFACE_RAY_TRACING_KERNELS names at the first
/// call; without it, the fastest.
const Kernels& GetBestKernels();

}

#endif
