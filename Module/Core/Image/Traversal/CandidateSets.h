// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef CandidateSets_h
#define CandidateSets_h

#include "Kernels/Kernels.h"
#include "Math/Compiler.h"

#include <cstdint>

// The sets of Solutions.

namespace vtkIsosurfaceRayTracing
{

inline bool HasCandidate(const std::uint64_t (&set)[Solutions::Words], int candidate)
{
  return (set[candidate / 64] >> (candidate % 64) & 1) != 0;
}

/// Calls visit(candidate) for the members of a set, in order.
template <typename Visit>
void ForEachCandidate(const std::uint64_t (&set)[Solutions::Words], const Visit& visit)
{
  for (int word = 0; word < Solutions::Words; ++word)
  {
    for (std::uint64_t bits = set[word]; bits != 0; bits &= bits - 1)
    {
      visit(64 * word + LowestBit(bits));
    }
  }
}

}

#endif
