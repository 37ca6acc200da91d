// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

#ifndef MeshTracer_h
#define MeshTracer_h

#include "Views.h"

#include "Picture/Scene.h"
#include "vtkIsosurfaceRayTracingCompat.h"

#include <vtkSmartPointer.h>

#include <array>
#include <memory>
#include <vector>

VTK_ABI_NAMESPACE_BEGIN
class vtkDataArray;
class vtkPointSet;
VTK_ABI_NAMESPACE_END

namespace vtkIsosurfaceRayTracing
{
class CloudMedium;
class MeshCells;
class MeshField;
struct Frame;
}

namespace Benchmark
{

/// A mesh as the library draws it, without the mapper and without a window.
class MeshTracer
{
public:
  /// Builds the tree of a vtkUnstructuredGrid or vtkStructuredGrid with values at its points. The
  /// grid must outlive it. Throws std::runtime_error if its cells are not valid.
  MeshTracer(vtkPointSet* grid, vtkDataArray* values, int threads);
  ~MeshTracer();

  /// Selects an opaque surface.
  void Select(double isovalue);

  /// What a picture is made from: the pixels that the mesh may cover, in tiles as the mapper has
  /// them.
  vtkIsosurfaceRayTracing::Scene MakeScene(
    const View& view, const PictureRays& rays, int size) const;

  /// The same for a cloud, and nothing else. The medium must outlive the scene.
  vtkIsosurfaceRayTracing::Scene MakeCloudScene(const View& view, const PictureRays& rays, int size,
    const vtkIsosurfaceRayTracing::CloudMedium& medium) const;

  /// Its tetrahedra, those that the cells are subdivided into included.
  std::vector<std::array<std::array<double, 4>, 4>> Subdivide() const;

  /// Draws the picture, and returns the seconds of MeasureOn that making its rays and finding their
  /// hits took of it.
  double Trace(const vtkIsosurfaceRayTracing::Scene& scene, int threads);
  /// Makes the rays of the picture in packets, and returns the seconds.
  static double MakeRays(const vtkIsosurfaceRayTracing::Scene& scene, int threads);

  /// The depths of the hits along the view, as EmbreeTriangles::FindDepths.
  std::vector<float> FindDepths(
    vtkIsosurfaceRayTracing::Scene scene, const PictureRays& rays) const;

  /// Of the tree, in bytes.
  double GetMemory() const;

private:
  vtkSmartPointer<vtkDataArray> Points;
  vtkSmartPointer<vtkDataArray> Values;
  std::unique_ptr<vtkIsosurfaceRayTracing::MeshCells> Cells;
  std::unique_ptr<vtkIsosurfaceRayTracing::MeshField> Field;
  /// Its memory serves all pictures.
  std::unique_ptr<vtkIsosurfaceRayTracing::Frame> Picture;
};

}

#endif
