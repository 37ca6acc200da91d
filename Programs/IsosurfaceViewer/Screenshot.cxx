// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Screenshot.h"

#include "Support/OutputFile.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>
#include <vtksys/SystemTools.hxx>

#include <cstddef>

namespace Viewer
{
namespace
{

/// That no file has.
std::string FindName()
{
  std::string name;
  int number = 0;
  do
  {
    name = "vtkIsosurfaceViewer-" + std::to_string(++number) + ".png";
  } while (vtksys::SystemTools::PathExists(name));
  return name;
}

}

//------------------------------------------------------------------------------
std::string WriteScreenshot(vtkRenderWindow* window)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ShouldRerenderOff();
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::string name = FindName();
  Programs::OutputFile file(name);
  file.Write(bytes->GetPointer(0), static_cast<std::size_t>(bytes->GetNumberOfValues()));
  file.Finish();
  return name;
}

}
