// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// An isosurface in C++, without a window: writes minimal.png.
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
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
  vtkNew<vtkColorTransferFunction> colors; // VTK's default is from black to white.
  colors->AddRGBPoint(150.0, 0.9, 0.7, 0.4);
  volume->GetProperty()->SetColor(colors);
  volume->GetProperty()->ShadeOn();
  vtkNew<vtkCamera> camera;
  camera->SetPosition(50.0, 30.0, 60.0);
  vtkNew<vtkImageData> picture; // lit from the camera
  mapper->RenderToImage(volume, camera, nullptr, 800, 800, picture);
  vtkNew<vtkImageData> result; // with a transparent background
  vtkIsosurfacePicture::UnpremultiplyColors(picture, result);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(result);
  writer->SetFileName("minimal.png");
  writer->Write();
}
