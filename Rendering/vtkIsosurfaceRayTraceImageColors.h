// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by an array of the grid that is traced, or of another image.

#ifndef vtkIsosurfaceRayTraceImageColors_h
#define vtkIsosurfaceRayTraceImageColors_h

#include "vtkIsosurfaceRayTraceColors.h"   // for base class
#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

VTK_ABI_NAMESPACE_BEGIN

class vtkImageData;
class vtkIsosurfaceRayTraceSource;

class vtkIsosurfaceRayTraceImageColors final : public vtkIsosurfaceRayTraceColors
{
public:
  /// The array belongs to an image of its own; with null, to the grid that is traced.
  vtkIsosurfaceRayTraceImageColors(vtkImageData* image, vtkDataArray* array,
    const vtkIsosurfaceRayTraceSource& source,
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues);

private:
  void Sample(
    const vtkIsosurfaceRayTracing::Hit& hit, int components, double* values) const override;
  /// The position of a hit in the lattice of the array, in indices counted from the first point.
  vtkIsosurfaceRayTracing::Vector3 GetIndex(const vtkIsosurfaceRayTracing::Hit& hit) const;
  double SampleAt(const vtkIsosurfaceRayTracing::Vector3& index, int component) const;

  vtkImageData* Image;
  vtkDataArray* Array;
  const vtkIsosurfaceRayTraceSource& Source;
  /// The number of points.
  vtkIsosurfaceRayTracing::Index3 Dimensions;
};

VTK_ABI_NAMESPACE_END

#endif
