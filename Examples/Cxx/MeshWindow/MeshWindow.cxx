// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// An isosurface of a mesh in a window: MeshWindow FILE.vtu ARRAY ISOVALUE
// ARRAY is one of points. The mouse turns the surface, and q closes the window.
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkIsosurfaceRayTraceMeshMapper.h>
#include <vtkIsosurfaceVolume.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkVolumeProperty.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::fprintf(stderr, "usage: MeshWindow FILE.vtu ARRAY ISOVALUE\n");
    return EXIT_FAILURE;
  }
  const double isovalue = std::atof(argv[3]);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(argv[1]);
  vtkNew<vtkIsosurfaceRayTraceMeshMapper> mapper;
  mapper->SetInputConnection(reader->GetOutputPort());
  mapper->SetScalarModeToUsePointFieldData();
  mapper->SelectScalarArray(argv[2]);
  vtkNew<vtkColorTransferFunction> colors; // VTK's default is from black to white.
  colors->AddRGBPoint(isovalue, 0.4, 0.7, 0.9);
  vtkNew<vtkIsosurfaceVolume> volume;
  volume->SetMapper(mapper);
  volume->GetProperty()->GetIsoSurfaceValues()->SetValue(0, isovalue);
  volume->GetProperty()->SetColor(colors);
  volume->GetProperty()->ShadeOn();

  vtkNew<vtkRenderer> renderer;
  renderer->AddVolume(volume);
  vtkNew<vtkRenderWindow> window;
  window->SetMultiSamples(0); // Smooths polygons, not isosurfaces, and is slow without a GPU.
  window->SetSize(800, 800);
  window->SetWindowName("MeshWindow");
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  window->Render();
  interactor->Start();
}
