// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Draws a plane between two layers of samples and looks for it in the middle of the window.

#include "vtkIsosurfaceRayTraceMapper.h"

#include "vtkColorTransferFunction.h"
#include "vtkContourValues.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPiecewiseFunction.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 2);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* scalars = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int i = 0; i < 8; ++i)
  {
    scalars[i] = i < 4 ? 0 : 200;
  }

  vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
  mapper->SetInputData(image);

  vtkNew<vtkColorTransferFunction> red;
  red->AddRGBPoint(100.0, 1.0, 0.0, 0.0);
  vtkNew<vtkPiecewiseFunction> opaque;
  opaque->AddPoint(100.0, 1.0);

  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 100.0);
  volume->GetProperty()->SetColor(red);
  volume->GetProperty()->SetScalarOpacity(opaque);

  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(64, 64);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  window->Render();

  vtkNew<vtkUnsignedCharArray> pixel;
  window->GetPixelData(32, 32, 32, 32, /*front=*/0, pixel);
  std::cout << "The pixel in the middle has red " << int(pixel->GetValue(0)) << '\n';
  return pixel->GetValue(0) > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
