// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The ways to an isosurface that vtkIsosurfaceComparisonFilter compares: VTK's extraction filters
// behind one interface, and the isosurface as our mapper traces it.

#ifndef vtkIsosurfaceComparisonMethods_h
#define vtkIsosurfaceComparisonMethods_h

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <memory>
#include <vector>

class vtkIsosurfaceRayTraceMapper;
class vtkImageData;
class vtkPolyData;
class vtkPolyDataAlgorithm;
class vtkVolume;

namespace vtkIsosurfaceComparison
{

/// A filter of VTK that makes triangles of the active scalars of an image.
class Extraction
{
public:
  virtual ~Extraction() = default;

  virtual vtkPolyDataAlgorithm* GetFilter() = 0;
  virtual void SetIsovalue(double isovalue) = 0;
  /// Builds what does not depend on the isovalue, and says how many seconds that took. Most filters
  /// have nothing of that kind.
  virtual double Build() { return 0.0; }
};

/// A kind of extraction. Set up, it has neither built nor extracted anything; it makes normals for
/// shading if asked to.
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
/// vtkContourFilter with a vtkSpanSpace. It asks its scalar tree for images only if they are
/// vtkUniformGrid, so that is what it gets: the same image, by another name.
extern const ExtractionMethod SpanSpace;

/// The isosurface of the trilinear interpolant: a volume with our mapper.
class TracedIsosurface
{
public:
  explicit TracedIsosurface(vtkImageData* image);
  ~TracedIsosurface();
  TracedIsosurface(const TracedIsosurface&) = delete;
  TracedIsosurface& operator=(const TracedIsosurface&) = delete;

  void SetIsovalue(double isovalue);
  /// Builds what does not depend on the isovalue, and says how many seconds that took.
  double Build();

  vtkNew<vtkIsosurfaceRayTraceMapper> Mapper;
  vtkNew<vtkVolume> Volume;
};

}

#endif
