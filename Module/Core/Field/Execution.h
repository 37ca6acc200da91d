// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Execution_h
#define Execution_h

#include "Kernels/InstructionSets.h"

#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// How work is done. It changes no bit of what comes out.
struct Execution
{
  int Threads = 1;
  /// What packets of rays are traced and shaded with. With null each ray goes by itself, through
  /// the scalar code: the reference that the kernels are tested against.
  const Kernels* PacketKernels = &GetBestKernels();
};

/// What a traced field may cost.
struct MemoryBudget
{
  /// For what is made on demand while rays are traced (bricks, masks of cells), in bytes. Where it
  /// is not enough, what was not used lately makes room, and rays do without: the hits are the
  /// same.
  std::size_t CacheBytes = std::numeric_limits<std::size_t>::max();
};

}

#endif
