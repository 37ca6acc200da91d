// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Places an image in the patient as its file says, which VTK's readers do not do: x to the right, y
// to the front and z to the head, as in NIfTI.

#ifndef PatientAxes_h
#define PatientAxes_h

#include "DicomSlices.h"

#include "vtkIsosurfaceRayTracingCompat.h"

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkImageData;
class vtkImageReader2;
class vtkNIFTIImageReader;
VTK_ABI_NAMESPACE_END

namespace Programs
{

void PlaceInPatient(const std::vector<DicomSlice>& slices, vtkImageData* image);

/// These warn, and do nothing, if the axes of the file are not perpendicular.
void PlaceInPatient(vtkNIFTIImageReader* reader, vtkImageData* image);
/// Of MetaImage and NRRD. Those that tell of no patient have the axes that their headers give.
void PlaceInPatient(vtkImageReader2* reader, vtkImageData* image);

/// Other files know nothing of a patient.
inline void PlaceInPatient(vtkAlgorithm*, vtkImageData*) {}

}

#endif
