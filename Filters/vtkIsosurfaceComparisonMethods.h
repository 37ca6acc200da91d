// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// The methods that vtkIsosurfaceComparisonFilter compares: VTK's extraction filters behind one
// interface, and the isosurface as the mappers of this module trace it.

#ifndef vtkIsosurfaceComparisonMethods_h
#define vtkIsosurfaceComparisonMethods_h

#include "vtkIsosurfaceRayTracingCompat.h"
#include "vtkNew.h"
#include "vtkType.h"

#include <memory>
#include <string>

VTK_ABI_NAMESPACE_BEGIN
class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;
class vtkPoints;
class vtkPolyData;
class vtkVolume;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceComparison
{

/// A filter of VTK that extracts triangles from the active scalars of an image or a mesh.
class Extraction
{
public:
  virtual ~Extraction() = default;

  virtual vtkAlgorithm* GetFilter() = 0;
  virtual void SetIsovalue(double isovalue) = 0;
  /// Builds what does not depend on the isovalue, and returns the time in seconds. Most filters
  /// have nothing to build.
  virtual double Build() { return 0.0; }
  /// After an update of the filter.
  vtkPolyData* GetTriangles();
};

/// A kind of extraction, of images or of meshes. A new filter has neither built nor extracted
/// anything; it computes normals for shading if requested.
struct ExtractionMethod
{
  const char* Name;
  std::unique_ptr<Extraction> (*New)(vtkDataSet* data, bool normals);
  /// Whether the isovalue must lie between the smallest and the largest scalar, or VTK crashes.
  bool NeedsIsovalueInRange;
};

/// Whether the surface of an image lies where its direction matrix says: not all filters of all
/// releases of VTK heed it.
bool HeedsDirection(const ExtractionMethod& method);

extern const ExtractionMethod FlyingEdges;
extern const ExtractionMethod MarchingCubes;
extern const ExtractionMethod SynchronizedTemplates;
extern const ExtractionMethod ContourFilter;
/// vtkContourFilter with a vtkSpanSpace. It uses its scalar tree only for vtkUniformGrid, so the
/// image is passed as one.
extern const ExtractionMethod SpanSpace;
/// These take a vtkUnstructuredGrid.
extern const ExtractionMethod ContourGrid;
extern const ExtractionMethod Contour3DLinearGrid;

/// A volume that shows an isosurface, white, opaque and shaded, once it has a mapper.
class SurfaceVolume
{
public:
  SurfaceVolume();
  vtkVolume* Get() { return this->Volume; }
  void SetIsovalue(double isovalue);

private:
  vtkNew<vtkVolume> Volume;
};

/// The isosurface of the interpolant: a volume with a mapper of this module.
class TracedIsosurface
{
public:
  /// Of a vtkImageData, a vtkUnstructuredGrid or a vtkStructuredGrid.
  static std::unique_ptr<TracedIsosurface> New(vtkDataSet* data);
  virtual ~TracedIsosurface();
  TracedIsosurface(const TracedIsosurface&) = delete;
  TracedIsosurface& operator=(const TracedIsosurface&) = delete;

  vtkVolume* GetVolume() { return this->Surface.Get(); }
  void SetIsovalue(double isovalue) { this->Surface.SetIsovalue(isovalue); }

  /// The name of the class of the mapper.
  virtual const char* GetName() const = 0;
  /// The gradient of the interpolant as normal, which is discontinuous between cells.
  virtual void UseExactNormals() = 0;
  /// As the functions of the mapper.
  virtual bool CastRays(vtkPoints* origins, vtkDataArray* directions, vtkPolyData* hits) = 0;
  /// Why the data cannot be traced, in the words of the mapper; empty if they can.
  virtual std::string FindProblem() = 0;
  /// Builds what does not depend on the isovalue, and returns the time in seconds.
  virtual double Build() = 0;
  /// In bytes, of all that the mapper has built.
  virtual vtkIdType GetMemory() = 0;

protected:
  TracedIsosurface();

private:
  SurfaceVolume Surface;
};

}

#endif
