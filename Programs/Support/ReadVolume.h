// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef ReadVolume_h
#define ReadVolume_h

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <array>
#include <functional>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
VTK_ABI_NAMESPACE_END

namespace Programs
{

/// The default of the option --max-memory of all programs, in MiB: the memory of the machine, or
/// what this process may have of it.
double GetDefaultMaxMemory();
/// What --help says of it.
extern const char* const MaxMemoryHelp;

/// The axes of an image: those of its samples, or, if its file tells (DICOM, NIfTI, NRRD,
/// MetaImage), those of the patient: x to the right, y to the front and z to the head.
enum class Axes
{
  OfSamples,
  OfPatient
};

/// The image in a file, read by the reader of VTK for its extension or its first bytes, or in a
/// folder of DICOM slices. Throws std::runtime_error if there is no such reader, if it finds no
/// image, or if the header asks for more samples than there are in the file or than fit into so
/// many MiB.
vtkSmartPointer<vtkImageData> ReadVolume(
  const std::string& fileName, double maxMemory, Axes axes = Axes::OfSamples);

/// The same for what is only looked at: an image of more than half that size is used where it is in
/// the file, if it can be (see vtkMappedImageReader). The array of this name is wanted, or if it is
/// empty the active scalars: others need not be there.
vtkSmartPointer<vtkImageData> ReadOrMapVolume(
  const std::string& fileName, const std::string& array, double maxMemory, Axes axes);

/// The extent that is to be read of an image with some whole extent.
using ChooseExtent = std::function<std::array<int, 6>(const std::array<int, 6>&)>;

/// The same of a part of the image alone, which is all that must fit into the memory. (Some readers
/// read more than they are asked for.) Where the samples can be used in the file (see
/// vtkMappedImageReader), nothing is read, and the part may have any size.
vtkSmartPointer<vtkImageData> ReadPiece(const std::string& fileName, const std::string& array,
  double maxMemory, const ChooseExtent& choose);

}

#endif
