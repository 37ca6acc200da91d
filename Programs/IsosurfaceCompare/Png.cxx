// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Png.h"

#include <vtkBase64Utilities.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <vector>

namespace Compare
{

//------------------------------------------------------------------------------
std::string EncodePng(vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const auto size = static_cast<unsigned long>(bytes->GetNumberOfValues());
  std::vector<unsigned char> text(size / 3 * 4 + 8); // Four letters for three bytes, rounded up.
  const unsigned long length = vtkBase64Utilities::Encode(bytes->GetPointer(0), size, text.data());
  return std::string(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length));
}

//------------------------------------------------------------------------------
std::string EncodePng(vtkRenderWindow* window)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  picture->Update();
  return EncodePng(picture->GetOutput());
}

}
