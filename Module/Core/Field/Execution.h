// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef Execution_h
#define Execution_h

#include "Kernels/InstructionSets.h"

#include <cstddef>
#include <limits>

namespace vtkIsosurfaceRayTracing
{

/// How tracing is done. It changes no bit of the result.
struct Execution
{
  int Threads = 1;
  /// The kernels that trace and shade packets of rays. With null each ray is traced by itself, by
  /// the scalar code: the reference that the kernels are tested against.
  const Kernels* PacketKernels = &GetBestKernels();
  /// After so many rays for each cell of a mesh that have little in common, trees over the pieces
  /// of its surfaces are built for such rays: by then they have taken about as long as that takes.
  double RaysForTrees = 1.0 / 128.0;
};

/// The memory limits of a traced field.
struct MemoryBudget
{
  /// For what is built on demand while rays are traced (bricks, masks of cells), in bytes. Where it
  /// is not enough, what was not used lately is evicted, and rays do without: the hits are the
  /// same.
  std::size_t CacheBytes = std::numeric_limits<std::size_t>::max();
};

}

#endif
