// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Looks at a MetaImage (.mhd, .mha) before VTK's reader does, which trusts its header: of a damaged
// one it counts dimensions for minutes, or writes beyond its memory.

#ifndef MetaImageHeader_h
#define MetaImageHeader_h

#include "ImagePlace.h"
#include "RawSamples.h"

#include <optional>
#include <string>
#include <vector>

namespace ImageFiles
{

/// Of one byte, deflate makes no more than so many.
constexpr double MostInflated = 1032.0;

bool IsMetaImage(const std::string& fileName);

/// The files of samples that a header refers to; none if they are in its own file. Throws
/// std::runtime_error if it cannot be read.
std::vector<std::string> FindDataFiles(const std::string& fileName);

/// The most bytes of samples that can be in the file, or in the file its header names; infinite
/// where that is not known (text, a list of files). Throws std::runtime_error if the header is
/// damaged.
double GetCapacityOfMetaImage(const std::string& fileName);

/// None if the samples are compressed, text, or in several files. Throws std::runtime_error if the
/// header is damaged.
std::optional<RawSamples> FindRawSamples(const std::string& fileName);

/// None if the header tells neither directions nor of a patient (AnatomicalOrientation). Places in
/// a patient, which are in the coordinates of ITK, become such with x to the right, y to the front
/// and z to the head. Throws std::runtime_error if the header is damaged.
std::optional<ImagePlace> FindPlaceOfMetaImage(const std::string& fileName);

}

#endif
