// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Support/InputFiles.h"

#include "MetaImageHeader.h"
#include "NrrdHeader.h"

#include <vtksys/SystemTools.hxx>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <system_error>
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

//------------------------------------------------------------------------------
bool IsFile(const std::string& name)
{
  std::error_code error;
  return std::filesystem::is_regular_file(name, error);
}

//------------------------------------------------------------------------------
void CheckIsFile(const std::string& name)
{
  if (!IsFile(name))
  {
    throw std::runtime_error("there is no file " + name +
      (vtksys::SystemTools::FileExists(name) ? ", but a pipe or a device: give a file" : ""));
  }
}

//------------------------------------------------------------------------------
void CheckIsNoInput(const std::string& output, const std::string& input)
{
  using vtksys::SystemTools;
  if (!IsFile(input))
  {
    return; // It is a folder, a pipe, or nothing: who reads it says so.
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
