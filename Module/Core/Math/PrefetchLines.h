// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef PrefetchLines_h
#define PrefetchLines_h

#include "Math/Compiler.h"

#include <cstddef>

namespace vtkIsosurfaceRayTracing
{

/// Asks for memory that is read soon, in lines of the cache.
inline void PrefetchLines(const void* begin, std::size_t bytes)
{
  constexpr std::size_t line = 64;
  for (std::size_t i = 0; i < bytes; i += line)
  {
    PrefetchLine(static_cast<const char*>(begin) + i);
  }
}

}

#endif
