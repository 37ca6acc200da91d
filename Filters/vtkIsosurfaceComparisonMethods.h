// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The methods that vtkIsosurfaceComparisonFilter compares: VTK's extraction filters behind one
// interface, and the isosurface as vtkIsosurfaceRayTraceMapper traces it.

#ifndef vtkIsosurfaceComparisonMethods_h
#define vtkIsosurfaceComparisonMethods_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkIsosurfaceRayTraceMapper;
class vtkImageData;
class vtkPolyData;
class vtkPolyDataAlgorithm;
class vtkVolume;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

/// A filter of VTK that extracts triangles from the active scalars of an image.
class Extraction
{
public:
  virtual ~Extraction() = default;

  virtual vtkPolyDataAlgorithm* GetFilter() = 0;
  virtual void SetIsovalue(double isovalue) = 0;
  /// Builds what does not depend on the isovalue, and returns the time in seconds. Most filters
  /// have nothing to build.
  virtual double Build() { return 0.0; }
};

/// A kind of extraction. A new filter has neither built nor extracted anything; it computes normals
/// for shading if requested.
struct ExtractionMethod
{
  const char* Name;
  std::unique_ptr<Extraction> (*New)(vtkImageData* image, bool normals);
  /// Whether the isovalue must lie between the smallest and the largest scalar, or VTK crashes.
  bool NeedsIsovalueInRange;
};

extern const ExtractionMethod FlyingEdges;
extern const ExtractionMethod MarchingCubes;
extern const ExtractionMethod SynchronizedTemplates;
extern const ExtractionMethod ContourFilter;
/// vtkContourFilter with a vtkSpanSpace. It uses its scalar tree only for vtkUniformGrid, so the
/// image is passed as one.
extern const ExtractionMethod SpanSpace;

/// The isosurface of the trilinear interpolant: a volume with vtkIsosurfaceRayTraceMapper.
class TracedIsosurface
{
public:
  explicit TracedIsosurface(vtkImageData* image);
  ~TracedIsosurface();
  TracedIsosurface(const TracedIsosurface&) = delete;
  TracedIsosurface& operator=(const TracedIsosurface&) = delete;

  void SetIsovalue(double isovalue);
  /// Builds what does not depend on the isovalue, and returns the time in seconds.
  double Build();

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
};

}

#endif
