// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#include "Baselines.h"

#ifdef BENCHMARK_HAS_EMBREE
#include "EmbreeTriangles.h"
#endif
#include "OffScreenWindow.h"
#include "Samples.h"
#include "TracedIsosurface.h"

#include <vtkActor.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkFlyingEdges3D.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkMarchingCubes.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkSmartPointer.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>

namespace Benchmark
{
namespace
{

using Details = std::vector<std::pair<std::string, double>>;

/// Triangles and nothing else: no normals, no gradients, no scalars.
template <typename Filter>
vtkSmartPointer<vtkPolyData> Extract(vtkImageData* image, double isovalue)
{
  vtkNew<Filter> filter;
  filter->SetInputData(image);
  filter->SetValue(0, isovalue);
  filter->ComputeNormalsOff();
  filter->ComputeGradientsOff();
  filter->ComputeScalarsOff();
  filter->Update();
  return filter->GetOutput();
}

//------------------------------------------------------------------------------
template <typename Filter>
class Extraction : public IsosurfaceRenderer
{
public:
  Extraction(std::string name, vtkImageData* image)
    : Name(std::move(name))
    , Image(image)
  {
  }

  std::string GetName() const override { return this->Name; }
  bool HasPictures() const override { return false; }
  FrameTimes Draw(const View&, int) override { return {}; }
  Details GetDetails() const override { return { { "triangles", this->Triangles } }; }

  double ChangeIsovalue(double isovalue, const View&) override
  {
    vtkSmartPointer<vtkPolyData> mesh;
    const double seconds = Measure([&]() { mesh = Extract<Filter>(this->Image, isovalue); });
    this->Triangles = static_cast<double>(mesh->GetNumberOfCells());
    return seconds;
  }

private:
  std::string Name;
  vtkImageData* Image;
  double Triangles = 0.0;
};

//------------------------------------------------------------------------------
std::vector<double> GetSilhouette(OffScreenWindow& window)
{
  std::vector<double> distances;
  for (const bool isDrawn : window.GetDrawn())
  {
    distances.push_back(isDrawn ? HitAtUnknownDistance : NoHit);
  }
  return distances;
}

//------------------------------------------------------------------------------
class Polygons : public IsosurfaceRenderer
{
public:
  Polygons(vtkImageData* image, int size)
    : Image(image)
    , Window(size)
  {
  }

  std::string GetName() const override { return "polygons"; }
  Details GetDetails() const override { return this->Steps; }

  double ChangeIsovalue(double isovalue, const View& view) override
  {
    vtkSmartPointer<vtkPolyData> mesh;
    const double extraction =
      Measure([&]() { mesh = Extract<vtkFlyingEdges3D>(this->Image, isovalue); });
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(mesh);
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Window.Show(actor);
    const double first = this->Window.Draw(view);
    this->Steps = { { "extraction, s", extraction }, { "first frame, s", first } };
    return extraction + first;
  }

  FrameTimes Draw(const View& view, int) override
  {
    return { this->Window.Draw(view), NotMeasured };
  }

  double GetHitShare() override { return this->Window.GetShareDrawn(); }
  std::vector<double> GetDistances() override { return GetSilhouette(this->Window); }

private:
  vtkImageData* Image;
  OffScreenWindow Window;
  Details Steps;
};

//------------------------------------------------------------------------------
class VolumePictures : public IsosurfaceRenderer
{
public:
  VolumePictures(std::string name, vtkImageData* image, vtkVolumeMapper* mapper, int size)
    : Window(size)
    , Name(std::move(name))
  {
    mapper->SetInputDataObject(image);
    this->Volume->SetMapper(mapper);
    this->Window.Show(this->Volume);
  }

  std::string GetName() const override { return this->Name; }
  double ChangeIsovalue(double isovalue, const View& view) override
  {
    this->Volume->SetProperty(NewSurfaceProperty(isovalue));
    return this->Window.Draw(view);
  }

  FrameTimes Draw(const View& view, int) override
  {
    return { this->Window.Draw(view), NotMeasured };
  }

  double GetHitShare() override { return this->Window.GetShareDrawn(); }
  std::vector<double> GetDistances() override { return GetSilhouette(this->Window); }

protected:
  OffScreenWindow Window;

private:
  std::string Name;
  vtkNew<vtkVolume> Volume;
};

//------------------------------------------------------------------------------
std::unique_ptr<IsosurfaceRenderer> NewFixedPoint(
  vtkImageData* image, int size, int threads, double sampleDistance)
{
  const double* spacing = image->GetSpacing();
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  mapper->SetNumberOfThreads(threads);
  // A sample for every cell and a ray for every pixel: the sampling of our pictures.
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetSampleDistance(static_cast<float>(
    sampleDistance > 0.0 ? sampleDistance : *std::min_element(spacing, spacing + 3)));
  mapper->SetImageSampleDistance(1.0F);
  return std::make_unique<VolumePictures>("fixed-point", image, mapper, size);
}

//------------------------------------------------------------------------------
/// VTK's GPU mode of isosurfaces. Its depth image tells what it takes for the surface.
class GpuPictures : public VolumePictures
{
public:
  static std::unique_ptr<IsosurfaceRenderer> New(
    vtkImageData* image, int size, double sampleDistance)
  {
    vtkNew<vtkGPUVolumeRayCastMapper> mapper;
    mapper->SetBlendModeToIsoSurface();
    mapper->SetDepthImageScalarTypeToFloat();
    if (sampleDistance > 0.0)
    {
      mapper->AutoAdjustSampleDistancesOff();
      mapper->SetSampleDistance(static_cast<float>(sampleDistance));
    }
    return std::make_unique<GpuPictures>(image, size, mapper);
  }

