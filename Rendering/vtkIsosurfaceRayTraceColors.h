// SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
// SPDX-License-Identifier: BSD-3-Clause

// Colours of hits by another array, which may be that of another image.

#ifndef vtkIsosurfaceRayTraceColors_h
#define vtkIsosurfaceRayTraceColors_h

#include "vtkIsosurfaceRayTracingCompat.h" // for VTK_ABI_NAMESPACE_BEGIN

#include "Picture/Scene.h"

#include <string> // for std::string

VTK_ABI_NAMESPACE_BEGIN

class vtkDataArray;
class vtkDataSet;
class vtkImageData;
class vtkIsosurfaceRayTraceSource;
class vtkIsosurfaceRayTraceValueColors;

class vtkIsosurfaceRayTraceColors : public vtkIsosurfaceRayTracing::HitColors
{
public:
  /// The array of a name, or the point scalars of the grid if the name is empty; null if there is
  /// none.
  static vtkDataArray* FindArray(vtkDataSet* grid, const std::string& name);

  /// The array belongs to an image of its own; with null, to the grid that is traced. Its values
  /// have colours, unless it has colours of 8 bits itself.
  vtkIsosurfaceRayTraceColors(vtkImageData* image, vtkDataArray* array,
    const vtkIsosurfaceRayTraceSource& source,
    const vtkIsosurfaceRayTraceValueColors& colorsOfValues);

  vtkIsosurfaceRayTracing::Vector3 Get(const vtkIsosurfaceRayTracing::Hit& hit) const override;

private:
  /// The position of a hit in the lattice of the array, in indices counted from the first point.
  vtkIsosurfaceRayTracing::Vector3 GetIndex(const vtkIsosurfaceRayTracing::Hit& hit) const;
  double Sample(const vtkIsosurfaceRayTracing::Vector3& index, int component) const;

  vtkImageData* Image;
  vtkDataArray* Array;
  const vtkIsosurfaceRayTraceSource& Source;
  /// The number of points.
  vtkIsosurfaceRayTracing::Index3 Dimensions;
  const vtkIsosurfaceRayTraceValueColors& ColorsOfValues;
  bool IsDirect;
};

VTK_ABI_NAMESPACE_END

#endif
