// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Kernels/Kernels.inl"

namespace vtkIsosurfaceRayTracing
{

KERNELS(Avx512Kernels);

}
