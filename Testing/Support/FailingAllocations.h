// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Allocations that fail when a test wants it. The source replaces operator new and delete of the
// program that it is linked to, and of its shared libraries.

#ifndef FailingAllocations_h
#define FailingAllocations_h

#include <string>

namespace FailingAllocations
{

/// Lets only allocations fail that a shared library makes, by itself or through the C++ standard
/// library. Otherwise those of all code do. The name is the beginning of its file's. Returns
/// whether there is such a library.
bool SelectLibrary(const std::string& name);

/// Begins to count allocations; the one with this number, from 1, fails.
void FailAt(long number);

/// Ends it. Returns whether there were so many allocations.
bool HasFailed();

/// The number of allocations that are not freed, by all code.
long CountLive();

}

#endif