  GpuPictures(vtkImageData* image, int size, vtkGPUVolumeRayCastMapper* mapper)
    : VolumePictures("gpu", image, mapper, size)
    , Image(image)
    , Size(size)
    , Mapper(mapper)
  {
  }

  FrameTimes Draw(const View& view, int threads) override
  {
    this->LastView = view;
    return this->VolumePictures::Draw(view, threads);
  }

  std::vector<double> GetDistances() override
  {
    vtkNew<vtkImageData> depths;
    this->Mapper->RenderToImageOn();
    this->Window.Draw(this->LastView);
    this->Mapper->GetDepthImage(depths);
    this->Mapper->RenderToImageOff();
    const PictureRays rays(this->LastView, this->Size);
    std::vector<double> distances;
    for (int y = 0; y < this->Size; ++y)
    {
      for (int x = 0; x < this->Size; ++x)
      {
        const double depth = depths->GetScalarComponentAsDouble(x, y, 0, 0);
        distances.push_back(
          depth < 1.0 ? this->GetDistance(depth, rays.GetDirection(x, y)) : NoHit);
      }
    }
    return distances;
  }

private:
  /// VTK 9.1 takes the position in the texture for the position in the volume; but in the texture
  /// samples are at the centres of texels, so that all distances from the middle are scaled by (n -
  /// 1) / n: up to half a cell off. Corrected here.
  double GetDistance(double depth, const Triple& direction)
  {
    const auto [nearest, farthest] = this->Window.GetClippingRange();
    double along = nearest * farthest / (farthest - depth * (farthest - nearest));
    double slope = 0.0;
    Triple forward;
    vtkMath::Subtract(this->LastView.Focus.data(), this->LastView.Eye.data(), forward.data());
    vtkMath::Normalize(forward.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int samples = this->Image->GetDimensions()[axis];
      const double scale = (samples - 1.0) / samples;
      const double toMiddle = this->Image->GetCenter()[axis] - this->LastView.Eye[axis];
      along -= forward[axis] * (1.0 - scale) * toMiddle;
      slope += forward[axis] * scale * direction[axis];
    }
    return along / slope * vtkMath::Norm(direction.data());
  }

  vtkImageData* Image;
  int Size;
  View LastView;
  vtkSmartPointer<vtkGPUVolumeRayCastMapper> Mapper;
};

#ifdef BENCHMARK_HAS_EMBREE
//------------------------------------------------------------------------------
class EmbreePictures : public IsosurfaceRenderer
{
public:
  EmbreePictures(vtkImageData* image, int size, int threads)
    : Image(image)
    , Size(size)
    , Threads(threads)
  {
    image->GetBounds(this->Box.data());
  }

  std::string GetName() const override { return "embree"; }
  bool HasThreads() const override { return true; }
  Details GetDetails() const override { return this->Steps; }

  double ChangeIsovalue(double isovalue, const View& view) override
  {
    vtkSmartPointer<vtkPolyData> mesh;
    const double extraction =
      Measure([&]() { mesh = Extract<vtkFlyingEdges3D>(this->Image, isovalue); });
    const double build = Measure(
      [&]()
      {
        this->Triangles.reset();
        this->Triangles = std::make_unique<EmbreeTriangles>(mesh, this->Threads);
      });
    const double first = this->Draw(view, this->Threads).Trace;
    this->Steps = { { "extraction, s", extraction }, { "build, s", build } };
    return extraction + build + first;
  }

  FrameTimes Draw(const View& view, int threads) override
  {
    const PictureRays rays(view, this->Size);
    const PixelRectangle pixels = rays.GetPixels(this->Box);
    const double seconds =
      Measure([&]() { this->Hits = this->Triangles->Trace(rays, pixels, threads); });
    return { NotMeasured, seconds };
  }

  double GetHitShare() override { return 1.0 * this->Hits / this->Size / this->Size; }

private:
  vtkImageData* Image;
  int Size;
  int Threads;
  int Hits = 0;
  Bounds Box;
  std::unique_ptr<EmbreeTriangles> Triangles;
  Details Steps;
};
#endif

}

//------------------------------------------------------------------------------
std::vector<std::string> GetBaselineNames()
{
  return { "flying-edges", "marching-cubes", "polygons", "embree", "fixed-point", "gpu" };
}

//------------------------------------------------------------------------------
std::string GetAbsence(const std::string& baseline)
{
  if (baseline == "embree")
  {
#ifdef BENCHMARK_HAS_EMBREE
    return {};
#else
    return "it was not found when this was built (Debian: libembree-dev)";
#endif
  }
  const bool needsWindow = baseline == "polygons" || baseline == "fixed-point" || baseline == "gpu";
  return needsWindow && !OffScreenWindow::IsPossible()
    ? "there is no display (xvfb-run -a gives one)"
    : std::string();
}

//------------------------------------------------------------------------------
std::unique_ptr<IsosurfaceRenderer> NewBaseline(
  const std::string& name, vtkImageData* image, int size, int threads, double sampleDistance)
{
  if (name == "flying-edges")
  {
    return std::make_unique<Extraction<vtkFlyingEdges3D>>(name, image);
  }
  if (name == "marching-cubes")
  {
    return std::make_unique<Extraction<vtkMarchingCubes>>(name, image);
  }
  if (name == "polygons")
  {
    return std::make_unique<Polygons>(image, size);
  }
  if (name == "fixed-point")
  {
    return NewFixedPoint(image, size, threads, sampleDistance);
  }
#ifdef BENCHMARK_HAS_EMBREE
  if (name == "embree")
  {
    return std::make_unique<EmbreePictures>(image, size, threads);
  }
#endif
  return GpuPictures::New(image, size, sampleDistance);
}

}
