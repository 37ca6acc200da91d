// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadDataObject_h
#define ReadDataObject_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataObject;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// Whether the name of a file is that of a grid, a mesh or composite data for ReadDataObject: .vtu,
/// .vts, .vtr, .pvtu, .pvts, .pvtr, .pvti, .vtk, .vtm, .ex2, .exo, .e or .g.
bool IsGrid(const std::string& fileName);

/// What is in a file: a grid, a mesh or composite data, or else an image, as by ReadVolume; of a
/// folder, the image of its DICOM slices. Images of DICOM and NIfTI are placed in the patient. The
/// array of this name is wanted (see ReadOrMapVolume). Throws std::runtime_error if there is
/// nothing of that kind, or if it takes more than so many MiB.
vtkSmartPointer<vtkDataObject> ReadDataObject(
  const std::string& fileName, const std::string& array, double maxMemory);

}

#endif
