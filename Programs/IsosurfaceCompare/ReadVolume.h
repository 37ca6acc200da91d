// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadVolume_h
#define ReadVolume_h

#include <vtkSmartPointer.h>

#include <string>

class vtkImageData;

namespace Compare
{

/// The image in a file, by the reader of VTK that its name or its beginning asks for. Throws
/// std::runtime_error if there is none or it finds nothing.
vtkSmartPointer<vtkImageData> ReadVolume(const std::string& fileName);

}

#endif
