// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ImageFormats_h
#define ImageFormats_h

#include "MappableImage.h"

#include <string>

namespace ImageFiles
{

/// Whether a file of this name has a header that says how large the image is: .mhd, .mha, .nhdr,
/// .nrrd, .nii and .vti.
bool HasHeader(const std::string& fileName);

/// The image in a file with a header, whose samples are to be checked. All but their place is what
/// VTK's reader of the format says. Throws std::runtime_error if the header is damaged, or says
/// that the samples are not as they are in memory.
MappableImage FindImage(const std::string& fileName);

}

#endif
