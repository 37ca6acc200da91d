// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Kernels.inl"

namespace vtkIsosurfaceRayTracing
{

const Kernels Avx2Kernels = { "Avx2", MakeRays, Align, FindPassages, FindHits, Refine };

}
