// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Support/InputFiles.h"

#include "MetaImageHeader.h"
#include "NrrdHeader.h"

#include <vtksys/SystemTools.hxx>

#include <stdexcept>
#include <string>
#include <vector>

namespace Programs
{
namespace
{

/// The files of samples that a file refers to. Those of a header of NRRD with several are left out.
std::vector<std::string> FindFilesOfSamples(const std::string& input)
{
  if (ImageFiles::IsMetaImage(input))
  {
    return ImageFiles::FindDataFiles(input);
  }
  return { ImageFiles::IsNrrd(input) ? ImageFiles::FindDataFileOfNrrd(input) : "" };
}

}

void CheckIsNoInput(const std::string& output, const std::string& input)
{
  using vtksys::SystemTools;
  if (!SystemTools::FileExists(input, true))
  {
    return; // It is a folder, or nothing: who reads it says so.
  }
  if (SystemTools::SameFile(output, input))
  {
    throw std::runtime_error(output + " is the input: give another name");
  }
  for (const std::string& file : FindFilesOfSamples(input))
  {
    if (SystemTools::SameFile(output, file))
    {
      throw std::runtime_error(output + " belongs to the input: give another name");
    }
  }
}

}
