// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef OwnPages_h
#define OwnPages_h

#include <cstddef>

namespace ImageFiles
{

/// Whether pages of a file that is mapped privately are known to be those of the file: none has
/// become memory of this process, as it does when it is written to. Linux tells; of other systems
/// it is not known.
bool AreAllOfFile(const void* pages, std::size_t size);

}

#endif
