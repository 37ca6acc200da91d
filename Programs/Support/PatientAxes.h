// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Turns an image as its file says, which VTK's readers of DICOM and NIfTI tell but do not do.

#ifndef PatientAxes_h
#define PatientAxes_h

#include "vtkIsosurfaceRayTracingCompat.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDICOMImageReader;
class vtkImageData;
class vtkNIFTIImageReader;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// Places an image in the patient: x to the right, y to the front and z to the head, as in NIfTI.
void PlaceInPatient(vtkDICOMImageReader* reader, vtkImageData* image);
void PlaceInPatient(vtkNIFTIImageReader* reader, vtkImageData* image);

/// Other files know nothing of a patient.
inline void PlaceInPatient(vtkAlgorithm*, vtkImageData*) {}

}

#endif
