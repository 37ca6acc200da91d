// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Looks at a NRRD (.nrrd, .nhdr) before VTK's reader does, which trusts its header.

#ifndef NrrdHeader_h
#define NrrdHeader_h

#include "ImagePlace.h"
#include "RawSamples.h"

#include <optional>
#include <string>

namespace ImageFiles
{

bool IsNrrd(const std::string& fileName);

/// The file of samples that a header refers to; empty if they are in its own file, or in several.
/// Throws std::runtime_error if it cannot be read.
std::string FindDataFileOfNrrd(const std::string& fileName);

/// Throws std::runtime_error if the header is damaged, or if VTK's reader would give other samples
/// than there are: of text, and where components or volumes are, or may be, along an axis that is
/// not the first.
void CheckNrrd(const std::string& fileName);

/// Throws std::runtime_error if there are three axes of which VTK's reader takes the first for
/// components, since it is short: what it gives is a picture.
void CheckVolumeOfNrrd(const std::string& fileName);

/// The samples of a NRRD, and how many the header says that there are.
struct NrrdSamples : RawSamples
{
  double Count;
};

/// None if the samples are compressed, text, in several files, or after bytes or lines to be
/// skipped. Throws std::runtime_error if the header is damaged.
std::optional<NrrdSamples> FindRawSamplesOfNrrd(const std::string& fileName);

struct NrrdPlace : ImagePlace
{
  /// VTK's reader reverses them, and leaves the origin where it is.
  bool AreRowsReversed;
};

/// None if the header tells no directions. Places in a patient (a space that begins with left or
/// right) become such with x to the right, y to the front and z to the head. Throws
/// std::runtime_error if the header is damaged.
std::optional<NrrdPlace> FindPlaceOfNrrd(const std::string& fileName);

}

#endif
