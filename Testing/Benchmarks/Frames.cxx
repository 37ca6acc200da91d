// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Frames.h"

#include "OffScreenWindow.h"
#include "TracedIsosurface.h"

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

namespace Benchmark
{
namespace
{

constexpr double Nothing = std::numeric_limits<double>::quiet_NaN();

/// White and matt: the brightness is the cosine between the normal and the direction of view.
vtkSmartPointer<vtkVolumeProperty> NewMattProperty(double isovalue)
{
  const vtkSmartPointer<vtkVolumeProperty> property = NewSurfaceProperty(isovalue);
  vtkNew<vtkColorTransferFunction> white;
  white->AddRGBPoint(isovalue, 1.0, 1.0, 1.0);
  property->SetColor(white);
  property->SetAmbient(0.0);
  property->SetDiffuse(1.0);
  property->SetSpecular(0.0);
  return property;
}

//------------------------------------------------------------------------------
/// A painter with a window, whose depth buffer tells where the surface is.
class WindowPainter : public Painter
{
public:
  WindowPainter(const std::string& family, const std::string& knob, int size)
    : Painter(family, knob)
    , Size(size)
    , Window(size)
  {
  }

  FrameParts Draw(const View& view) override
  {
    return { this->Window.Draw(view), NotMeasured, NotMeasured, NotMeasured };
  }

  Picture Look(const View& view) override
  {
    this->Draw(view);
    Picture picture;
    this->ReadGreys(picture);
    this->ReadDepths(view, this->Window.GetDepths(), picture);
    return picture;
  }

protected:
  void ReadGreys(Picture& picture)
  {
    const std::vector<unsigned char> reds = this->Window.GetReds();
    picture.Greys.assign(reds.begin(), reds.end());
  }

  /// From depths between 0 and 1, where nothing is, to distances along the rays.
  void ReadDepths(const View& view, const std::vector<float>& depths, Picture& picture)
  {
    const auto [nearPlane, farPlane] = this->Window.GetClippingRange();
    const double thickness = farPlane - nearPlane;
    const PictureRays rays(view, this->Size);
    for (int i = 0; i < this->Size * this->Size; ++i)
    {
      const float depth = depths[static_cast<std::size_t>(i)];
      const Triple direction = rays.GetDirection(i % this->Size, i / this->Size);
      // The direction goes one cell forward.
      const double slant = std::sqrt(vtkMath::Dot(direction.data(), direction.data()));
      const double forward = nearPlane * farPlane / (farPlane - depth * thickness);
      const bool isHit = depth < 1.0F;
      picture.Found.push_back(isHit ? forward * slant : Nothing);
      if (isHit)
      {
        const double slope = forward * forward * thickness / (nearPlane * farPlane);
        const double unit = 1.0 / (1 << 24); // of a float between a half and one
        picture.DepthStep = std::max(picture.DepthStep, slope * unit * slant);
      }
    }
  }

  int Size;
  OffScreenWindow Window;
};

//------------------------------------------------------------------------------
class VolumePainter : public WindowPainter
{
public:
  VolumePainter(const std::string& family, const std::string& knob, const Input& input, int size,
    vtkVolumeMapper* mapper)
    : WindowPainter(family, knob, size)
  {
    mapper->SetInputDataObject(input.Image);
    vtkNew<vtkVolume> volume;
    volume->SetMapper(mapper);
    volume->SetProperty(NewMattProperty(input.Isovalue));
    this->Window.Show(volume);
  }
};

//------------------------------------------------------------------------------
class TracedPainter : public VolumePainter
{
public:
  TracedPainter(const std::string& family, int solver, const Input& input, int size)
    : TracedPainter(
        family, input, size, solver, vtkSmartPointer<vtkIsosurfaceRayTraceMapper>::New())
  {
  }

  FrameParts Draw(const View& view) override
  {
    const double whole = this->Window.Draw(view);
    const vtkIsosurfaceRayTraceMapper& mapper = *this->Mapper;
    const double trace = mapper.TraceTime();
    return { whole, trace, 0.0, 0.0 };
  }

private:
  vtkSmartPointer<vtkIsosurfaceRayTraceMapper> Mapper;
};

}
}
