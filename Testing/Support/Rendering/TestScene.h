// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TestScene_h
#define TestScene_h

#include "vtkIsosurfaceRayTraceMapper.h"

#include <vtkActor.h>
#include <vtkAlgorithm.h>
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourValues.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <array>

namespace MapperTesting
{

inline vtkSmartPointer<vtkActor> NewActor(vtkAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

/// A sphere of polygons, with so many of them along each of its circles.
inline vtkSmartPointer<vtkActor> NewSphere(
  double radius, const std::array<double, 3>& center, int resolution = 8)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetCenter(center[0], center[1], center[2]);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  return NewActor(source);
}

/// A light towards the origin: a scene light, unless another type is set.
inline vtkSmartPointer<vtkLight> NewLight(const std::array<double, 3>& position,
  const std::array<double, 3>& color = { 1.0, 1.0, 1.0 }, int type = VTK_LIGHT_TYPE_SCENE_LIGHT)
{
  auto light = vtkSmartPointer<vtkLight>::New();
  light->SetLightType(type);
  light->SetPosition(position[0], position[1], position[2]);
  light->SetFocalPoint(0.0, 0.0, 0.0);
  light->SetColor(color[0], color[1], color[2]);
  return light;
}

/// A volume with its mapper in a renderer of a small window. Its surface is at 0, ivory and opaque.
struct Scene
{
  explicit Scene(vtkDataObject* data, int width = 160, int height = 160)
  {
    this->Mapper->SetInputDataObject(0, data);
    this->Volume->SetMapper(this->Mapper);
    this->Property()->ShadeOn();
    this->SetSurface(0.0, { 0.9, 0.8, 0.7 }, 1.0);
    this->Renderer->AddVolume(this->Volume);
    this->Renderer->SetBackground(0.1, 0.2, 0.3);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(width, height);
    this->Window->AddRenderer(this->Renderer);
    this->LookFrom(1.0, -2.0, 0.8);
  }

  vtkVolumeProperty* Property() { return this->Volume->GetProperty(); }

  /// The one surface there is.
  void SetSurface(double isovalue, const std::array<double, 3>& color, double opacity)
  {
    this->Property()->GetRGBTransferFunction()->RemoveAllPoints();
    this->Property()->GetScalarOpacity()->RemoveAllPoints();
    this->Property()->GetIsoSurfaceValues()->SetNumberOfContours(0);
    this->AddSurface(isovalue, color, opacity);
  }

  void AddSurface(double isovalue, const std::array<double, 3>& color, double opacity)
  {
    vtkContourValues* isovalues = this->Property()->GetIsoSurfaceValues();
    isovalues->SetValue(isovalues->GetNumberOfContours(), isovalue);
    this->Property()->GetRGBTransferFunction()->AddRGBPoint(isovalue, color[0], color[1], color[2]);
    this->Property()->GetScalarOpacity()->AddPoint(isovalue, opacity);
  }

  void LookFrom(double x, double y, double z)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetPosition(x, y, z);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCamera();
    camera->Zoom(1.7);
    camera->SetParallelScale(camera->GetParallelScale() / 1.7);
  }

  /// The picture without a window, of the window's size; with a headlight if there are no lights.
  vtkSmartPointer<vtkImageData> RenderToImage(vtkLightCollection* lights = nullptr)
  {
    const int* size = this->Window->GetSize();
    auto picture = vtkSmartPointer<vtkImageData>::New();
    this->Mapper->RenderToImage(
      this->Volume, this->Renderer->GetActiveCamera(), lights, size[0], size[1], picture);
    return picture;
  }

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
};

}

#endif
