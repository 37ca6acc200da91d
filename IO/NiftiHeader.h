// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Looks at a file of NIfTI before VTK's reader does: VTK 9.1 searches its table of types beyond the
// end for one that it does not know, and crashes.

#ifndef NiftiHeader_h
#define NiftiHeader_h

#include <string>

namespace ImageFiles
{

/// .nii or .nii.gz
bool IsNifti(const std::string& fileName);

/// Whether the file is compressed, whatever its name is.
bool IsCompressedNifti(const std::string& fileName);

/// The most bytes of samples that can be in the file. Throws std::runtime_error if VTK does not
/// know their type.
double GetCapacityOfNifti(const std::string& fileName);

}

#endif
