// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Support/InputFiles.h"

#include "MetaImageHeader.h"
#include "NrrdHeader.h"

#include <vtksys/SystemTools.hxx>

#include <stdexcept>

namespace Programs
{
namespace
{

/// The file of raw samples that a file refers to; empty if it refers to none.
std::string FindFileOfSamples(const std::string& input)
{
  if (ImageFiles::IsMetaImage(input))
  {
    const auto samples = ImageFiles::FindRawSamples(input);
    return samples ? samples->FileName : "";
  }
  if (ImageFiles::IsNrrd(input))
  {
    const auto samples = ImageFiles::FindRawSamplesOfNrrd(input);
    return samples ? samples->FileName : "";
  }
  return "";
}

bool IsInFolder(const std::string& fileName, const std::string& folder)
{
  using vtksys::SystemTools;
  return SystemTools::FileIsDirectory(folder) && SystemTools::FileExists(fileName, true) &&
    SystemTools::SameFile(
      SystemTools::GetParentDirectory(SystemTools::GetRealPath(fileName)), folder);
}

}

void CheckIsNoInput(const std::string& output, const std::string& input)
{
  using vtksys::SystemTools;
  if (!SystemTools::FileExists(input))
  {
    return; // Who reads it says so.
  }
  if (SystemTools::SameFile(output, input))
  {
    throw std::runtime_error(output + " is the input: give another name");
  }
  if (IsInFolder(output, input) || SystemTools::SameFile(output, FindFileOfSamples(input)))
  {
    throw std::runtime_error(output + " belongs to the input: give another name");
  }
}

}
