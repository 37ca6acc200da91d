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

/// The fastest of them.
const Kernels& GetBestKernels();

}

#endif
