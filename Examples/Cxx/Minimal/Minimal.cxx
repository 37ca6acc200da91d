// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// An isosurface in C++, without a window: writes minimal.png.

#include <vtkCamera.h>
#include <vtkContourValues.h>
#include <vtkImageData.h>
#include <vtkIsosurfacePicture.h>
#include <vtkIsosurfaceRayTraceMapper.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRTAnalyticSource.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

int main()
{
  vtkNew<vtkRTAnalyticSource> source; // a volume
  vtkNew<vtkIsosurfaceRayTraceMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, 150.0);
  volume->GetProperty()->ShadeOn();

  vtkNew<vtkCamera> camera;
  camera->SetPosition(50.0, 30.0, 60.0);
  camera->SetClippingRange(1.0, 200.0);
  vtkNew<vtkImageData> picture; // lit from the camera
  mapper->RenderToImage(volume, camera, nullptr, 800, 800, picture);

  vtkNew<vtkImageData> colors; // with a transparent background
  vtkIsosurfacePicture::UnpremultiplyColors(picture, colors);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(colors);
  writer->SetFileName("minimal.png");
  writer->Write();
}
