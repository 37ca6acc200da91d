// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef TracedIsosurface_h
#define TracedIsosurface_h

#include "IsosurfaceRenderer.h"
#include "OffScreenWindow.h"

#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkIsosurfaceRayTraceMapper.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <memory>

VTK_ABI_NAMESPACE_BEGIN
class vtkImageData;
class vtkVolume;
class vtkVolumeProperty;
VTK_ABI_NAMESPACE_END

namespace Benchmark
{

/// Opaque from the isovalue on, shaded: an isosurface for every mapper of volumes.
vtkSmartPointer<vtkVolumeProperty> NewSurfaceProperty(double isovalue);

/// Ours. Without a window the rays of a picture go through vtkIsosurfaceRayTraceMapper::CastRays;
/// its time then holds writing the hits into VTK's arrays too.
class TracedIsosurface : public IsosurfaceRenderer
{
public:
  /// ChangeIsovalue uses so many threads.
  TracedIsosurface(vtkImageData* image, int size, int threads);
  ~TracedIsosurface() override;

  std::string GetName() const override { return "this mapper"; }
  /// The mapper has drawn another isovalue before, from the same viewpoint.
  double ChangeIsovalue(double isovalue, const View& view) override;
  FrameTimes Draw(const View& view, int threads) override;
  bool HasThreads() const override { return true; }
  double GetHitShare() override;
  std::vector<double> GetDistances() override;

  /// A new mapper, which has built nothing, with the settings of a new one.
  void Reset();
  void SetIsovalue(double isovalue);
  vtkIsosurfaceRayTraceMapper* GetMapper() { return this->Mapper; }

  /// Casts the rays of a part of the picture and returns the seconds.
  double CastRays(const View& view, const PixelRectangle& pixels);
  /// The pixels that the volume covers.
  PixelRectangle GetPixels(const View& view) const;

private:
  vtkImageData* Image;
  int Size;
  int Threads;
  Bounds Box;
  View LastView;
  std::unique_ptr<OffScreenWindow> Window;
  vtkSmartPointer<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkSmartPointer<vtkVolume> Volume;
  vtkNew<vtkPolyData> Hits;
};

}

#endif
