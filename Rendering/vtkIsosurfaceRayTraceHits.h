// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds hits of rays, and their properties in VTK's terms.

#ifndef vtkIsosurfaceRayTraceHits_h
#define vtkIsosurfaceRayTraceHits_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN
#include "vtkType.h"                       // for vtkIdType

#include "Field/TracedField.h"

#include <vector> // for std::vector

VTK_ABI_NAMESPACE_BEGIN

class vtkCamera;
struct vtkIsosurfaceRayTraceRequest;

class vtkIsosurfaceRayTraceHits
{
public:
  struct Description
  {
    vtkIdType CellId;
    /// In the cell.
    vtkIsosurfaceRayTracing::Vector3 Parametric;
    /// In world coordinates.
    vtkIsosurfaceRayTracing::Vector3 Position;
    /// In world coordinates, towards smaller values, of length one.
    vtkIsosurfaceRayTracing::Vector3 Normal;
    /// The isovalue of the surface, or the value of a projection.
    double Value;
  };

  /// The request must outlive this.
  explicit vtkIsosurfaceRayTraceHits(const vtkIsosurfaceRayTraceRequest& request)
    : Request(request)
  {
  }

  /// The hits of rays given in world coordinates, up to tEnd times their direction.
  vtkIsosurfaceRayTracing::RayHits Cast(
    const std::vector<vtkIsosurfaceRayTracing::Vector3>& origins,
    const std::vector<vtkIsosurfaceRayTracing::Vector3>& directions, double tEnd,
    int threads) const;

  Description Describe(const vtkIsosurfaceRayTracing::Hit& hit) const;

  /// The positions and normals of hits in view coordinates, three numbers for every hit; zeros
  /// where there is none.
  void GetGeometry(const std::vector<vtkIsosurfaceRayTracing::Hit>& hits, vtkCamera* camera,
    int threads, std::vector<float>& positions, std::vector<float>& normals) const;

private:
  vtkIsosurfaceRayTracing::Vector3 GetPosition(const vtkIsosurfaceRayTracing::Hit& hit) const;
  vtkIsosurfaceRayTracing::Vector3 GetNormal(const vtkIsosurfaceRayTracing::Hit& hit) const;

  const vtkIsosurfaceRayTraceRequest& Request;
};

VTK_ABI_NAMESPACE_END

#endif
