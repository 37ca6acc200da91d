// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Places an image in the patient as its file says, which VTK's readers of DICOM and NIfTI tell but
// do not do: x to the right, y to the front and z to the head, as in NIfTI.

#ifndef PatientAxes_h
#define PatientAxes_h

#include "DicomSlices.h"

#include "vtkIsosurfaceRayTracingCompat.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkImageData;
class vtkNIFTIImageReader;
VTK_ABI_NAMESPACE_END

namespace Programs
{

void PlaceInPatient(const std::vector<DicomSlice>& slices, vtkImageData* image);

/// Warns, and does nothing, if the axes of the file are not perpendicular.
void PlaceInPatient(vtkNIFTIImageReader* reader, vtkImageData* image);

/// Other files know nothing of a patient.
inline void PlaceInPatient(vtkAlgorithm*, vtkImageData*) {}

}

#endif
